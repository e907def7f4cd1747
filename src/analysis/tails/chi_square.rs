//! The chi-square distribution's upper tail.

use statrs::function::gamma::{gamma_ur, ln_gamma};

use super::{Probability, normal_upper};

/// P(χ² ≥ x) with `df` degrees of freedom; 1 for x ≤ 0, NaN or df = 0.
///
/// One degree of freedom is the square of a normal and goes through [`normal_upper`]. More: statrs'
/// incomplete gamma (2e-13), and under e⁻⁶⁰⁰ the same continued fraction by its logarithm.
#[must_use]
pub fn chi_square_upper(x: f64, df: u32) -> Probability {
    if x.is_nan() || x <= 0.0 || df == 0 {
        return Probability::ONE;
    }
    if x == f64::INFINITY {
        return Probability::from_ln(f64::NEG_INFINITY);
    }
    if df == 1 {
        return normal_upper(x.sqrt()).times(2.0);
    }
    let (a, half) = (f64::from(df) / 2.0, x / 2.0);
    let ln_factor = a * half.ln() - half - ln_gamma(a);
    if half > a && ln_factor < -600.0 {
        return Probability::from_ln(ln_factor - continued_fraction(a, half).ln());
    }
    Probability::from_ln(gamma_ur(a, half).ln())
}

/// x^a e^−x / Γ(a, x) by DLMF 8.9.2, from the far end; x > a, far out, where 200 levels are plenty.
fn continued_fraction(a: f64, x: f64) -> f64 {
    (1..=200)
        .rev()
        .map(f64::from)
        .fold(x + 401.0 - a, |tail, i| {
            x + (2.0 * i - 1.0) - a - i * (i - a) / tail
        })
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
