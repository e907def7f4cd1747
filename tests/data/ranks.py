#!/usr/bin/env python3
"""Writes ranks.json: what analysis::friedman and analysis::wilcoxon must give.

Needs scipy and numpy; Rscript cross-checks Friedman's statistic by another implementation:
    pip install scipy numpy
    python3 tests/data/ranks.py > tests/data/ranks.json

Friedman's chi-square and its p are scipy's and R's (friedman.test), F is Iman and Davenport's from
them. Exact p-values are counted: every order of every block for Friedman, every pattern of signs for
Wilcoxon, where the product is small. Wilcoxon's exact p without ties and its normal p are scipy's.
"""
import itertools
import json
import subprocess

import numpy as np
import scipy
from scipy import stats


def r_friedman(rows):
    values = ",".join(repr(float(v)) for row in rows for v in row)
    code = (
        f"m <- matrix(c({values}), nrow={len(rows)}, byrow=TRUE);"
        "t <- friedman.test(m); cat(sprintf('%.17g %.17g', t$statistic, t$p.value))"
    )
    out = subprocess.run(["Rscript", "-e", code], capture_output=True, text=True, check=True)
    return [float(x) for x in out.stdout.split()]


def friedman(name, rows):
    n, k = len(rows), len(rows[0])
    columns = list(zip(*rows))
    if k > 2:
        chi, p = stats.friedmanchisquare(*columns)
        chi, p = float(chi), float(p)
        ours = r_friedman(rows)
        assert abs(chi - ours[0]) < 1e-11 * chi and abs(p - ours[1]) < 1e-11 * p, (name, chi, p, ours)
    else:
        chi, p = r_friedman(rows)
    rest = n * (k - 1) - chi
    f = None if rest < 1e-9 else (n - 1) * chi / rest
    case = {
        "name": name,
        "rows": rows,
        "chi_square": chi,
        "p_chi_square": p,
        "f": f,
        "p_f": None if f is None else float(stats.f.sf(f, k - 1, (k - 1) * (n - 1))),
        "w": chi / (n * (k - 1)),
        "p_exact": counted(rows),
    }
    return case


def counted(rows):
    """Share of all orders of all blocks with a sum of squares as large as found."""
    ranks = [stats.rankdata(row) for row in rows]
    k = len(rows[0])
    orders = [np.array(list(itertools.permutations(row))) for row in ranks]
    if np.prod([float(len(o)) for o in orders]) > 2e6:
        return None
    sums = np.zeros((1, k))
    for block in orders:
        sums = (sums[:, None, :] + block[None, :, :]).reshape(-1, k)
    squares = ((sums - sums.mean(axis=1, keepdims=True)) ** 2).sum(axis=1)
    found = np.sum(ranks, axis=0)
    found = ((found - found.mean()) ** 2).sum()
    return float(np.mean(squares >= found - 1e-9))


def wilcoxon(name, d):
    d = [float(x) for x in d]
    kept = np.array([x for x in d if x != 0])
    ranks = stats.rankdata(np.abs(kept))
    v = float(ranks[kept > 0].sum())
    total = float(ranks.sum())
    tied = len(set(np.abs(kept))) < len(kept)
    if len(kept) <= 18:
        signs = np.array(list(itertools.product([0, 1], repeat=len(kept))))
        sums = signs @ ranks
        p = min(1.0, 2 * min(np.mean(sums <= v + 1e-9), np.mean(sums >= v - 1e-9)))
        if not tied:
            assert abs(p - stats.wilcoxon(kept, method="exact").pvalue) < 1e-12, name
    elif not tied and len(kept) <= 100:
        p = stats.wilcoxon(kept, method="exact").pvalue
    else:
        assert len(kept) > 100
        p = stats.wilcoxon(kept, method="approx", correction=False).pvalue
    return {
        "name": name,
        "differences": d,
        "n": len(kept),
        "v": v,
        "biserial": (2 * v - total) / total,
        "p": float(p),
    }


rng = np.random.default_rng(1937)


def shuffled(n, k):
    return [[int(x) for x in rng.permutation(k) + 1] for _ in range(n)]


def rated(n, k, points, drift=0.0):
    level = np.arange(k) * drift
    return [
        [int(x) for x in np.clip(np.round(rng.normal(points / 2 + level, 1.3)), 1, points)]
        for _ in range(n)
    ]


GRASS = [
    # Conover (1999), section 5.8, example 1: T1 = 8.097, T2 = 3.19.
    [4, 3, 2, 1], [4, 2, 3, 1], [3, 1.5, 1.5, 4], [3, 1, 2, 4], [4, 2, 1, 3], [2, 2, 2, 4],
    [1, 3, 2, 4], [2, 4, 1, 3], [3.5, 1, 2, 3.5], [4, 1, 3, 2], [4, 2, 3, 1], [3.5, 1, 2, 3.5],
]

print(json.dumps({
    "versions": {"scipy": scipy.__version__, "numpy": np.__version__},
    "friedman": [
        friedman("grass", GRASS),
        friedman("all agree", [[1, 2, 3]] * 3),
        friedman("orders 5x3", shuffled(5, 3)),
        friedman("orders 7x3", shuffled(7, 3)),
        friedman("orders 4x4", shuffled(4, 4)),
        friedman("orders 3x5", shuffled(3, 5)),
        friedman("ties 7x3", rated(7, 3, 5, 0.8)),
        friedman("ties 4x4", rated(4, 4, 5, 0.5)),
        friedman("ties 6x2", rated(6, 2, 4, 1.0)),
        friedman("ties 36x5", rated(36, 5, 7, 0.3)),
        friedman("strong 60x7", rated(60, 7, 9, 0.9)),
    ],
    "wilcoxon": [
        wilcoxon("one", [3]),
        wilcoxon("all one way", [1.5, 2.5, 0.5, 4, 3.25]),
        wilcoxon("no ties 12", np.round(rng.normal(0.6, 1, 12), 4)),
        wilcoxon("no ties 40", np.round(rng.normal(0.4, 1, 40), 4)),
        wilcoxon("ties 15", rng.integers(-2, 4, 15)),
        wilcoxon("ties and zeros 18", rng.integers(-1, 3, 18)),
        wilcoxon("balanced", [1, -1, 2, -2]),
        wilcoxon("ties 150", rng.integers(-3, 5, 150)),
    ],
}, indent=1))
