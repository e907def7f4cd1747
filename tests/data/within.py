#!/usr/bin/env python3
"""Writes within.csv: Cochran's Q, Cochran-Mantel-Haenszel, response times.

    pip install numpy scipy statsmodels   (written with numpy 2.4.6, scipy 1.17.1, statsmodels 0.15.0)
    python3 tests/data/within.py > tests/data/within.csv

Made-up data with a fixed seed. Needs Rscript (written with R 4.2.2) for the cross-check of the
Mantel-Haenszel numbers. Rows, by the first column:
    cochran_q,choices,Q,p,p exact     choices: one word a participant, a digit a condition;
                                      statsmodels cochrans_q; exact: every way to share out the
                                      votes of each participant, whole numbers
    order,strata,chi2,p,ratio,low,high,homogeneity,df,p
                                      strata: ab_b ab_a ba_b ba_a, split by |; statsmodels
                                      StratifiedTable, R mantelhaen.test and by R's own formulas
    time,participant,condition,chosen,ms
    time_condition,condition,n,geometric mean,low,high,sd of ln,q05,q25,q50,q75,q95
    time_position,chosen,participants,geometric mean,low,high
    time_test,position,ratio,low,high,t,df,p
    time_test,condition,chi2,p,participants
"""
import itertools
import subprocess
from collections import Counter
from math import comb

import numpy as np
from scipy import stats
from statsmodels.stats.contingency_tables import StratifiedTable, cochrans_q

RNG = np.random.default_rng(20100)


def exact_q(rows):
    k = len(rows[0])
    observed = sum(int(c) ** 2 for c in np.sum(rows, axis=0))
    states, ways = Counter({(0,) * k: 1}), 1
    for row in rows:
        r = sum(row)
        options = list(itertools.combinations(range(k), r))
        ways *= comb(k, r)
        following = Counter()
        for state, count in states.items():
            for option in options:
                new = list(state)
                for i in option:
                    new[i] += 1
                following[tuple(new)] += count
        states = following
    assert sum(states.values()) == ways
    return sum(n for s, n in states.items() if sum(c * c for c in s) >= observed) / ways


def cochran():
    # n, shares of b by condition, whether the exact p is written out too
    for n, shares, exact in [(8, [0.9, 0.5, 0.2], True), (12, [0.6, 0.6, 0.4], True), (20, [0.7, 0.5, 0.3], True),
                             (6, [0.8, 0.5, 0.5, 0.2], True), (8, [0.7, 0.5, 0.4, 0.5, 0.2], True),
                             (200, [0.6, 0.5, 0.5, 0.4, 0.55, 0.45], False)]:
        rows = (RNG.random((n, len(shares))) < shares).astype(int).tolist()
        result = cochrans_q(np.array(rows))
        words = " ".join("".join(map(str, row)) for row in rows)
        print(f"cochran_q,{words},{float(result.statistic)!r},{float(result.pvalue)!r},{exact_q(rows) if exact else ''}")


R = """
x <- array(c(%s), dim = c(2, 2, %d))
m <- mantelhaen.test(x, correct = FALSE, conf.level = 0.95)
cat(format(c(m$statistic, m$p.value, m$estimate, m$conf.int), digits = 17), sep = "\\n")
"""


def order():
    tables = [
        [(9, 9, 8, 10), (12, 7, 10, 7), (13, 5, 12, 6), (10, 11, 10, 5), (13, 6, 12, 5), (11, 10, 7, 8), (9, 12, 6, 9)],
        [(15, 6, 5, 10), (14, 7, 6, 9), (16, 5, 7, 8)],
        [(18, 0, 10, 8), (3, 15, 1, 17), (9, 9, 9, 9)],
        [(900, 100, 850, 150), (20, 5, 400, 600), (7, 3, 2, 8), (60, 40, 50, 50)],
        [(1, 9, 9, 1), (2, 8, 7, 3)],
    ]
    for strata in tables:
        # rows: order shown; columns: choice of b, of a
        table = StratifiedTable([np.array([[s[0], s[1]], [s[2], s[3]]], float) for s in strata])
        null, equal = table.test_null_odds(correction=False), table.test_equal_odds(adjust=True)
        low, high = table.oddsratio_pooled_confint(alpha=0.05)
        numbers = [null.statistic, null.pvalue, table.oddsratio_pooled, low, high]
        flat = ",".join(f"{s[0]},{s[2]},{s[1]},{s[3]}" for s in strata)  # by column
        out = subprocess.run(["Rscript", "-e", R % (flat, len(strata))], capture_output=True, text=True, check=True)
        for ours, theirs in zip(numbers, map(float, out.stdout.split())):
            assert abs(ours / theirs - 1) < 1e-10, (strata, ours, theirs)
        text = "|".join(" ".join(map(str, s)) for s in strata)
        values = [float(v) for v in numbers + [equal.statistic, len(strata) - 1, equal.pvalue]]
        print(f"order,{text}," + ",".join(map(repr, values)))


def times():
    n, k = 15, 4
    ms = np.exp(RNG.normal(7.2, 0.4, (n, k)) + RNG.normal(0, 0.3, (n, 1)) + [0, 0.1, 0.2, 0.3])
    ms = np.float32(np.round(ms / 16) * 16)  # some ties
    chosen = RNG.integers(0, 2, (n, k))
    chosen[3] = 0  # one participant never chose second
    ms[7, 2] = 0  # left out
    for i in range(n):
        for j in range(k):
            print(f"time,{i},{j},{chosen[i, j]},{float(ms[i, j])!r}")
    ln = np.log(ms.astype(float), where=ms > 0, out=np.full(ms.shape, np.nan))

    def interval(x):
        half = stats.t.ppf(0.975, len(x) - 1) * stats.sem(x)
        return [float(np.exp(v)) for v in (np.mean(x), np.mean(x) - half, np.mean(x) + half)]

    for j in range(k):
        own = ln[~np.isnan(ln[:, j]), j]
        quantiles = np.quantile(ms[ms[:, j] > 0, j].astype(float), [0.05, 0.25, 0.5, 0.75, 0.95])
        values = interval(own) + [float(np.std(own, ddof=1))] + [float(q) for q in quantiles]
        print(f"time_condition,{j},{len(own)}," + ",".join(map(repr, values)))
    means = np.full((n, 2), np.nan)
    for i in range(n):
        for position in range(2):
            own = ln[i, (chosen[i] == position) & ~np.isnan(ln[i])]
            if len(own):
                means[i, position] = own.mean()
    for position in range(2):
        own = means[~np.isnan(means[:, position]), position]
        print(f"time_position,{position},{len(own)}," + ",".join(map(repr, interval(own))))
    differences = (means[:, 0] - means[:, 1])[~np.isnan(means).any(axis=1)]
    test = stats.ttest_1samp(differences, 0)
    values = interval(differences) + [float(test.statistic), len(differences) - 1, float(test.pvalue)]
    print("time_test,position," + ",".join(map(repr, values)))
    complete = ms[(ms > 0).all(axis=1)]
    test = stats.friedmanchisquare(*complete.T.astype(float))
    print(f"time_test,condition,{float(test.statistic)!r},{float(test.pvalue)!r},{len(complete)}")


cochran()
order()
times()
