//! The plan of one session: what is shown, in which order, which image where.

use serde::{Deserialize, Serialize};

use super::exhibit::Exhibits;
use super::{Condition, Protocol, analysis};
use crate::seed;

/// Which of the two images of a trial: by time, or from left to right where both
/// are on the screen at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Position {
    /// The image shown first, or on the left.
    First,
    /// The image shown second, or on the right.
    Second,
}

impl Position {
    /// 0 or 1.
    #[must_use]
    pub fn place(self) -> usize {
        match self {
            Self::First => 0,
            Self::Second => 1,
        }
    }
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

/// A page between two trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pause {
    /// The practice is over; what follows counts.
    PracticeOver,
    /// A rest.
    Break,
}

/// One trial: a condition, and where each of its images stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// Place in the session, from 0.
    pub index: usize,
    /// Index into the study's conditions.
    pub condition: usize,
    /// True when the second technique of a pair is shown first.
    pub reversed: bool,
    /// For each place, by time or on the screen: which image of the condition.
    pub places: Vec<usize>,
    /// What it counts for.
    pub phase: Phase,
    /// Technique that passes a catch trial.
    pub correct: Option<String>,
    /// Page before it.
    pub pause: Option<Pause>,
}

/// Everything a participant of one slot will see, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SessionPlan {
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// The study's conditions, in its own order.
    pub conditions: Vec<Condition>,
    /// The trials, in the order they are shown. Every condition stands in one.
    pub trials: Vec<Trial>,
}

/// A study that cannot be planned.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// Nothing to show.
    #[error(
        "the stimulus set has no conditions for the main part; a study needs at least one [[condition]] that is neither practice nor catch trial"
    )]
    NoConditions,
    /// Two conditions of one name.
    #[error("the stimulus set has two conditions named {0:?}; every id must differ")]
    DuplicateCondition(String),
    /// A name that is no condition's.
    #[error("field `{field}`: found {found:?}, the stimulus set has {known}")]
    UnknownCondition {
        /// Field of the protocol.
        field: &'static str,
        /// What stands there.
        found: String,
        /// What could.
        known: String,
    },
    /// A rule that would leave everybody out.
    #[error(
        "field `analysis.minimum_main_trials`: found {needed}, but a session has only {there} main trials"
    )]
    TooFewTrials {
        /// As the protocol asks.
        needed: usize,
        /// As there are.
        there: usize,
    },
    /// No image to compare a pair with.
    #[error(
        "pair {pair:?} has no reference: the stimulus set needs an image of the same scene and lighting with the technique {technique:?} (field `reference.technique`)"
    )]
    NoReference {
        /// The pair.
        pair: String,
        /// Technique of the reference.
        technique: String,
    },
    /// One name for two images that stand side by side.
    #[error(
        "{view:?} has two different images of the technique {technique:?}; give them different labels to rank them"
    )]
    TwoImages {
        /// Scene and lighting.
        view: String,
        /// The label both have.
        technique: String,
    },
    /// Nothing to rank.
    #[error("{0:?} has one version only; to rank, a scene needs two or more techniques")]
    OneVersion(String),
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
        let mut ids = std::collections::HashSet::new();
        if let Some(twice) = conditions.iter().find(|known| !ids.insert(&known.id)) {
            return Err(PlanError::DuplicateCondition(twice.id.clone()));
        }
        let planner = Planner {
            protocol,
            conditions,
            slot,
        };
        let practice = planner.practice()?;
        let catch = planner.catch()?;
        let main = planner.main()?;
        let trials = planner.in_order(practice, main, catch);
        Ok(Self {
            slot,
            conditions: conditions.to_vec(),
            trials,
        })
    }

    /// Techniques of a trial's images, by place.
    pub fn shown(&self, trial: &Trial) -> impl Iterator<Item = &str> {
        let techniques = &self.conditions[trial.condition].techniques;
        trial.places.iter().map(|&image| techniques[image].as_str())
    }

    /// Techniques of a pair in the order shown; empty for an image that is not there.
    #[must_use]
    pub fn techniques(&self, trial: &Trial) -> (&str, &str) {
        let mut shown = self.shown(trial);
        (
            shown.next().unwrap_or_default(),
            shown.next().unwrap_or_default(),
        )
    }
}

/// Makes the trials of one slot.
struct Planner<'a> {
    protocol: &'a Protocol,
    conditions: &'a [Condition],
    slot: u32,
}

