//! The chi-square distribution's tails and quantile.

use super::gamma::Gamma;
use super::{Probability, gamma_lower, gamma_upper, normal_upper};

/// P(χ² ≥ x) with `df` degrees of freedom; 1 for x ≤ 0, NaN or df = 0.
///
/// One degree of freedom is the square of a normal and goes through [`normal_upper`]; more are an
/// incomplete gamma function.
#[must_use]
pub fn chi_square_upper(x: f64, df: u32) -> Probability {
    if x.is_nan() || x <= 0.0 || df == 0 {
        return Probability::ONE;
    }
    if df == 1 {
        return normal_upper(x.sqrt()).times(2.0);
    }
    gamma_upper(0.5 * x, 0.5 * f64::from(df))
}

/// P(χ² ≤ x); 0 for x ≤ 0, 1 for NaN or df = 0.
#[must_use]
pub fn chi_square_lower(x: f64, df: u32) -> Probability {
    gamma_lower(0.5 * x, 0.5 * f64::from(df))
}

/// The x with P(χ² ≥ x) = `tail`; `None` unless 0 < tail < 1 and df > 0.
#[must_use]
pub fn chi_square_quantile(tail: f64, df: u32) -> Option<f64> {
    if !(tail > 0.0 && tail < 1.0) {
        return None;
    }
    let gamma = Gamma::new(0.5 * f64::from(df))?;
    Some(
        2.0 * if tail <= 0.5 {
            gamma.upper_quantile(tail.ln())
        } else {
            gamma.lower_quantile((1.0 - tail).ln())
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn two_degrees_of_freedom_are_an_exponential() {
        for x in [1e-3, 1.0, 7.0, 300.0, 1199.0, 1201.0, 5e5] {
            let ln = chi_square_upper(x, 2).ln();
            assert!((ln + x / 2.0).abs() < 1e-12 * x.max(1.0), "{x}: {ln}");
        }
    }

    proptest! {
        #[test]
        fn never_nan_and_falling(x in 0.0..1e7_f64, step in 1e-3..10.0_f64, df in 0_u32..500) {
            let (here, next) = (chi_square_upper(x, df).ln(), chi_square_upper(x + step, df).ln());
            prop_assert!(here <= 0.0);
            prop_assert!(next <= here + 1e-10 * here.abs().max(1.0), "{here} {next}");
        }
    }
}
