//! The plan of one session: which pairs, in which order, which image of each first.

use serde::{Deserialize, Serialize};

/// One condition of a study, as the design needs it: two techniques on one scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Condition {
    /// Condition id (`sponza-moderate-h1`).
    pub id: String,
    /// Scene id (`atrium`).
    pub scene: String,
    /// Technique of the image that comes first in the base order.
    pub first_technique: String,
    /// Technique of the other.
    pub second_technique: String,
}

/// Which of the two images of a trial, by time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Position {
    /// The image shown first.
    First,
    /// The image shown second.
    Second,
}

/// One trial: a condition, and whether its base order is turned round.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// Place in the session, from 0.
    pub index: usize,
    /// Index into the study's conditions.
    pub condition: usize,
    /// True when the second technique of the condition is shown first.
    pub reversed: bool,
}

/// Everything a participant of one slot will see, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SessionPlan {
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// The study's conditions, in its own order.
    pub conditions: Vec<Condition>,
    /// The trials, in the order they are shown.
    pub trials: Vec<Trial>,
}

impl SessionPlan {
    /// Techniques of a trial in the order shown.
    #[must_use]
    pub fn techniques(&self, trial: &Trial) -> (&str, &str) {
        let condition = &self.conditions[trial.condition];
        let base = (
            condition.first_technique.as_str(),
            condition.second_technique.as_str(),
        );
        if trial.reversed {
            (base.1, base.0)
        } else {
            base
        }
    }
}
