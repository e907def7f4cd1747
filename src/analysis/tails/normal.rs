//! The standard normal's tail and quantile.

use super::{Alpha, Probability};

/// ln √(2π).
const LN_SQRT_2PI: f64 = 0.918_938_533_204_672_8;

/// A Newton step so small, relative to z ≤ 38, leaves an error under the last digit.
const SETTLED: f64 = 1e-10;

/// P(Z > z) for a standard normal Z; z may be infinite, NaN gives 1.
///
/// Under 2.5 by the series of the distribution function about 0 (DLMF 7.6.2, all terms positive),
/// above it by Laplace's continued fraction for Mills' ratio (DLMF 7.9.1).
#[must_use]
pub fn normal_upper(z: f64) -> Probability {
    if z.is_nan() || z == f64::NEG_INFINITY {
        return Probability::ONE;
    }
    Probability::from_ln(if z < 0.0 {
        (-ln_upper(-z).exp()).ln_1p()
    } else {
        ln_upper(z)
    })
}

/// ln P(Z > z), z ≥ 0.
fn ln_upper(z: f64) -> f64 {
    if z == f64::INFINITY {
        f64::NEG_INFINITY
    } else if z < 2.5 {
        (0.5 - ln_density(z).exp() * central_series(z)).ln()
    } else {
        // 60 levels give 17 digits at 2.5 and more above.
        let tail = (1..=60).rev().fold(z, |tail, i| z + f64::from(i) / tail);
        ln_density(z) - tail.ln()
    }
}

/// P(0 < Z < z) / φ(z) = Σ z^(2i+1) / (1·3·5…(2i+1)).
fn central_series(z: f64) -> f64 {
    let (mut term, mut sum, mut odd) = (z, 0.0, 1.0);
    while term > sum * 1e-18 {
        sum += term;
        odd += 2.0;
        term *= z * z / odd;
    }
    sum
}

/// ln φ(z).
fn ln_density(z: f64) -> f64 {
    -0.5 * z * z - LN_SQRT_2PI
}

/// The z with P(Z > z) = `tail`, z ≥ 0; `None` unless 0 < tail ≤ ½.
#[must_use]
pub fn normal_quantile(tail: f64) -> Option<f64> {
    if !(tail > 0.0 && tail <= 0.5) {
        return None;
    }
    if tail > 0.25 {
        return Some(central_quantile(0.5 - tail));
    }
    // ½ e^(−z²/2) bounds the tail from above, so this start is right of the root, and from there
    // Newton on the concave log tail comes down to it without overshooting.
    let mut z = (-2.0 * (2.0 * tail).ln()).max(0.0).sqrt();
    for _ in 0..100 {
        let ln_tail = ln_upper(z);
        let hazard = (ln_density(z) - ln_tail).exp();
        let step = (ln_tail - tail.ln()) / hazard;
        z = (z + step).max(0.0);
        if step.abs() <= SETTLED * z {
            break;
        }
    }
    Some(z)
}

/// The z ≥ 0 with P(0 < Z < z) = `central`, at most ¼. Near the middle this keeps the digits that the
/// tail, near ½, does not show.
fn central_quantile(central: f64) -> f64 {
    // The density falls, so this start is left of the root and Newton does not pass it.
    let mut z = central / ln_density(0.0).exp();
    for _ in 0..100 {
        let density = ln_density(z).exp();
        let step = (central - density * central_series(z)) / density;
        z += step;
        if step.abs() <= SETTLED * z {
            break;
        }
    }
    z
}

/// The z of a two-sided interval at confidence 1 − alpha (1.96 for alpha = 0.05).
#[must_use]
pub fn normal_critical(alpha: Alpha) -> f64 {
    // alpha/2 is inside the quantile's domain for every Alpha.
    normal_quantile(alpha.get() / 2.0).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_ends() {
        assert_eq!(normal_upper(f64::INFINITY).value(), 0.0);
        assert_eq!(normal_upper(f64::NEG_INFINITY).value(), 1.0);
        assert_eq!(normal_upper(0.0).value(), 0.5);
        assert_eq!(normal_quantile(0.5), Some(0.0));
        for bad in [0.0, -1.0, 0.51, f64::NAN, f64::INFINITY] {
            assert_eq!(normal_quantile(bad), None);
        }
    }

    proptest! {
        #[test]
        fn the_quantile_undoes_the_tail(ln_tail in -690.0..-0.6932_f64) {
            let z = normal_quantile(ln_tail.exp()).unwrap();
            prop_assert!((normal_upper(z).ln() / ln_tail - 1.0).abs() < 1e-13);
        }

        #[test]
        fn the_tail_falls(z in -50.0..2e4_f64, step in 1e-6..1.0_f64) {
            prop_assert!(normal_upper(z + step).ln() <= normal_upper(z).ln());
        }
    }
}
