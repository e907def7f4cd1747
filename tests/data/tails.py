#!/usr/bin/env python3
"""Writes tails.csv: what analysis::tails must give, to 25 digits.

Needs mpmath, and scipy for a coarse cross-check by other algorithms:
    pip install mpmath scipy
    python3 tests/data/tails.py > tests/data/tails.csv      (some minutes)
Written with mpmath 1.3.0 and scipy 1.17.1.

Arguments are IEEE doubles and are taken exactly (mpf of the double); every value is computed with
60 digits. Columns: function, a, b, c (arguments), ln (natural logarithm of the value). A value is
kept by its logarithm so that tails far below 1e-308 are in the table too.
"""
import math
import sys

import mpmath as mp
import scipy
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


def small_ratio(value):
    """Whether a series or a fraction has settled."""
    return abs(value) < mp.mpf(10) ** -52


def lentz(coefficients, first):
    """first + a1/(b1 + a2/(b2 + ...)), coefficients (a, b), by the modified Lentz method."""
    f = c = first
    d = mp.mpf(0)
    for a, b in coefficients:
        d = 1 / (b + a * d)
        c = b + a / c
        f *= c * d
        if small_ratio(c * d - 1):
            return f


def ln_beta_function(a, b):
    return mp.loggamma(a) + mp.loggamma(b) - mp.loggamma(a + b)


def ln_incomplete_beta(x, a, b, y=None):
    """ln I_x(a, b): the continued fraction DLMF 8.17.22, or where it has the more terms the series 8.17.8."""
    x, a, b = mp.mpf(x), mp.mpf(a), mp.mpf(b)
    y = 1 - x if y is None else y
    if x > (a + 1) / (a + b + 2):
        return mp.log1p(-mp.exp(ln_incomplete_beta(y, b, a, x)))
    ln_factor = a * mp.log(x) + b * mp.log(y) - mp.log(a) - ln_beta_function(a, b)
    return ln_factor + mp.log(beta_series(x, a, b) if x < 0.9 else beta_fraction(x, a, b))


def beta_series(x, a, b):
    term = total = mp.mpf(1)
    above, below = (a + b) * x, a + 1
    while not small_ratio(term / total):
        term = term * above / below
        above, below = above + x, below + 1
        total += term
    return total


def beta_fraction(x, a, b):
    def coefficients():
        m = 0
        while True:
            yield -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)), mp.mpf(1)
            m += 1
            yield m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), mp.mpf(1)

    return 1 / lentz(coefficients(), mp.mpf(1))


def ln_gamma_lower(x, a):
    """ln P(a, x) by DLMF 8.7.1, or the complement's continued fraction 8.9.2."""
    x, a = mp.mpf(x), mp.mpf(a)
    if x > a + 1:
        return mp.log1p(-mp.exp(ln_gamma_upper(x, a)))
    term, total, below = mp.mpf(1), mp.mpf(1), a + 1
    while not small_ratio(term / total):
        term = term * x / below
        total += term
        below += 1
    return a * mp.log(x) - x - mp.loggamma(a + 1) + mp.log(total)


def ln_gamma_upper(x, a):
    x, a = mp.mpf(x), mp.mpf(a)
    if x <= a + 1:
        return mp.log1p(-mp.exp(ln_gamma_lower(x, a)))

    def coefficients():
        i = 0
        while True:
            i += 1
            yield -i * (i - a), x + 2 * i + 1 - a

    return a * mp.log(x) - x - mp.loggamma(a) - mp.log(lentz(coefficients(), x + 1 - a))


def ln_t_upper(t, df):
    t, df = mp.mpf(t), mp.mpf(df)
    if t < 0:
        return mp.log1p(-mp.exp(ln_t_upper(-t, df)))
    whole = df + t * t
    return ln_incomplete_beta(df / whole, df / 2, HALF, t * t / whole) - mp.log(2)


def ln_f_upper(f, d1, d2):
    f, d1, d2 = mp.mpf(f), mp.mpf(d1), mp.mpf(d2)
    whole = d2 + d1 * f
    return ln_incomplete_beta(d2 / whole, d2 / 2, d1 / 2, d1 * f / whole)


def inverse(ln_tail, ln_density, target, guess):
    """The s with ln_tail(s) = target; ln_density is that of d tail / ds, by which Newton's steps are made."""
    s, sign = mp.mpf(guess), 1 if ln_tail(guess) < ln_tail(guess + mp.mpf("1e-3")) else -1
    for _ in range(40):
        here = ln_tail(s)
        step = (here - target) * mp.exp(here - ln_density(s)) * sign
        s -= step
        if abs(step) < mp.mpf(10) ** -20:
            return s
    raise ValueError((target, guess))