impl Planner<'_> {
    fn practice(&self) -> Result<Vec<Trial>, PlanError> {
        let named = self.protocol.practice.iter().flat_map(|it| &it.conditions);
        named
            .map(|id| {
                let condition = self.find("practice.conditions", id)?;
                Ok(self.drawn(condition, Phase::Practice))
            })
            .collect()
    }

    fn catch(&self) -> Result<Vec<Trial>, PlanError> {
        let mut trials = Vec::new();
        for catch in self.protocol.catch.iter().flat_map(|it| &it.trials) {
            let condition = self.find("catch.trials.condition", &catch.condition)?;
            let techniques = &self.conditions[condition].techniques;
            if !techniques.contains(&catch.correct) {
                return Err(PlanError::UnknownCondition {
                    field: "catch.trials.correct",
                    found: catch.correct.clone(),
                    known: techniques.join(", "),
                });
            }
            trials.push(Trial {
                correct: Some(catch.correct.clone()),
                ..self.drawn(condition, Phase::Catch)
            });
        }
        let mut rng = self.generator("catch-order", 0);
        seed::shuffle(&mut rng, &mut trials);
        Ok(trials)
    }

    fn main(&self) -> Result<Vec<Trial>, PlanError> {
        let main: Vec<usize> = (0..self.conditions.len())
            .filter(|&index| !self.protocol.names(&self.conditions[index].id))
            .collect();
        if main.is_empty() {
            return Err(PlanError::NoConditions);
        }
        let of_main: Vec<&Condition> = main.iter().map(|&i| &self.conditions[i]).collect();
        analysis::check(self.protocol, &of_main)?;
        let protocol = self.protocol;
        let order = protocol.design.order;
        let places = order(main.len(), protocol.seed, self.slot, protocol.inner_order);
        Ok(places
            .into_iter()
            .map(|place| {
                let condition = main[place.condition];
                self.trial(condition, place.reversed, Phase::Main)
            })
            .collect())
    }

    /// Practice, then the main part with the catch trials spread over it, one at a
    /// random place of each stretch; the pauses stand before the trials they precede.
    fn in_order(&self, practice: Vec<Trial>, main: Vec<Trial>, catch: Vec<Trial>) -> Vec<Trial> {
        let total = main.len();
        let stretches = catch.len().max(1);
        let mut before: Vec<usize> = Vec::new();
        for stretch in 0..catch.len() {
            let (from, to) = (
                stretch * total / stretches,
                (stretch + 1) * total / stretches,
            );
            let mut rng = self.generator("catch-place", stretch);
            // Never as the very first of the main part: there nobody is tired yet.
            let length = u32::try_from(to - from).unwrap_or(u32::MAX).max(1);
            before.push(from + 1 + seed::below(&mut rng, length) as usize);
        }
        let every = self.protocol.breaks.map(|breaks| breaks.every.get());
        let mut trials = practice;
        let practised = !trials.is_empty();
        let mut catch = before.into_iter().zip(catch).peekable();
        for (done, mut trial) in main.into_iter().enumerate() {
            if done == 0 && practised {
                trial.pause = Some(Pause::PracticeOver);
            } else if done > 0 && every.is_some_and(|every| done % every as usize == 0) {
                trial.pause = Some(Pause::Break);
            }
            trials.push(trial);
            while let Some((_, caught)) = catch.next_if(|(place, _)| *place <= done + 1) {
                trials.push(caught);
            }
        }
        trials.extend(catch.map(|(_, caught)| caught));
        for (index, trial) in trials.iter_mut().enumerate() {
            trial.index = index;
        }
        trials
    }

    /// A trial outside the design: which image stands where is drawn for the slot.
    fn drawn(&self, condition: usize, phase: Phase) -> Trial {
        let mut rng = self.generator("trial-outside-the-design", condition);
        self.trial(condition, seed::below(&mut rng, 2) == 1, phase)
    }

    fn trial(&self, condition: usize, reversed: bool, phase: Phase) -> Trial {
        let mut places: Vec<usize> = (0..self.conditions[condition].techniques.len()).collect();
        match self.protocol.procedure.exhibits {
            Exhibits::Versions => {
                let mut rng = self.generator("places-of-versions", condition);
                seed::shuffle(&mut rng, &mut places);
            }
            _ if reversed => places.reverse(),
            _ => {}
        }
        let is_pair = !matches!(
            self.protocol.procedure.exhibits,
            Exhibits::Versions | Exhibits::Singles
        );
        Trial {
            index: 0,
            condition,
            reversed: reversed && is_pair,
            places,
            phase,
            correct: None,
            pause: None,
        }
    }

    /// Numbers that are this slot's and this condition's alone.
    fn generator(&self, purpose: &str, condition: usize) -> rand_chacha::ChaCha20Rng {
        let index = (u64::from(self.slot) << 32) | condition as u64;
        seed::generator(self.protocol.seed, purpose, index)
    }

    fn find(&self, field: &'static str, id: &str) -> Result<usize, PlanError> {
        let known = self.conditions.iter().position(|known| known.id == id);
        known.ok_or_else(|| {
            let ids: Vec<&str> = self.conditions.iter().map(|it| it.id.as_str()).collect();
            PlanError::UnknownCondition {
                field,
                found: id.to_owned(),
                known: ids.join(", "),
            }
        })
    }
}

#[cfg(test)]
mod tests;
