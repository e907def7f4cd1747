//! Tail probabilities and quantiles to 12 digits, where the usual libraries lose them.
//!
//! All are computed by their logarithms and none is statrs': measured against 60-digit arithmetic, statrs
//! 0.19 holds 1e-12 for chi-square up to 1000 degrees of freedom only (1e-11 at 10⁴, 1e-8 at 10⁷), and
//! `docs/analysis.md`, section Numerics, says what it gives for the others. `tests/data/tails.csv` holds what ours
//! must give.
//!
//! The tails of beta, gamma, t, F and chi-square are one integral (`tail_integral`): in the logarithm of the odds
//! (gamma: of x) their densities are log-concave and smooth, so about a hundred values of the density
//! give the tail that does not hold the mode, whatever the shapes are. The density itself is the
//! saddle-point expansion (`saddle_point`), in which nothing large cancels.
//!
//! The 12 digits are for shapes from 1e-3 to 1e7 (degrees of freedom: twice that, for t to 1e18). No function
//! here returns NaN, panics or hangs for any double. In that range each takes under a millisecond, most
//! of them under 10 µs.

mod beta;
mod binomial;
mod chi_square;
mod clopper_pearson;
mod elementary;
mod f;
mod gamma;
mod newton;
mod normal;
#[cfg(test)]
mod properties;
mod saddle_point;
mod student_t;
#[cfg(test)]
mod table;
mod tail_integral;

use std::cmp::Ordering;

pub use beta::{beta_lower, beta_quantile, beta_upper};
pub use binomial::{Binomial, two_sided_even};
pub use chi_square::{chi_square_lower, chi_square_quantile, chi_square_upper};
pub use clopper_pearson::clopper_pearson;
pub use f::{f_quantile, f_upper};
pub use gamma::{gamma_lower, gamma_upper};
pub use normal::{normal_critical, normal_quantile, normal_upper};
pub(super) use saddle_point::{deviance, stirling_error};
pub use saddle_point::{ln_beta, ln_gamma};
pub use student_t::{student_t_critical, student_t_quantile, student_t_upper};

/// A probability, kept as its natural logarithm so that one under 1e-308 is still a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probability {
    ln: f64,
}

impl Probability {
    /// The certain event.
    pub const ONE: Self = Self { ln: 0.0 };

    /// From a natural logarithm; what rounding pushed above 0 becomes 0, NaN becomes 0 (p = 1),
    /// the value that claims nothing.
    #[must_use]
    pub fn from_ln(ln: f64) -> Self {
        // f64::min returns the other operand for NaN.
        Self { ln: ln.min(0.0) }
    }

    /// Natural logarithm, at most 0.
    #[must_use]
    pub fn ln(self) -> f64 {
        self.ln
    }

    /// Logarithm to base 10, at most 0.
    #[must_use]
    pub fn log10(self) -> f64 {
        self.ln * std::f64::consts::LOG10_E
    }

    /// The probability itself; 0 where it is under the smallest double.
    #[must_use]
    pub fn value(self) -> f64 {
        self.ln.exp()
    }

    /// `factor` times this probability, at most 1.
    ///
    /// # Panics
    /// Never; a factor of 0 or less gives 0.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self::from_ln(self.ln + factor.max(0.0).ln())
    }

    /// Whether it is at most `alpha`.
    #[must_use]
    pub fn at_most(self, alpha: Alpha) -> bool {
        self.value() <= alpha.get()
    }

    /// The larger of two.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self {
            ln: self.ln.max(other.ln),
        }
    }

    /// The smaller of two.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self {
            ln: self.ln.min(other.ln),
        }
    }

    /// Total order by size.
    #[must_use]
    pub fn total_cmp(&self, other: &Self) -> Ordering {
        self.ln.total_cmp(&other.ln)
    }
}

/// A significance level, 1e-300 to 0.999; 1 − alpha is the confidence of the intervals.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(transparent)]
pub struct Alpha(f64);

impl Alpha {
    /// The usual 0.05.
    pub const FIVE_PERCENT: Self = Self(0.05);

    /// The level.
    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }

    /// Confidence of the matching interval, in percent.
    #[must_use]
    pub fn confidence_percent(self) -> f64 {
        // Rounded at the 10th digit: 100 − 5 should not print as 94.99999999999999.
        ((100.0 - self.0 * 100.0) * 1e10).round() / 1e10
    }
}

impl Default for Alpha {
    fn default() -> Self {
        Self::FIVE_PERCENT
    }
}

impl TryFrom<f64> for Alpha {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        if (1e-300..=0.999).contains(&value) {
            return Ok(Self(value));
        }
        Err(format!(
            "found {value}, a number from 1e-300 to 0.999 is needed"
        ))
    }
}

impl std::str::FromStr for Alpha {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let value: f64 = text
            .parse()
            .map_err(|_| format!("found `{text}`, a number such as 0.05 is needed"))?;
        Self::try_from(value)
    }
}
