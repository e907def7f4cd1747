//! The parts of a protocol that a study may have or not: times of images, scales,
//! a reference, practice, catch trials, breaks, questions about the participant.

use std::collections::BTreeSet;

use serde::Deserialize;

use super::text::{StudyId, Text};
use crate::config::quantity::{Milliseconds, quantity};

quantity! {
    /// Points of a rating scale.
    Points: u32, 2, 9, "points"
}
quantity! {
    /// A number of trials.
    TrialCount: u32, 1, 100_000, "trials"
}

/// How long an image stands where time ends it.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageTime {
    /// From its first frame on the display.
    #[serde(rename = "duration_ms")]
    pub duration: Milliseconds,
}

impl ImageTime {
    /// Nanoseconds.
    #[must_use]
    pub fn duration_ns(self) -> u64 {
        u64::from(self.duration.get()) * 1_000_000
    }
}

/// One scale that images are rated on. Its words stand in `[texts.scales.ID]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// Name in the data.
    pub id: StudyId,
    /// Ratings go from 1 to this.
    pub points: Points,
}

/// Where the images that others are compared with come from.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The technique whose image of each view is the reference.
    pub technique: Text,
}

/// Trials to learn the procedure, before all others.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Practice {
    /// Conditions of the stimulus set, in the order shown; they are left out of the main part.
    pub conditions: Vec<String>,
}

/// Attention checks: pairs with an obvious answer, spread over the main part.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Catch {
    /// The participant passes with at least so many of them right.
    pub minimum_correct: TrialCount,
    /// The trials; their conditions are left out of the main part.
    pub trials: Vec<CatchTrial>,
}

/// One attention check.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CatchTrial {
    /// Condition of the stimulus set.
    pub condition: String,
    /// The technique an attentive participant chooses.
    pub correct: String,
}

/// Rests.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Breaks {
    /// Main trials between two rests.
    #[serde(rename = "every_trials")]
    pub every: TrialCount,
}

/// One optional question about the participant. Its words stand in
/// `[texts.metadata.ID]`; without them, the id and the choices are shown as they are.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetadataField {
    /// Name in the data.
    pub id: StudyId,
    /// Answers to choose from, as they stand in the data; empty for free text.
    #[serde(default)]
    pub choices: Vec<Text>,
}

/// The first name that stands twice.
pub(super) fn twice<'a>(names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut seen = BTreeSet::new();
    names.into_iter().find(|name| !seen.insert(*name))
}
