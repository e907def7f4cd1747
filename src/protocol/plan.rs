//! The plan of one session: which pairs, in which order, which image of each first.

use serde::{Deserialize, Serialize};

use super::Protocol;

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
    /// The hypothesis it asks (`H1`), free text; empty where none is said.
    #[serde(default)]
    pub hypothesis: String,
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

/// What a trial counts for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// To learn the procedure; left out of every analysis.
    Practice,
    /// An attention check with an obvious answer.
    Catch,
    /// A trial of the study.
    #[default]
    Main,
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
    /// What it counts for.
    pub phase: Phase,
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

/// A study that cannot be planned.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// Nothing to show.
    #[error("the stimulus set has no conditions; a study needs at least one [[condition]]")]
    NoConditions,
    /// Two conditions of one name.
    #[error("the stimulus set has two conditions named {0:?}; every id must differ")]
    DuplicateCondition(String),
}

impl SessionPlan {
    /// The plan of one slot: a pure function of its arguments.
    ///
    /// # Errors
    /// [`PlanError`] if the conditions cannot make a study.
    pub fn new(
        protocol: &Protocol,
        conditions: &[Condition],
        slot: u32,
    ) -> Result<Self, PlanError> {
        if conditions.is_empty() {
            return Err(PlanError::NoConditions);
        }
        let mut ids = std::collections::HashSet::new();
        if let Some(twice) = conditions.iter().find(|known| !ids.insert(&known.id)) {
            return Err(PlanError::DuplicateCondition(twice.id.clone()));
        }
        let places =
            (protocol.design.order)(conditions.len(), protocol.seed, slot, protocol.inner_order);
        Ok(Self {
            slot,
            conditions: conditions.to_vec(),
            trials: places
                .into_iter()
                .enumerate()
                .map(|(index, place)| Trial {
                    index,
                    condition: place.condition,
                    reversed: place.reversed,
                    phase: Phase::Main,
                })
                .collect(),
        })
    }

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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn protocol() -> Protocol {
        let text = include_str!("../../protocols/thesis-2010.toml");
        Protocol::parse(Path::new("p.toml"), text).unwrap()
    }

    fn condition(id: &str) -> Condition {
        Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            first_technique: "none".to_owned(),
            second_technique: "blizzard24".to_owned(),
            hypothesis: String::new(),
        }
    }

    #[test]
    fn a_reversed_trial_shows_the_second_technique_first() {
        let conditions = [condition("a"), condition("b")];
        let techniques = |slot| {
            let plan = SessionPlan::new(&protocol(), &conditions, slot).unwrap();
            let (first, second) = plan.techniques(&plan.trials[0]);
            (first.to_owned(), second.to_owned())
        };
        assert_eq!(techniques(0), ("none".into(), "blizzard24".into()));
        assert_eq!(techniques(2), ("blizzard24".into(), "none".into()));
    }

    #[test]
    fn trials_are_numbered_in_the_order_shown() {
        let conditions: Vec<Condition> = ["a", "b", "c"].map(condition).into();
        let plan = SessionPlan::new(&protocol(), &conditions, 4).unwrap();
        let indices: Vec<usize> = plan.trials.iter().map(|trial| trial.index).collect();
        assert_eq!(indices, [0, 1, 2]);
    }

    #[test]
    fn a_set_that_makes_no_study_is_refused() {
        assert_eq!(
            SessionPlan::new(&protocol(), &[], 0),
            Err(PlanError::NoConditions)
        );
        assert_eq!(
            SessionPlan::new(&protocol(), &[condition("a"), condition("a")], 0),
            Err(PlanError::DuplicateCondition("a".into()))
        );
    }
}
