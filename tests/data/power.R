#!/usr/bin/env Rscript
# Writes power.csv: what planning must give, by enumeration of every outcome in R.
#
#     Rscript tests/data/power.R > tests/data/power.csv
#
# p of a split is binom.test's (exact) or chisq.test's without correction, both two-sided; powers are
# sums of dbinom over the splits with p <= alpha; sample sizes are found by counting through every n
# up to 1200; Holm's power over a family of three by p.adjust of every triple of outcomes.
# Columns: quantity, test, n (participants; for sample sizes 0), p, alpha, extra (target power, family
# or bias), value.

exact_p <- function(n) {
  k <- 0:n
  pmin(1, 2 * pbinom(pmin(k, n - k), n, 0.5))
}
chi_p <- function(n) {
  k <- 0:n
  pchisq((n - 2 * k)^2 / n, df = 1, lower.tail = FALSE)
}
# R's own functions agree with the two above.
stopifnot(all.equal(exact_p(36)[12], binom.test(11, 36)$p.value))
stopifnot(all.equal(chi_p(36)[12], chisq.test(c(11, 25), correct = FALSE)$p.value))

tests <- list(exact_binomial = exact_p, chi_square = chi_p)
power <- function(test, n, p, alpha) sum(dbinom(0:n, n, p)[tests[[test]](n) <= alpha])
row <- function(quantity, test, n, p, alpha, extra, value) {
  cat(sprintf("%s,%s,%d,%.17g,%.17g,%.17g,%.17g\n", quantity, test, n, p, alpha, extra, value))
}

cat("quantity,test,n,p,alpha,extra,value\n")
for (test in names(tests)) {
  for (n in c(1, 5, 6, 9, 14, 28, 36, 42, 98, 500, 2000)) {
    for (p in c(0.5, 0.6, 0.65, 0.7, 0.95)) {
      for (alpha in c(0.05, 0.05 / 7, 0.01)) {
        row("power", test, n, p, alpha, 0, power(test, n, p, alpha))
      }
    }
  }
}

for (test in names(tests)) {
  for (p in c(0.6, 0.65, 0.7, 0.8)) {
    for (alpha in c(0.05, 0.05 / 7)) {
      powers <- sapply(1:1200, function(n) power(test, n, p, alpha))
      for (target in c(0.8, 0.9)) {
        row("n_first", test, 0, p, alpha, target, which(powers >= target)[1])
        row("n_from", test, 0, p, alpha, target, max(which(powers < target)) + 1)
      }
    }
  }
}

# Every triple of outcomes of three independent conditions.
family <- 3
for (n in c(14, 36)) {
  for (p in c(0.6, 0.7, 0.8)) {
    of <- exact_p(n)
    weight <- dbinom(0:n, n, p)
    index <- as.matrix(expand.grid(1:(n + 1), 1:(n + 1), 1:(n + 1)))
    found <- apply(index, 1, function(i) sum(p.adjust(of[i], method = "holm") <= 0.05))
    chance <- weight[index[, 1]] * weight[index[, 2]] * weight[index[, 3]]
    row("holm_each", "exact_binomial", n, p, 0.05, family, sum(chance * found) / family)
    row("holm_any", "exact_binomial", n, p, 0.05, family, sum(chance[found > 0]))
    row("holm_all", "exact_binomial", n, p, 0.05, family, sum(chance[found == family]))
  }
}

# A preference for the image shown first, 21 participants in one order and 15 in the other.
for (test in names(tests)) {
  for (p in c(0.5, 0.65)) {
    for (bias in c(-0.5, 0.5, 1)) {
      ab <- dbinom(0:21, 21, plogis(qlogis(p) - bias))
      ba <- dbinom(0:15, 15, plogis(qlogis(p) + bias))
      rejects <- outer(0:21, 0:15, function(i, j) tests[[test]](36)[i + j + 1] <= 0.05)
      row("orders_21_15", test, 36, p, 0.05, bias, sum(outer(ab, ba)[rejects]))
      # Participants who differ, too: means over a normal preference.
      mean_share <- function(by) {
        f <- function(z) plogis(qlogis(p) + by + 0.8 * z) * dnorm(z)
        integrate(f, -Inf, Inf, rel.tol = 1e-12)$value
      }
      ab <- dbinom(0:21, 21, mean_share(-bias))
      ba <- dbinom(0:15, 15, mean_share(bias))
      row("orders_21_15_sd_0.8", test, 36, p, 0.05, bias, sum(outer(ab, ba)[rejects]))
    }
  }
}
