#!/usr/bin/env python3
"""Writes scaling-data.csv (comparison tables) and scaling.csv: what analysis::scaling must give.

Needs numpy, scipy, choix, and R with brglm2 (Debian: r-cran-brglm2). Run in this folder:
    python3 scaling.py

Three independent implementations: R's glm (maximum likelihood, likelihood ratios) and brglm2
(Jeffreys penalty), choix (Bradley-Terry by iterative Luce spectral ranking), and scipy's minimiser on
the penalised likelihood as it stands in the formula. Where two give the same quantity they are
compared here, too. Techniques are numbered from 0; 0 is the reference. Columns of scaling.csv: source,
dataset, quantity, i, j, value; of scaling-data.csv: dataset, kind, scene, first, second, wins, losses.
Computed with R 4.2.2, brglm2 0.9, choix 0.4.1, scipy 1.17.1.
"""
import csv
import itertools
import subprocess

import choix
import numpy as np
from scipy import optimize, stats

rng = np.random.default_rng(20100601)


def draw(truth, pairs, votes, delta=0.0):
    rows = []
    for i, j in pairs:
        n = int(votes if np.isscalar(votes) else rng.integers(*votes))
        wins = int(rng.binomial(n, 1 / (1 + np.exp(-(truth[i] - truth[j] + delta)))))
        rows.append((i, j, wins, n - wins))
    return rows


every = lambda t: list(itertools.combinations(range(t), 2))
both = lambda t: [p for i, j in every(t) for p in ((i, j), (j, i))]
ring = [(i, (i + 1) % 20) for i in range(20)]
chords = [(i, (i + 7) % 20) for i in range(0, 20, 2)]
tables = {
    # crytek24, blizzard24, none of the 2010 study.
    "thesis": ("ml", [(0, 1, 47, 61), (2, 1, 46, 62)]),
    "four": ("ml", draw([0, 0.4, 0.9, 1.0], every(4), (20, 40))),
    "six-sparse": ("ml", draw([0, 1, -1, 0.5, 2, 0.3], [p for p in every(6) if sum(p) % 3], (30, 90))),
    "twenty": ("ml", draw(rng.normal(0, 0.8, 20), sorted(tuple(sorted(p)) for p in ring + chords), (20, 60))),
    "million": ("ml", draw([0, 0.01, 3.0, 3.02], every(4), 10**6)),
    "misfit": ("ml", [(0, 1, 70, 30), (1, 2, 70, 30), (0, 2, 20, 80), (0, 3, 50, 50), (1, 3, 40, 60)]),
    "one-vote": ("firth", [(0, 1, 1, 0)]),
    "one-way": ("firth", [(0, 1, 0, 36)]),
    "never-wins": ("firth", [(0, 1, 12, 24), (0, 2, 30, 0), (1, 2, 36, 0)]),
    "chain": ("firth", [(0, 1, 9, 0), (1, 2, 9, 0), (2, 3, 9, 0)]),
    "two-sets": ("firth", [(0, 1, 5, 7), (2, 3, 8, 4), (0, 2, 0, 10), (1, 3, 0, 12), (1, 2, 0, 6)]),
    "order-three": ("order", draw([0, 0.6, 0.2], both(3), (15, 30), 0.4)),
    "order-uneven": ("order", draw([0, -0.6, 0.2, 1], both(4)[:-1], (8, 40), -0.3)),
    "order-two": ("order", [(0, 1, 12, 9), (1, 0, 14, 7)]),
    "order-always-first": ("order-firth", [(0, 1, 10, 0), (1, 0, 9, 0)]),
}
scenes = []
for scene, truth in [("a", [0, 0.5, 1]), ("b", [0, 0.5, 1.4]), ("c", [0.3, -0.5, 0])]:
    scenes += [(scene, *row) for row in draw(truth, every(3), (25, 45))]
scenes += [("d", *row) for row in draw([0, 0.4, 0, 0.4], [(0, 1), (1, 3), (0, 3)], 40)]
tables["scenes"] = ("scenes", scenes)

with open("scaling-data.csv", "w", newline="") as file:
    out = csv.writer(file, lineterminator="\n")
    out.writerow("dataset,kind,scene,first,second,wins,losses".split(","))
    for name, (kind, rows) in tables.items():
        for row in rows:
            out.writerow((name, kind, *(("",) if kind != "scenes" else ()), *row))

printed = subprocess.run(["Rscript", "scaling.R"], capture_output=True, text=True, check=True).stdout
results = [line.split(",") for line in printed.splitlines()]
of_r = {tuple(row[1:5]): float(row[5]) for row in results}


def close(name, quantity, i, value, tolerance):
    error = abs(of_r[(name, quantity, str(i), "")] - value)
    assert error < tolerance * max(1, abs(value)), (name, quantity, i, value, error)


def penalised(rows, t, link):
    """Minus the log-likelihood minus half the log-determinant of the Fisher information."""
    F, f = (stats.norm.cdf, stats.norm.pdf) if link == "probit" else (stats.logistic.cdf, stats.logistic.pdf)
    lnF = stats.norm.logcdf if link == "probit" else stats.logistic.logcdf

    def objective(b):
        x = np.concatenate([[0], b])
        value, information = 0, np.zeros((t, t))
        for i, j, w, l in rows:
            eta = x[i] - x[j]
            value += w * lnF(eta) + l * lnF(-eta)
            c = np.zeros(t)
            c[i], c[j] = 1, -1
            information += (w + l) * f(eta) ** 2 / (F(eta) * F(-eta)) * np.outer(c, c)
        return -value - 0.5 * np.linalg.slogdet(information[1:, 1:])[1]

    return objective


for name, (kind, rows) in tables.items():
    t = 1 + max(max(row[-4], row[-3]) for row in rows)
    if kind == "ml":
        wins = np.zeros((t, t))
        for i, j, w, l in rows:
            wins[i, j] += w
            wins[j, i] += l
        strengths = choix.ilsr_pairwise_dense(wins, alpha=0.0, max_iter=100000, tol=1e-12)
        for i in range(1, t):
            value = strengths[i] - strengths[0]
            close(name, "logit_beta", i, value, 1e-7)
            results.append(["choix", name, "logit_beta", i, "", f"{value:.17g}"])
    elif kind == "firth":
        for link in ("logit", "probit"):
            fit = optimize.minimize(penalised(rows, t, link), np.zeros(t - 1), method="Nelder-Mead",
                                    options={"xatol": 1e-11, "fatol": 1e-15, "maxiter": 10**5, "maxfev": 10**5})
            for i in range(1, t):
                close(name, f"{link}_beta", i, fit.x[i - 1], 1e-6)
                results.append(["scipy", name, f"{link}_beta", i, "", f"{fit.x[i - 1]:.17g}"])

with open("scaling.csv", "w", newline="") as file:
    out = csv.writer(file, lineterminator="\n")
    out.writerow("source,dataset,quantity,i,j,value".split(","))
    out.writerows(results)
print(len(results), "values")
