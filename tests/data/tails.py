#!/usr/bin/env python3
"""Writes tails.csv: what analysis::tails must give, to 25 digits.

Needs mpmath, and scipy for a coarse cross-check by other algorithms:
    pip install mpmath scipy
    python3 tests/data/tails.py > tests/data/tails.csv

Arguments are IEEE doubles and are taken exactly (mpf of the double); every value is computed with
60 digits. Columns: function, a, b, c (arguments), ln (natural logarithm of the value). A value is
kept by its logarithm so that tails far below 1e-308 are in the table too.
"""
import math
import sys

import mpmath as mp
from scipy import stats

mp.mp.dps = 60
HALF = mp.mpf(1) / 2


def ln_pmf(k, n, p):
    p = mp.mpf(p)
    ln_choose = mp.loggamma(n + 1) - mp.loggamma(k + 1) - mp.loggamma(n - k + 1)
    return ln_choose + k * mp.log(p) + (n - k) * mp.log(1 - p)


def upper_tail(k, n, p):
    """P(X >= k), X ~ Bin(n, p), by the shorter of the two sums."""
    if k <= 0:
        return mp.mpf(1)
    p = mp.mpf(p)
    if k < n * p:
        return 1 - upper_tail(n - k + 1, n, 1 - p)
    odds, term, total, j = p / (1 - p), mp.mpf(1), mp.mpf(0), k
    while j <= n and term > total * mp.mpf(10) ** -45:
        total += term
        term = term * (n - j) / (j + 1) * odds
        j += 1
    return mp.exp(ln_pmf(k, n, p)) * total


def clopper_pearson_low(k, n, tail):
    """The p at which P(X >= k) = tail."""
    tail = mp.mpf(tail)
    if k == n:
        return tail ** (mp.mpf(1) / n)
    f = lambda t: mp.log(upper_tail(k, n, 1 / (1 + mp.exp(-t)))) - mp.log(tail)
    low, high = mp.mpf(-100), mp.log(mp.mpf(k) / (n - k))
    assert f(low) < 0 < f(high), (k, n, tail)
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    t = mp.findroot(f, (low, high), solver="anderson", tol=mp.mpf(10) ** -80, verify=False)
    assert abs(f(t)) < mp.mpf(10) ** -25, (k, n, tail, f(t))
    return 1 / (1 + mp.exp(-t))


def row(function, *arguments, ln):
    cells = [repr(a) for a in arguments] + [""] * (3 - len(arguments))
    print(",".join([function, *cells, mp.nstr(ln, 25)]))


def binomial_rows():
    deviations = [0, 0.5, 1, 1.96, 3, 5, 8, 12, 20, 30, 36, 50]
    for n in [1, 2, 3, 5, 7, 10, 25, 36, 100, 1000, 9999, 10**5, 10**6, 10**7]:
        some = {n // 2 - round(z * math.sqrt(n) / 2) for z in deviations}
        ks = sorted({k for k in some | {0, 1, n // 10, n // 3} if 0 <= k <= n // 2})
        if n <= 36:
            ks = range(n // 2 + 1)
        for k in ks:
            value = min(mp.mpf(1), 2 * upper_tail(n - k, n, HALF))
            if n <= 10**4 and value > 1e-290:
                other = stats.binomtest(k, n).pvalue
                assert abs(other / float(value) - 1) < 1e-9, (k, n)
            row("binomial_two_sided", k, n, ln=mp.log(value))
    for n in [1, 4, 36, 500, 12345, 10**6, 10**7]:
        for p in [1e-6, 0.001, 0.1, 0.35, 0.5, 0.65, 0.75, 0.999]:
            sd = math.sqrt(n * p * (1 - p))
            ks = {0, 1, n, *(round(n * p + z * sd) for z in [-9, -3, -1, 0, 1, 2, 5, 10, 30])}
            for k in sorted(k for k in ks if 0 <= k <= n):
                row("binomial_upper", k, n, p, ln=mp.log(upper_tail(k, n, p)))


def clopper_pearson_rows():
    cases = [(k, n) for n in [1, 2, 3, 10, 36] for k in range(1, n + 1)]
    cases += [(1, 100), (50, 100), (99, 100), (1, 10**4), (3333, 10**4), (9999, 10**4)]
    cases += [(1, 10**6), (10**5, 10**6), (500000, 10**6), (999999, 10**6)]
    cases += [(1, 10**7), (4999000, 10**7), (10**7, 10**7)]
    for k, n in cases:
        for alpha in [0.05] if n > 10**4 else [0.5, 0.05, 0.001, 1e-12]:
            low = clopper_pearson_low(k, n, mp.mpf(alpha) / 2)
            if n <= 100:
                other = stats.beta.ppf(alpha / 2, k, n - k + 1)
                assert abs(other / float(low) - 1) < 1e-8, (k, n, alpha)
            row("clopper_pearson_low", k, n, alpha, ln=mp.log(low))


def normal_rows():
    for z in [-40.0, -8.0, -1.0, -1e-3, 0.0, 1e-9, 0.1, 0.5, 1.0, 1.5, 1.96, 2.0, 2.4, 2.5, 2.6, 3.0,
              3.5, 4.0, 5.0, 6.5, 8.0, 10.0, 15.0, 20.0, 30.0, 37.5, 40.0, 100.0, 1e4]:
        row("normal_upper", z, ln=mp.log(mp.erfc(mp.mpf(z) / mp.sqrt(2)) / 2))
    for tail in [0.4999, 0.49, 0.4, 0.25, 0.1, 0.05, 0.025, 0.01, 0.005, 0.0005, 1e-6, 1e-10, 1e-20,
                 1e-100, 1e-300]:
        guess = float(stats.norm.isf(tail))
        f = lambda z: mp.log(mp.erfc(z / mp.sqrt(2)) / 2) - mp.log(mp.mpf(tail))
        z = mp.findroot(f, mp.mpf(guess))
        assert abs(z - guess) < 1e-6, tail
        row("normal_quantile", tail, ln=mp.log(z))


def chi_square_rows():
    for df in [1, 2, 3, 6, 7, 13, 30, 100]:
        for x in [1e-6, 0.01, 4 / 9, 1.0, 16 / 9, 3.841458820694124, 49 / 9, 6.0, 20.0, 50.0, 100.0,
                  400.0, 1300.0, 1e4, 1e7]:
            value = mp.gammainc(mp.mpf(df) / 2, mp.mpf(x) / 2, mp.inf, regularized=True)
            row("chi_square_upper", x, df, ln=mp.log(value))


if __name__ == "__main__":
    print("function,a,b,c,ln")
    binomial_rows()
    clopper_pearson_rows()
    normal_rows()
    chi_square_rows()
    print(f"checked against scipy {stats.__name__}", file=sys.stderr)
