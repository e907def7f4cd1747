# Scales by R's glm and brglm2: what analysis::scaling must give. Run by scaling.py, which reads what
# this prints: source,dataset,quantity,i,j,value.
suppressPackageStartupMessages(library(brglm2))
options(digits = 17)
control <- glm.control(epsilon = 1e-15, maxit = 200)
data <- read.csv("scaling-data.csv", stringsAsFactors = FALSE)

say <- function(dataset, quantity, value, i = "", j = "")
  cat(sprintf("R,%s,%s,%s,%s,%.17g\n", dataset, quantity, i, j, value))

# One column a technique but the first, which is 0: +1 for the one, -1 for the other.
design <- function(d) {
  t <- max(d$first, d$second)
  X <- matrix(0, nrow(d), t)
  for (r in seq_len(nrow(d))) {
    if (d$first[r] > 0) X[r, d$first[r]] <- X[r, d$first[r]] + 1
    if (d$second[r] > 0) X[r, d$second[r]] <- X[r, d$second[r]] - 1
  }
  X
}

estimates <- function(dataset, model, fit) {
  b <- coef(fit)
  V <- vcov(fit)
  for (i in seq_along(b)) {
    say(dataset, paste0(model, "_beta"), b[i], i)
    say(dataset, paste0(model, "_se"), sqrt(V[i, i]), i)
    if (i > 1) for (j in 1:(i - 1))
      say(dataset, paste0(model, "_se_difference"), sqrt(V[i, i] + V[j, j] - 2 * V[i, j]), i, j)
  }
}

quiet <- function(x) suppressWarnings(x)

for (name in unique(data$dataset)) {
  d <- data[data$dataset == name, ]
  y <- cbind(d$wins, d$losses)
  X <- design(d)
  kind <- d$kind[1]
  for (link in c("logit", "probit")) {
    if (kind == "ml") {
      fit <- quiet(glm(y ~ 0 + X, family = binomial(link), control = control))
      estimates(name, link, fit)
      say(name, paste0(link, "_g2"), deviance(fit))
      say(name, paste0(link, "_x2"), sum(residuals(fit, "pearson")^2))
      say(name, paste0(link, "_df"), df.residual(fit))
    } else if (kind == "firth") {
      fit <- quiet(glm(y ~ 0 + X, family = binomial(link), method = "brglmFit",
                       type = "MPL_Jeffreys", epsilon = 1e-13, maxit = 100000))
      estimates(name, link, fit)
    } else if (kind == "scenes") {
      # A scale a scene against one for all.
      scene <- factor(d$scene)
      one <- quiet(glm(y ~ 0 + X, family = binomial(link), control = control))
      Z <- do.call(cbind, lapply(levels(scene), function(s) X * (scene == s)))
      Z <- Z[, colSums(abs(Z)) > 0, drop = FALSE]
      each <- quiet(glm(y ~ 0 + Z, family = binomial(link), control = control))
      table <- anova(one, each, test = "LRT")
      say(name, paste0(link, "_lr"), table$Deviance[2])
      say(name, paste0(link, "_lr_df"), table$Df[2])
      say(name, paste0(link, "_lr_p"), table$`Pr(>Chi)`[2])
    }
  }
  if (kind == "order") {
    delta <- rep(1, nrow(d))
    with <- quiet(glm(y ~ 0 + X + delta, family = binomial, control = control))
    without <- quiet(glm(y ~ 0 + X, family = binomial, control = control))
    table <- anova(without, with, test = "LRT")
    at <- ncol(X) + 1
    say(name, "delta", coef(with)[at])
    say(name, "delta_se", sqrt(vcov(with)[at, at]))
    say(name, "delta_lr", table$Deviance[2])
    say(name, "delta_lr_p", table$`Pr(>Chi)`[2])
  }
  if (kind == "order-firth") {
    delta <- rep(1, nrow(d))
    with <- quiet(glm(y ~ 0 + X + delta, family = binomial, method = "brglmFit",
                      type = "MPL_Jeffreys", epsilon = 1e-13, maxit = 100000))
    at <- ncol(X) + 1
    say(name, "delta", coef(with)[at])
    say(name, "delta_se", sqrt(vcov(with)[at, at]))
  }
}
