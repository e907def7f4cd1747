//! The inverse of a tail of a log-concave density.

use std::f64::consts::LN_2;

use super::elementary::complement;

/// A tail at one point of a variable along which it grows.
pub struct Tail {
    /// Its natural logarithm.
    pub ln: f64,
    /// The logarithm's derivative: density over tail.
    pub slope: f64,
    /// The log density's derivative.
    pub density_slope: f64,
}

impl Tail {
    /// The tail away from the mode: `per_density` times the density.
    pub fn short(ln_density: f64, per_density: f64, density_slope: f64) -> Self {
        Self {
            ln: ln_density + per_density.ln(),
            // Not the exponential of a difference of logarithms, which may be large.
            slope: 1.0 / per_density,
            density_slope,
        }
    }

    /// The tail that holds the mode, given the other one over the density.
    pub fn long(ln_density: f64, other_per_density: f64, density_slope: f64) -> Self {
        let ln = complement(ln_density + other_per_density.ln());
        Self {
            ln,
            slope: (ln_density - ln).exp(),
            density_slope,
        }
    }
}

/// Where the logarithm of the tail is `ln_tail`.
///
/// The logarithm of a log-concave density's tail is concave, so a Newton step never passes the root from its
/// left. Halley's steps triple the digits; they are held between the points already known to be left
/// and right of the root.
pub fn solve(ln_tail: f64, start: f64, tail: impl Fn(f64) -> Tail) -> f64 {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut at = start;
    for _ in 0..100 {
        let here = tail(at);
        let excess = here.ln - ln_tail;
        if excess < 0.0 {
            low = at;
        } else {
            high = at;
        }
        let newton = excess / here.slope;
        // (ln tail)″ / (ln tail)′, negative.
        let bend = here.density_slope - here.slope;
        let step = newton / (1.0 - 0.5 * newton * bend).max(0.5);
        let next = at - step;
        // The next error would be the cube of this one, in units of the tail's width. Or a double shows no more.
        if step.abs() * here.slope.max(-bend) <= 1e-6 || step.abs() <= f64::EPSILON * at.abs() {
            return next;
        }
        // NaN (no slope) is outside too.
        at = if next > low && next < high {
            next
        } else {
            between(low, high, at)
        };
        if at == low || at == high {
            break;
        }
    }
    at
}

/// A point inside the bracket; where it is still open on one side, a good way out.
fn between(low: f64, high: f64, at: f64) -> f64 {
    if low == f64::NEG_INFINITY {
        high.min(at) - at.abs().max(1.0)
    } else if high == f64::INFINITY {
        low.max(at) + at.abs().max(1.0)
    } else {
        f64::midpoint(low, high)
    }
}

/// About the normal's quantile of a tail of at most ½, given its logarithm: where inversions begin.
pub fn normal_start(ln_tail: f64) -> f64 {
    (-2.0 * (ln_tail + LN_2)).max(0.0).sqrt()
}
