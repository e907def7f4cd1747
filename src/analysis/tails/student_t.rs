//! Student's t: tail, quantile and critical value, for any real number of degrees of freedom.

use std::f64::consts::LN_2;

use super::beta::{Beta, Point};
use super::elementary::complement;
use super::{Alpha, Probability, normal_quantile, normal_upper};

/// With more degrees of freedom the quantile is the normal's to all digits: they part by
/// (z² + 1)/(4 df), relative, and z is at most 38.
const NORMAL_DF: f64 = 1e20;

/// P(T > t) with `df` degrees of freedom, which need not be whole; infinite is the normal. 1 for
/// arguments without a meaning (NaN, df not positive).
///
/// ½ I_x(df/2, ½) with x = df/(df + t²) for t ≥ 0.
#[must_use]
pub fn student_t_upper(t: f64, df: f64) -> Probability {
    if t.is_nan() || df.is_nan() || df <= 0.0 {
        return Probability::ONE;
    }
    if df == f64::INFINITY {
        return normal_upper(t);
    }
    let tail = ln_upper(t.abs(), df);
    Probability::from_ln(if t < 0.0 { complement(tail) } else { tail })
}

/// t ≥ 0.
fn ln_upper(t: f64, df: f64) -> f64 {
    let df = df.clamp(1e-149, 1e149);
    let Some(beta) = Beta::new(0.5 * df, 0.5) else {
        return 0.0;
    };
    let ratio = t / df.sqrt();
    let odds = ratio * ratio;
    let (x, y) = (1.0 / (1.0 + odds), 1.0 / (1.0 + 1.0 / odds));
    let point = Point {
        x,
        y,
        ln_odds: df.ln() - 2.0 * t.ln(),
        // Near t = 1, a and (a + b) x may be large and equal but for this.
        excess: if odds <= 1.0 {
            0.5 * (t - 1.0) * (t + 1.0) * x
        } else {
            beta.excess(x, y)
        },
    };
    beta.ln_lower(&point) - LN_2
}

/// The t ≥ 0 with P(T > t) = `tail`; `None` unless 0 < tail ≤ ½ and df > 0, and where t is over the largest
/// double.
#[must_use]
pub fn student_t_quantile(tail: f64, df: f64) -> Option<f64> {
    if !(tail > 0.0 && tail <= 0.5 && df > 0.0) {
        return None;
    }
    if df >= NORMAL_DF {
        return normal_quantile(tail);
    }
    if tail == 0.5 {
        return Some(0.0);
    }
    let beta = Beta::new(0.5 * df, 0.5)?;
    // ln(t²/df). 1 − 2 · tail is exact from ¼ on.
    let ln_odds = if tail <= 0.25 {
        -beta.lower_quantile((2.0 * tail).ln())
    } else {
        beta.turned().lower_quantile((1.0 - 2.0 * tail).ln())
    };
    let t = df.sqrt() * (0.5 * ln_odds).exp();
    t.is_finite().then_some(t)
}

/// The t of a two-sided interval at confidence 1 − alpha with `df` degrees of freedom: P(T > t) = alpha/2.
/// `None` unless df > 0, and where t is over the largest double (under 1 degree of freedom).
#[must_use]
pub fn student_t_critical(alpha: Alpha, df: f64) -> Option<f64> {
    student_t_quantile(alpha.get() / 2.0, df)
}
