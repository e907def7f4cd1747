//! Fisher's F: tail and quantile, for any real numbers of degrees of freedom.

use super::beta::{Beta, Point};
use super::{Probability, gamma_lower, gamma_upper};

/// Beyond these the distribution is that of its limit, or a point, to all digits.
const DEGREES: (f64, f64) = (1e-140, 1e140);

/// P(F ≥ f) with `d1` and `d2` degrees of freedom, which need not be whole and may be infinite; 1 for f ≤ 0
/// and for arguments without a meaning (NaN, degrees that are not positive).
///
/// I_x(d2/2, d1/2) with x = d2/(d2 + d1 f).
#[must_use]
pub fn f_upper(f: f64, d1: f64, d2: f64) -> Probability {
    // The negation also catches NaN.
    if !(f > 0.0 && d1 > 0.0 && d2 > 0.0) {
        return Probability::ONE;
    }
    match (d1 == f64::INFINITY, d2 == f64::INFINITY) {
        // A mean of squares over a certain 1, a certain 1 over a mean of squares, or 1.
        (false, true) => gamma_upper(0.5 * d1 * f, 0.5 * d1),
        (true, false) => gamma_lower(0.5 * d2 / f, 0.5 * d2),
        (true, true) if f > 1.0 => Probability::from_ln(f64::NEG_INFINITY),
        (true, true) => Probability::ONE,
        (false, false) => finite(f, d1, d2),
    }
}

fn finite(f: f64, d1: f64, d2: f64) -> Probability {
    if f == f64::INFINITY {
        return Probability::from_ln(f64::NEG_INFINITY);
    }
    let (d1, d2) = (
        d1.clamp(DEGREES.0, DEGREES.1),
        d2.clamp(DEGREES.0, DEGREES.1),
    );
    let Some(beta) = Beta::new(0.5 * d2, 0.5 * d1) else {
        return Probability::ONE;
    };
    let odds = d1 / d2 * f;
    let (x, y) = (1.0 / (1.0 + odds), 1.0 / (1.0 + 1.0 / odds));
    let point = Point {
        x,
        y,
        ln_odds: d2.ln() - d1.ln() - f.ln(),
        // d1 d2 (f − 1) / (2 (d2 + d1 f)): f − 1 keeps what a − (a + b) x would lose.
        excess: if odds <= 1.0 {
            0.5 * d1 * x * (f - 1.0)
        } else {
            0.5 * d2 * y * ((f - 1.0) / f)
        },
    };
    Probability::from_ln(beta.ln_lower(&point))
}

/// The f with P(F ≥ f) = `tail`; `None` unless 0 < tail < 1 and both degrees are positive, and where f is over
/// the largest double.
#[must_use]
pub fn f_quantile(tail: f64, d1: f64, d2: f64) -> Option<f64> {
    if !(tail > 0.0 && tail < 1.0 && d1 > 0.0 && d2 > 0.0) {
        return None;
    }
    let (d1, d2) = (d1.min(DEGREES.1), d2.min(DEGREES.1));
    let beta = Beta::new(0.5 * d2, 0.5 * d1)?;
    let ln_odds = if tail <= 0.5 {
        -beta.lower_quantile(tail.ln())
    } else {
        beta.turned().lower_quantile((1.0 - tail).ln())
    };
    let f = d2 / d1 * ln_odds.exp();
    f.is_finite().then_some(f)
}
