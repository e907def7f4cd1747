//! Elementary functions without cancellation.

use std::f64::consts::LN_2;

/// ln(1 − e^ln) for ln ≤ 0.
pub fn complement(ln: f64) -> f64 {
    // Near 1 the difference is in the exponential, near 0 in its logarithm (Mächler 2012).
    if ln > -LN_2 {
        (-ln.exp_m1()).ln()
    } else {
        (-ln.exp()).ln_1p()
    }
}

/// ln(1 + w) − w for w > −1.
pub fn ln_1p_minus(w: f64) -> f64 {
    if !(-0.5..=1.0).contains(&w) {
        return w.ln_1p() - w;
    }
    // ln(1 + w) = 2 atanh(r), and w − 2r = w r.
    let r = w / (2.0 + w);
    let square = r * r;
    let (mut power, mut odd, mut sum) = (square, 3.0, 0.0_f64);
    while power > sum * 1e-17 {
        sum += power / odd;
        power *= square;
        odd += 2.0;
    }
    r * (2.0 * sum - w)
}

/// e^u − 1 − u.
pub fn exp_minus(u: f64) -> f64 {
    if u.abs() > 0.5 {
        return u.exp_m1() - u;
    }
    let (mut term, mut k, mut sum) = (0.5 * u * u, 2.0, 0.0_f64);
    while term.abs() > sum.abs() * 1e-17 {
        sum += term;
        k += 1.0;
        term *= u / k;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_branches_agree_where_they_meet() {
        for (w, other) in [(-0.5, -0.500_000_1), (1.0, 1.000_000_1)] {
            assert!((ln_1p_minus(w) - ln_1p_minus(other)).abs() < 2e-7);
        }
        // From ½ on the plain formula has all but a digit.
        for u in [0.5_f64, -0.5] {
            assert!((exp_minus(u) / (u.exp() - 1.0 - u) - 1.0).abs() < 1e-14);
        }
        let w = 0.7_f64;
        assert!((ln_1p_minus(w) / (1.7_f64.ln() - w) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn small_arguments_keep_their_digits() {
        let t = 1e-8_f64;
        assert!((ln_1p_minus(t) / (-0.5 * t * t * (1.0 - 2.0 / 3.0 * t)) - 1.0).abs() < 1e-15);
        assert!((exp_minus(-t) / (0.5 * t * t * (1.0 - t / 3.0)) - 1.0).abs() < 1e-15);
        assert_eq!((ln_1p_minus(0.0), exp_minus(0.0)), (0.0, 0.0));
        assert_eq!(complement(0.0), f64::NEG_INFINITY);
        assert_eq!(complement(f64::NEG_INFINITY), 0.0);
    }
}
