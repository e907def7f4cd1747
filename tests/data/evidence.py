#!/usr/bin/env python3
"""Writes evidence.csv: Bayes factors, credible intervals, confidence sequences, sequential power.

    pip install mpmath scipy          (written with mpmath 1.3.0, scipy 1.17.1)
    python3 tests/data/evidence.py > tests/data/evidence.csv

Rows, by the first column:
    ln_bayes_factor,a,b,s,ln BF10,       2^n B(b+s, a+s) / B(s, s), mpmath, 60 digits
    credible,a,b,alpha,low,high          quantiles of Beta(b+1, a+1), mpmath: root of the regularised
                                         incomplete beta integral, compared here with scipy.stats.beta.ppf
    anytime,a,b,alpha,low,high           shares q with B(b+1, a+1) / (q^b (1-q)^a) = 1/alpha, mpmath
    rejects,p,n,alpha,probability,       chance that e_k >= 1/alpha for some k <= n when b has share p;
                                         e_k = 2^k / ((k+1) C(k, b)) in whole numbers, every path summed
"""
from fractions import Fraction
from math import comb

import mpmath as mp
from scipy import stats

mp.mp.dps = 60


def text(x):
    return mp.nstr(x, 25, min_fixed=0, max_fixed=0)


def ln_beta(x, y):
    return mp.loggamma(x) + mp.loggamma(y) - mp.loggamma(x + y)


def ln_bayes_factor(a, b, s):
    s = mp.mpf(s)
    return (a + b) * mp.log(2) + ln_beta(b + s, a + s) - ln_beta(s, s)


def credible(a, b, alpha):
    def quantile(x):
        start = mp.mpf(stats.beta.ppf(float(x), b + 1, a + 1))
        f = lambda t: mp.betainc(b + 1, a + 1, 0, t, regularized=True) - x
        root = mp.findroot(f, (start * (1 - mp.mpf(10) ** -9), start * (1 + mp.mpf(10) ** -9)), tol=mp.mpf(10) ** -90, verify=False)
        assert abs(f(root)) < mp.mpf(10) ** -30 and abs(root / start - 1) < 1e-9, (a, b, x)
        return root

    alpha = mp.mpf(alpha)
    return quantile(alpha / 2), quantile(1 - alpha / 2)


def anytime(a, b, alpha):
    n = a + b
    target = ln_beta(b + 1, a + 1) + mp.log(alpha)  # b ln q + a ln(1 - q) at the ends

    def f(t):  # over the logit
        q_ln, p_ln = -mp.log1p(mp.exp(-t)), -mp.log1p(mp.exp(t))
        return b * q_ln + a * p_ln - target

    def bisect(low, high):
        negative = f(low) < 0
        for _ in range(240):
            middle = (low + high) / 2
            low, high = (middle, high) if (f(middle) < 0) == negative else (low, middle)
        return 1 / (1 + mp.exp(-low))

    far = mp.mpf(800)
    peak = mp.log(mp.mpf(b) / a) if a and b else (far if b else -far)
    low = bisect(-far, peak) if b else mp.mpf(0)
    high = bisect(peak, far) if a else mp.mpf(1)
    return low, high


def rejects(p, n, alpha):
    p, bound = Fraction(p), Fraction(1) / Fraction(alpha)
    alive, gone = {0: 1.0}, 0.0
    for k in range(1, n + 1):
        following = {}
        for b, mass in alive.items():
            following[b + 1] = following.get(b + 1, 0.0) + mass * float(p)
            following[b] = following.get(b, 0.0) + mass * float(1 - p)
        alive = {}
        for b, mass in following.items():
            if 2**k >= bound * (k + 1) * comb(k, b):
                gone += mass
            else:
                alive[b] = mass
    return gone


def main():
    print("function,a,b,argument,value,value2")
    counts = [(0, 1), (18, 18), (11, 25), (25, 11), (0, 36), (36, 0), (1, 0), (499, 501), (450, 550),
              (2_000_000, 3), (500_000, 500_500), (999_999_999, 1), (500_000_000, 500_000_000),
              (499_950_000, 500_050_000), (1_000_000_000, 1_000_000_000), (0, 1_000_000_000)]
    for a, b in counts:
        for s in ["0.5", "1", "2", "5", "10"]:
            print(f"ln_bayes_factor,{a},{b},{s},{text(ln_bayes_factor(a, b, s))},")
    for a, b in counts[:9]:
        for alpha in [0.05, 0.01]:
            low, high = credible(a, b, alpha)
            print(f"credible,{a},{b},{alpha!r},{text(low)},{text(high)}")
    for a, b in counts:
        for alpha in [0.05, 0.001]:
            low, high = anytime(a, b, alpha)
            print(f"anytime,{a},{b},{alpha!r},{text(low)},{text(high)}")
    for p in ["0.5", "0.6", "0.7"]:
        for n in [36, 100, 500]:
            print(f"rejects,{p},{n},0.05,{rejects(p, n, '0.05')!r},")


if __name__ == "__main__":
    main()
