//! The regularised incomplete beta function I_x(a, b) and its inverse, by their logarithms.
//!
//! In s = ln(x/(1−x)) the density is x^a y^b / B(a, b), y = 1 − x: log-concave, its mode at x = a/(a+b).
//! The tail that does not hold the mode is computed, the other is its complement.

use std::f64::consts::PI;

use super::Probability;
use super::elementary::{exp_minus, ln_1p_minus};
use super::newton::{self, Tail, normal_start};
use super::saddle_point::{deviance, ln_beta, stirling_error};
use super::tail_integral::{Exponent, tail_integral};

/// Up to this a, and this x, the power series has some 200 terms at most.
const SERIES_SHAPE: f64 = 400.0;
const SERIES_X: f64 = 0.6;

/// Shapes are held in here: outside, the distribution is one point, or two, to all digits, and squares of
/// the shapes must not overflow.
const SHAPES: (f64, f64) = (1e-150, 1e150);

/// P(X ≤ x) for X ~ Beta(a, b), which is I_x(a, b); 1 for arguments without a meaning (NaN, shapes
/// that are not positive).
#[must_use]
pub fn beta_lower(x: f64, a: f64, b: f64) -> Probability {
    tail(x, a, b, Beta::ln_lower)
}

/// P(X ≥ x) for X ~ Beta(a, b), which is 1 − I_x(a, b) = I_{1−x}(b, a); 1 for arguments without a meaning.
#[must_use]
pub fn beta_upper(x: f64, a: f64, b: f64) -> Probability {
    tail(x, a, b, Beta::ln_upper)
}

fn tail(x: f64, a: f64, b: f64, side: fn(&Beta, &Point) -> f64) -> Probability {
    let Some(beta) = Beta::new(a, b).filter(|_| !x.is_nan()) else {
        return Probability::ONE;
    };
    Probability::from_ln(side(&beta, &beta.at(x.clamp(0.0, 1.0))))
}

/// The x with P(X ≤ x) = `lower` for X ~ Beta(a, b); 0 where it is under the smallest double. `None` unless
/// 0 ≤ lower ≤ 1 and both shapes are positive.
///
/// Where x is near 1, 1 − x is held better by `beta_quantile(1.0 - lower, b, a)`.
#[must_use]
pub fn beta_quantile(lower: f64, a: f64, b: f64) -> Option<f64> {
    if !(0.0..=1.0).contains(&lower) {
        return None;
    }
    let beta = Beta::new(a, b)?;
    Some(if lower == 0.0 {
        0.0
    } else if lower == 1.0 {
        1.0
    } else if lower <= 0.5 {
        logistic(beta.lower_quantile(lower.ln()))
    } else {
        // The complement is exact from ½ on.
        logistic(-beta.turned().lower_quantile((1.0 - lower).ln()))
    })
}

/// e^s / (1 + e^s).
pub(super) fn logistic(s: f64) -> f64 {
    if s < 0.0 {
        let odds = s.exp();
        odds / (1.0 + odds)
    } else {
        1.0 / (1.0 + (-s).exp())
    }
}

/// Where a tail begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub x: f64,
    /// 1 − x, held apart so that neither loses digits near 0.
    pub y: f64,
    /// ln(x/y), which is still there where x or y is not.
    pub ln_odds: f64,
    /// a − (a + b) x, with as little rounding as can be: it is small where a and (a + b) x are large.
    pub excess: f64,
}

impl Point {
    fn turned(&self) -> Self {
        Self {
            x: self.y,
            y: self.x,
            ln_odds: -self.ln_odds,
            excess: -self.excess,
        }
    }
}

/// The two shapes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beta {
    a: f64,
    b: f64,
    /// a + b as it rounds, and what rounding left.
    n: f64,
    n_rest: f64,
}

impl Beta {
    /// `None` unless both shapes are positive.
    pub fn new(a: f64, b: f64) -> Option<Self> {
        // The negation also catches NaN.
        if !(a > 0.0 && b > 0.0) {
            return None;
        }
        let (a, b) = (a.clamp(SHAPES.0, SHAPES.1), b.clamp(SHAPES.0, SHAPES.1));
        let n = a + b;
        // Two-sum (Knuth): exact for any two doubles.
        let b_part = n - a;
        let n_rest = (a - (n - b_part)) + (b - b_part);
        Some(Self { a, b, n, n_rest })
    }

    /// The same distribution seen from the other end.
    pub fn turned(&self) -> Self {
        Self {
            a: self.b,
            b: self.a,
            ..*self
        }
    }

    /// `x` is in [0, 1].
    pub fn at(&self, x: f64) -> Point {
        let y = 1.0 - x;
        Point {
            x,
            y,
            ln_odds: x.ln() - (-x).ln_1p(),
            excess: self.excess(x, y),
        }
    }

    pub fn at_logit(&self, s: f64) -> Point {
        let (x, y) = (logistic(s), logistic(-s));
        Point {
            x,
            y,
            ln_odds: s,
            excess: self.excess(x, y),
        }
    }

    /// From the smaller of x and y, whose complement may be rounded.
    pub fn excess(&self, x: f64, y: f64) -> f64 {
        if x <= y {
            (-self.n).mul_add(x, self.a) - self.n_rest * x
        } else {
            self.n.mul_add(y, -self.b) + self.n_rest * y
        }
    }