def ln_beta_quantile(tail, a, b, guess):
    """ln x and ln y of the x with I_x(a, b) = tail, from a guess of ln(x/y)."""
    odds = lambda s: (1 / (1 + mp.exp(-s)), 1 / (1 + mp.exp(s)))
    density = lambda x, y: mp.mpf(a) * mp.log(x) + mp.mpf(b) * mp.log(y) - ln_beta_function(mp.mpf(a), mp.mpf(b))
    s = inverse(
        lambda s: ln_incomplete_beta(odds(s)[0], a, b, odds(s)[1]),
        lambda s: density(*odds(s)),
        mp.log(mp.mpf(tail)),
        guess,
    )
    return tuple(map(mp.log, odds(s)))


def close(ln, other, tolerance=1e-8):
    """Coarse agreement with another library, where it has an opinion."""
    if math.isfinite(other) and 1e-290 < other < 1 - 1e-9:
        return abs(other / float(mp.exp(ln)) - 1) < tolerance
    return True


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
    for tail in [0.4999999999, 0.4999, 0.49, 0.4, 0.26, 0.25, 0.1, 0.05, 0.025, 0.01, 0.005, 0.0005, 1e-6, 1e-10, 1e-20,
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


DEVIATIONS = [-30, -8, -3, -1, -0.1, 0, 0.1, 1, 1.96, 3, 8, 30, 37]


def wide_chi_square_rows():
    for df in [1, 2, 3, 5, 10, 31, 100, 1000, 1001, 10**4, 10**5, 10**6, 10**7]:
        xs = {df * f for f in [1e-9, 1e-3, 0.1, 0.5, 0.9, 1.1, 2.0, 10.0]}
        # Wilson and Hilferty: so many standard deviations out.
        c = 2 / (9 * df)
        xs |= {df * (1 - c + z * math.sqrt(c)) ** 3 for z in DEVIATIONS}
        for x in sorted(float(f"{x:.6g}") for x in xs if x > 0):
            a, half = mp.mpf(df) / 2, mp.mpf(x) / 2
            upper, lower = ln_gamma_upper(half, a), ln_gamma_lower(half, a)
            # scipy itself is off by 5e-4 at 8 standard deviations of 10^7.
            if df <= 10**5:
                assert close(upper, stats.chi2.sf(x, df)) and close(lower, stats.chi2.cdf(x, df)), (x, df)
            row("chi_square_upper", x, df, ln=upper)
            row("chi_square_lower", x, df, ln=lower)
    for a in [1e-3, 0.1, 0.3, 0.77, 12.34, 400.5, 7654321.5]:
        for f in [1e-200, 1e-20, 1e-3, 0.3, 0.9, 0.999, 1.0, 1.001, 1.1, 3.0, 100.0]:
            x = a * f
            row("gamma_upper", x, a, ln=ln_gamma_upper(x, a))
            row("gamma_lower", x, a, ln=ln_gamma_lower(x, a))


def beta_rows():
    shapes = [0.5, 1.0, 2.5, 17.0, 399.0, 401.5, 1e4, 1e6, 1e7]
    pairs = [(a, b) for a in shapes for b in shapes]
    pairs += [(0.001, 0.001), (0.001, 30.0), (30.0, 0.001), (0.02, 1e5), (1e5, 0.02), (123456.75, 9.875)]
    for a, b in pairs:
        xs = set() if a + b > 1e6 else {1e-300, 1e-9, 0.01, 0.3, 0.5, 0.7, 0.99, 1 - 2**-30}
        sd = math.sqrt(1 / a + 1 / b)
        few = [-30, -3, -0.1, 0, 1.96, 8] if a + b > 1e5 else DEVIATIONS
        xs |= {1 / (1 + b / a * math.exp(-z * sd)) for z in few if abs(z * sd) < 30}
        for x in sorted(x for x in (float(f"{x:.12g}") for x in xs) if 0 < x < 1):
            lower, upper = ln_incomplete_beta(x, a, b), ln_incomplete_beta(1 - mp.mpf(x), b, a, mp.mpf(x))
            assert close(lower, stats.beta.cdf(x, a, b), 1e-6), (x, a, b)
            if lower < upper:
                row("beta_lower", x, a, b, ln=lower)
            else:
                row("beta_upper", x, a, b, ln=upper)
        row("ln_beta", a, b, ln=ln_beta_function(mp.mpf(a), mp.mpf(b)))


def t_rows():
    dfs = [0.1, 0.5, 1.0, 2.0, 2.5, 6.0, 35.0, 36.5, 799.0, 801.0, 1e5, 1e7, 1e12, 1e18]
    for df in dfs:
        for t in [-40.0, -1.0, 0.0, 1e-9, 0.1, 0.999, 1.0, 1.001, 1.96, 2.5, 5.0, 12.0, 37.0, 200.0, 1e8]:
            ln = ln_t_upper(t, df) if t != 0 else mp.log(HALF)
            assert close(ln, stats.t.sf(t, df), 1e-6), (t, df)
            row("student_t_upper", t, df, ln=ln)
        for tail in [0.4999, 0.26, 0.24, 0.1, 0.025, 0.005, 1e-6, 1e-20, 1e-100, 1e-300]:
            # ln(t^2/df) by Cauchy's and the normal's leading terms; Newton does the rest.
            guess = student_t_guess(tail, df)
            y, x = ln_beta_quantile(2 * mp.mpf(tail), df / 2, 0.5, guess)
            ln_t = (mp.log(mp.mpf(df)) + x - y) / 2
            if ln_t < 700:
                assert close(-ln_t, 1 / stats.t.isf(tail, df), 1e-6) or tail < 1e-15, (tail, df)
                row("student_t_quantile", tail, df, ln=ln_t)


def student_t_guess(tail, df):
    """ln(x/y), x = df/(df + t^2): t by bisection on the double-precision logarithm of the tail."""
    low, high = -800.0 / min(df, 1), 800.0
    target = mp.log(2 * mp.mpf(tail))
    for _ in range(50):
        middle = mp.mpf(low + high) / 2
        x, y = 1 / (1 + mp.exp(-middle)), 1 / (1 + mp.exp(middle))
        with mp.workdps(20):
            below = ln_incomplete_beta(x, df / 2, 0.5, y) < target
        low, high = (float(middle), high) if below else (low, float(middle))
    return (low + high) / 2


def f_rows():
    for d1, d2 in [(1.0, 1.0), (1.0, 7.0), (6.0, 210.0), (2.5, 3.7), (0.5, 1000.0), (1000.0, 0.5), (30.0, 30.0),
                   (1e4, 7.0), (6.0, 1e7), (1e7, 6.0), (1e6, 1e6), (1e7, 1e7)]:
        fs = {1e-6, 0.1, 0.9, 0.999, 1.0, 1.001, 1.5, 2.1, 5.0, 40.0}
        for f in sorted(fs):
            ln = ln_f_upper(f, d1, d2)
            assert close(ln, stats.f.sf(f, d1, d2), 1e-6), (f, d1, d2)
            row("f_upper", f, d1, d2, ln=ln)
        for tail in [0.975, 0.6, 0.4, 0.05, 0.001, 1e-9]:
            guess = math.log(d2 / d1) - math.log(stats.f.isf(tail, d1, d2))
            x, y = ln_beta_quantile(tail, d2 / 2, d1 / 2, guess)
            row("f_quantile", tail, d1, d2, ln=mp.log(mp.mpf(d2) / mp.mpf(d1)) + y - x)


def quantile_rows():
    for a, b in [(0.5, 0.5), (1.0, 1.0), (0.5, 30.0), (2.0, 3.0), (12.0, 26.0), (26.5, 12.5), (1001.0, 1.0), (3e4, 7e4),
                 (2e6, 3.0), (4999001.0, 5001001.0), (1e7, 1e7)]:
        for tail in [1e-12, 0.001, 0.025, 0.4, 0.5, 0.6, 0.975, 0.999]:
            guess = stats.beta.ppf(tail, a, b), stats.beta.ppf(1 - tail, b, a)
            x, _ = ln_beta_quantile(tail, a, b, math.log(guess[0] / guess[1]))
            row("beta_quantile", tail, a, b, ln=x)
    for df in [1, 2, 7, 30, 999, 10**5, 10**7]:
        for tail in [0.999, 0.975, 0.6, 0.5, 0.4, 0.05, 0.001, 1e-12, 1e-200]:
            a = mp.mpf(df) / 2
            s = inverse(
                lambda s: ln_gamma_upper(mp.exp(s), a),
                lambda s: a * s - mp.exp(s) - mp.loggamma(a),
                mp.log(mp.mpf(tail)),
                math.log(stats.chi2.isf(tail, df) / 2),
            )
            row("chi_square_quantile", tail, df, ln=s + mp.log(2))


def clopper_pearson_high_rows():
    """The upper end, 1 - (lower end of the failures): the x with I_x(k + 1, n - k) = 1 - alpha/2."""
    for k, n in [(0, 7), (0, 10**7), (1, 3), (11, 36), (25, 36), (99, 100), (3333, 10**4), (1, 10**7), (12345, 10**7),
                 (5001000, 10**7), (9999999, 10**7)]:
        for alpha in [0.05, 1e-6]:
            half = mp.mpf(alpha) / 2
            if k == 0:
                row("clopper_pearson_high", k, n, alpha, ln=mp.log(-mp.expm1(mp.log(half) / n)))
                continue
            low, high = stats.beta.isf(alpha / 2, k + 1, n - k), stats.beta.ppf(alpha / 2, n - k, k + 1)
            _, x = ln_beta_quantile(half, n - k, k + 1, math.log(high / low))
            row("clopper_pearson_high", k, n, alpha, ln=x)


if __name__ == "__main__":
    print("function,a,b,c,ln")
    binomial_rows()
    clopper_pearson_rows()
    normal_rows()
    chi_square_rows()
    wide_chi_square_rows()
    beta_rows()
    t_rows()
    f_rows()
    quantile_rows()
    clopper_pearson_high_rows()
    print(f"mpmath {mp.__version__}, checked against scipy {scipy.__version__}", file=sys.stderr)
