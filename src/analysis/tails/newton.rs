//! The inverse of a tail of a log-concave density.

/// A tail at one point of a variable along which it grows.
pub struct Tail {
    /// Its natural logarithm.
    pub ln: f64,
    /// The logarithm's derivative: density over tail.
    pub slope: f64,
    /// The log density's derivative.
    pub density_slope: f64,
}

/// Where the logarithm of the tail is `ln_tail`.
///
/// The logarithm of a log-concave density's tail is concave, so a Newton step never passes the root from its
/// left. Halley's steps triple the digits; they are held between the points already known to be left
/// and right of the root.
pub fn solve(ln_tail: f64, start: f64, tail: impl Fn(f64) -> Tail) -> f64 {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut at = start;
    for _ in 0..200 {
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
        if !(next > low && next < high) {
            // NaN (no slope) comes here too.
            let next = between(low, high, at);
            if next == at || next == low || next == high {
                break;
            }
            at = next;
            continue;
        }
        let settled = step.abs() * here.slope.max(-bend) <= 1e-6;
        at = next;
        if settled || step == 0.0 {
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