    /// ln I_x(a, b).
    pub fn ln_lower(&self, point: &Point) -> f64 {
        self.lower(point).ln
    }

    /// ln I_x(a, b) and its slopes along ln(x/y).
    fn lower(&self, point: &Point) -> Tail {
        let density_slope = point.excess;
        if point.ln_odds.is_infinite() {
            // x = 0 or y = 0, exactly.
            return Tail {
                ln: point.ln_odds.min(0.0),
                slope: 0.0,
                density_slope,
            };
        }
        let ln_density = self.ln_density(point);
        if point.excess >= 0.0 {
            return Tail::short(ln_density, self.per_density(point), density_slope);
        }
        let other = self.turned().per_density(&point.turned());
        Tail::long(ln_density, other, density_slope)
    }

    /// ln I_y(b, a).
    pub fn ln_upper(&self, point: &Point) -> f64 {
        self.turned().ln_lower(&point.turned())
    }

    /// I_x(a, b) over the density at x, where the tail does not reach the mode.
    fn per_density(&self, point: &Point) -> f64 {
        let Self { a, n, .. } = *self;
        let Point { x, y, excess, .. } = *point;
        if a <= SERIES_SHAPE && x <= SERIES_X {
            return self.series(x) / a;
        }
        let exponent = BetaExponent { n, x, y, excess };
        if a > SERIES_SHAPE {
            return tail_integral(&exponent, f64::INFINITY).0;
        }
        // Down to ½ by the integral, where the series takes over.
        let (above, rest) = tail_integral(&exponent, point.ln_odds);
        above + rest * self.series(0.5) / a
    }

    /// ln of x^a y^b / B(a, b), by the saddle-point expansion: no large terms that cancel.
    pub fn ln_density(&self, point: &Point) -> f64 {
        let Self { a, b, n, .. } = *self;
        let Point {
            x,
            y,
            ln_odds,
            excess,
        } = *point;
        // x or y so small that n x loses digits as a double: the other is 1.
        if x < 1e-290 {
            return a * ln_odds - b * x - ln_beta(a, b);
        }
        if y < 1e-290 {
            return -b * ln_odds - a * y - ln_beta(a, b);
        }
        let correction = stirling_error(n) - stirling_error(a) - stirling_error(b);
        let (small, large) = (a.min(b), a.max(b));
        correction - deviance(a, n * x, excess) - deviance(b, n * y, -excess)
            + 0.5 * (small.ln() + (large / n).ln() - (2.0 * PI).ln())
    }

    /// Σ (a + b)ₖ / (a + 1)ₖ xᵏ = a B(a, b) I_x(a, b) / (x^a y^b), DLMF 8.17.8: all terms are positive.
    fn series(&self, x: f64) -> f64 {
        let (mut term, mut sum) = (1.0, 1.0);
        let (mut above, mut below) = (self.n, self.a + 1.0);
        // The ratio of terms falls to x ≤ 0.6: under 2000 terms whatever the shapes.
        for _ in 0..10_000 {
            term *= above / below * x;
            sum += term;
            if term < sum * 1e-18 {
                break;
            }
            above += 1.0;
            below += 1.0;
        }
        sum
    }

    /// The ln(x/y) with ln I_x(a, b) = `ln_tail`, which is at most about ln ½.
    pub fn lower_quantile(&self, ln_tail: f64) -> f64 {
        let Self { a, b, .. } = *self;
        // The normal's quantile at the mode's width, or the power that the far tail is like, x^a / (a B(a, b)).
        let bell = a.ln() - b.ln() - normal_start(ln_tail) * (1.0 / a + 1.0 / b).sqrt();
        let ln_x = (ln_tail + a.ln() + ln_beta(a, b)) / a;
        let power = if ln_x < 0.0 {
            ln_x - (-ln_x.exp_m1()).ln()
        } else {
            f64::NEG_INFINITY
        };
        newton::solve(ln_tail, bell.max(power), |s| self.lower(&self.at_logit(s)))
    }
}

/// By how much the log density falls from x on u further out: excess · u + n (x u + ln(y + x e^−u)).
struct BetaExponent {
    n: f64,
    x: f64,
    y: f64,
    excess: f64,
}

impl Exponent for BetaExponent {
    fn at(&self, u: f64) -> f64 {
        let Self { n, x, y, excess } = *self;
        // The second cumulant function of a coin, seen from the rarer side; under u = 1 its two linear parts are
        // taken out of it by hand.
        let coin = match (x <= y, u < 1.0) {
            (true, true) => ln_1p_minus(x * (-u).exp_m1()) + x * exp_minus(-u),
            (true, false) => (x * (-u).exp_m1()).ln_1p() + x * u,
            (false, true) => ln_1p_minus(y * u.exp_m1()) + y * exp_minus(u),
            (false, false) => (y * u.exp_m1()).ln_1p() - y * u,
        };
        excess * u + n * coin
    }

    fn slopes(&self, u: f64) -> (f64, f64) {
        let Self { n, x, y, excess } = *self;
        let fallen = (-u).exp();
        let whole = y + x * fallen;
        let first = excess + n * x * y * -(-u).exp_m1() / whole;
        (first, n * (x * fallen / whole) * (y / whole))
    }
}
