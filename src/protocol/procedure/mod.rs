//! Procedures: what one trial is made of. One file a procedure, one line in
//! [`PROCEDURES`]. A procedure is a list of steps; the session's state machine
//! walks them and knows nothing else about the procedure.

mod no_reference;

use serde::{Deserialize, Deserializer};

use super::{Position, Protocol};

/// What one trial is made of.
#[derive(Debug)]
pub struct Procedure {
    /// Name in a protocol.
    pub name: &'static str,
    /// What the participant does, in one sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// The steps of one trial; the last is a [`Step::Question`].
    pub steps: fn(&Protocol) -> Vec<Step>,
}

/// One step of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// One image.
    Image {
        /// Which of the two.
        position: Position,
        /// What ends it.
        until: Until,
    },
    /// The grey; the participant cannot end it.
    Grey {
        /// How long it stands at least, from its first frame on the display.
        duration_ns: u64,
    },
    /// The question: first or second.
    Question,
}

/// What ends a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Until {
    /// The participant's key, once the step has been on the display.
    Continue,
    /// Time alone, from the step's first frame on the display.
    Elapsed {
        /// Nanoseconds, at least.
        duration_ns: u64,
    },
}

/// Every procedure there is.
pub const PROCEDURES: &[&Procedure] = &[&no_reference::NO_REFERENCE];

impl PartialEq for Procedure {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl<'de> Deserialize<'de> for &'static Procedure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        PROCEDURES
            .iter()
            .find(|procedure| procedure.name == name)
            .copied()
            .ok_or_else(|| {
                let allowed: Vec<&str> = PROCEDURES.iter().map(|known| known.name).collect();
                serde::de::Error::custom(format!(
                    "found {name:?}, allowed is {}",
                    allowed.join(", ")
                ))
            })
    }
}
