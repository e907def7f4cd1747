//! What the experimenter chooses.

use serde::Serialize;

use super::dataset::Dataset;
use super::tails::Alpha;

/// Settings of one analysis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Settings {
    /// Significance level of the family; the intervals have confidence 1 − alpha.
    pub alpha: Alpha,
    /// Ids of the conditions of the declared family; empty: all of them. What is outside is
    /// reported without correction, as exploratory.
    pub family: Vec<String>,
    /// Resamples of the participants for bootstrap intervals; 0: none.
    pub bootstrap: u32,
    /// Seed of everything random: the resamples.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            alpha: Alpha::default(),
            family: Vec::new(),
            bootstrap: 0,
            seed: 1,
        }
    }
}

impl Settings {
    /// As the study's protocol declares them, where the input is its results folder; else the
    /// defaults.
    #[must_use]
    pub fn declared(data: &Dataset) -> Self {
        let declared = data.declared.as_ref();
        Self {
            alpha: declared.and_then(|it| it.alpha).unwrap_or_default(),
            family: declared.map_or_else(Vec::new, |it| it.family.clone()),
            ..Self::default()
        }
    }

    /// Whether a condition belongs to the declared family.
    #[must_use]
    pub fn in_family(&self, condition: &str) -> bool {
        self.family.is_empty() || self.family.iter().any(|id| id == condition)
    }
}
