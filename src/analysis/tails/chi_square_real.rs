//! The chi-square distribution with a number of degrees of freedom that is not whole.

use statrs::function::gamma::gamma_ur;

use super::Probability;

/// P(χ² ≥ x) with `df` degrees of freedom, as approximations by matched moments need it; 1 for
/// x ≤ 0, or where a number is missing. By statrs' incomplete gamma, 2e-13.
#[must_use]
pub fn chi_square_upper_real(x: f64, df: f64) -> Probability {
    if !(x > 0.0 && x.is_finite() && df > 0.0 && df.is_finite()) {
        return Probability::ONE;
    }
    Probability::from_ln(gamma_ur(df / 2.0, x / 2.0).max(f64::MIN_POSITIVE).ln())
}
