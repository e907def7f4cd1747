//! What the experimenter chooses.

use serde::Serialize;

use super::tails::Alpha;

/// Settings of one analysis.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Settings {
    /// Significance level of the family; the intervals have confidence 1 − alpha.
    pub alpha: Alpha,
}
