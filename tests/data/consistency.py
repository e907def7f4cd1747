#!/usr/bin/env python3
"""Writes consistency.csv: what analysis::consistency must give, by counting everything.

Needs numpy. Run in this folder:
    python3 consistency.py > consistency.csv

triads,t,d: how many of the 2^(t(t-1)/2) tournaments of t techniques have d circular triads, counted
over all triples of all tournaments. u,m,t: for every value of u that m observers of t techniques can
have, by looking at every pair of observers: the share of all outcomes with at least this u. answers,
majority, mean, z, score: a study of 14 observers and 6 conditions with every other observer looked
up for every answer. Columns: kind, first, second, value.
"""
import itertools
import math

import numpy as np

print("kind,first,second,value")
for t in range(3, 8):
    pairs = list(itertools.combinations(range(t), 2))
    code = np.arange(2 ** len(pairs), dtype=np.int64)
    beats = {pair: (code >> at & 1).astype(bool) for at, pair in enumerate(pairs)}
    circular = np.zeros(len(code), dtype=np.int64)
    for i, j, k in itertools.combinations(range(t), 3):
        ij, jk, ik = beats[i, j], beats[j, k], beats[i, k]
        circular += (ij & jk & ~ik) | (~ij & ~jk & ik)
    for d, count in enumerate(np.bincount(circular)):
        print(f"triads,{t},{d},{count}")

for m, t in [(2, 3), (3, 3), (4, 3), (5, 3), (3, 4)]:
    pairs = math.comb(t, 2)
    counts = {}
    for judged in itertools.product(range(2**pairs), repeat=m):
        agreeing = sum(pairs - bin(a ^ b).count("1") for a, b in itertools.combinations(judged, 2))
        counts[agreeing] = counts.get(agreeing, 0) + 1
    total, above = 2 ** (pairs * m), 0
    for agreeing in sorted(counts, reverse=True):
        above += counts[agreeing]
        u = 2 * agreeing / (math.comb(m, 2) * pairs) - 1
        print(f"u {m} {t},{agreeing},{u:.17g},{above / total:.17g}")

rng = np.random.default_rng(1940)
chose_b = rng.random((14, 6)) < [0.2, 0.8, 0.5, 0.7, 0.9, 0.4]
chose_b[3] = ~chose_b[[0, 1, 2, 4, 5]].mean(axis=0).round().astype(bool)  # against the majority
for observer in range(14):
    print(f"answers,{observer},,{''.join('ab'[int(b)] for b in chose_b[observer])}")
z, majority, mean = [], [], []
for observer in range(14):
    agree, logs, excess, variance = 0.0, [], 0.0, 0.0
    for condition in range(6):
        def ln_share(who):
            others = [o for o in range(14) if o != who]
            same = sum(chose_b[o, condition] == chose_b[who, condition] for o in others)
            return math.log((same + 0.5) / (len(others) + 1)), same / len(others)
        every = [ln_share(who)[0] for who in range(14)]
        own, same = ln_share(observer)
        logs.append(own)
        excess += own - np.mean(every)
        variance += np.var(every)
        agree += 1.0 if same > 0.5 else 0.5 if same == 0.5 else 0.0
    z.append(excess / math.sqrt(variance))
    majority.append(agree / 6)
    mean.append(np.mean(logs))
low, high = np.percentile(z, [25, 75])
for observer in range(14):
    score = max(0.0, (low - z[observer]) / (high - low))
    for kind, value in [("majority", majority[observer]), ("mean", mean[observer]), ("z", z[observer]), ("score", score)]:
        print(f"{kind},{observer},,{value:.17g}")
