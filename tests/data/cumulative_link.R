# Writes cumulative_link_data.csv, ratings of three made-up studies, and cumulative_link.csv: the
# effects of a proportional-odds model of each with standard errors clustered by participant, that
# analysis::cumulative_link must give.
#
# Needs the packages ordinal (the model) and sandwich (the standard errors):
#     apt-get install r-cran-ordinal r-cran-sandwich
#     cd tests/data && Rscript cumulative_link.R
#
# vcovCL with type HC0 and cadjust is the sandwich times G/(G - 1) over G clusters.
library(ordinal)
library(sandwich)
RNGversion("4.0.0")
set.seed(1980)

study <- function(name, participants, conditions, techniques, points, effect, missing) {
  data <- expand.grid(technique = techniques, condition = conditions, participant = participants,
                      stringsAsFactors = FALSE)
  own <- rnorm(length(participants))
  where <- rnorm(length(conditions), sd = 0.7)
  latent <- own[match(data$participant, participants)] + where[match(data$condition, conditions)] +
    effect[match(data$technique, techniques)] + rlogis(nrow(data))
  cuts <- seq(-2.5, 3, length.out = points - 1)
  data$rating <- findInterval(latent, cuts) + 1
  data$case <- name
  data[runif(nrow(data)) >= missing, c("case", "participant", "condition", "technique", "rating")]
}

p <- function(n) sprintf("P%02d", seq_len(n))
all <- rbind(
  study("one condition", p(24), "atrium", c("none", "gtao", "traced"), 7, c(0, 0.8, 1.5), 0),
  study("four conditions", p(20), c("atrium", "figures", "lions", "shapes"),
        c("none", "crytek", "gtao", "traced"), 5, c(0, -0.3, 0.9, 1.1), 0.1),
  study("yes or no", p(30), c("a", "b"), c("none", "gtao"), 2, c(0, 0.7), 0)
)
write.csv(all, "cumulative_link_data.csv", row.names = FALSE, quote = FALSE)

result <- NULL
for (name in unique(all$case)) {
  data <- all[all$case == name, ]
  data$rating <- factor(data$rating, ordered = TRUE)
  data$technique <- factor(data$technique, levels = unique(data$technique))
  data$condition <- factor(data$condition)
  formula <- if (nlevels(data$condition) > 1) rating ~ technique + condition else rating ~ technique
  fit <- clm(formula, data = data, control = clm.control(gradTol = 1e-11, maxIter = 200))
  v <- vcovCL(fit, cluster = data$participant, type = "HC0", cadjust = TRUE)
  of <- grep("^technique", names(coef(fit)), value = TRUE)
  result <- rbind(result, data.frame(
    case = name, technique = sub("^technique", "", of),
    log_odds = sprintf("%.12g", coef(fit)[of]), se = sprintf("%.12g", sqrt(diag(v)[of])),
    log_likelihood = sprintf("%.12g", as.numeric(logLik(fit)))))
}
write.csv(result, "cumulative_link.csv", row.names = FALSE, quote = FALSE)
cat(R.version.string, "ordinal", as.character(packageVersion("ordinal")),
    "sandwich", as.character(packageVersion("sandwich")), "\n")
