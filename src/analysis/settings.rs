//! What the experimenter chooses.

use serde::Serialize;

use super::dataset::Dataset;
use super::tails::Alpha;

/// Resamples where nobody names a number: the usual order of magnitude for the ends of a 95 %
/// interval (Efron & Tibshirani 1993, section 13.3, ask for 1000 at least).
const RESAMPLES: u32 = 2000;

/// With more participants than this the bootstrap is left to those who ask for it.
const RESAMPLED_PARTICIPANTS: usize = 2000;

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
    /// defaults. Where participants are known and not too many they are resampled: intervals that
    /// take their answers for independent are too short where people differ.
    #[must_use]
    pub fn declared(data: &Dataset) -> Self {
        let declared = data.declared.as_ref();
        Self {
            alpha: declared.and_then(|it| it.alpha).unwrap_or_default(),
            family: declared.map_or_else(Vec::new, |it| it.family.clone()),
            bootstrap: match data.participants.len() {
                1..=RESAMPLED_PARTICIPANTS if data.has_answers() => RESAMPLES,
                _ => 0,
            },
            ..Self::default()
        }
    }

    /// Whether a condition belongs to the declared family.
    #[must_use]
    pub fn in_family(&self, condition: &str) -> bool {
        self.family.is_empty() || self.family.iter().any(|id| id == condition)
    }
}
