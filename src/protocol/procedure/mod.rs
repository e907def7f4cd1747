//! Procedures: what one trial is made of. One file a procedure, one line in
//! [`PROCEDURES`]. A procedure is a list of steps; the session's state machine
//! walks them and knows nothing else about the procedure.

mod no_reference;
mod no_reference_timed;
mod rank_order;
mod rating;
mod reference;

use serde::{Deserialize, Deserializer};

use super::Protocol;
use super::exhibit::Exhibits;

/// What one trial is made of.
#[derive(Debug)]
pub struct Procedure {
    /// Name in a protocol.
    pub name: &'static str,
    /// What the participant does, in one sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What a trial shows.
    pub exhibits: Exhibits,
    /// How a trial begins where the protocol does not say.
    pub trial_start: TrialStart,
    /// The steps of one trial; the last one asks.
    pub steps: fn(&Protocol) -> Vec<Step>,
    /// What the protocol must say for this procedure and does not; or what it says
    /// and this procedure has no use for.
    pub flaw: fn(&Protocol) -> Option<String>,
}

/// One step of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// One image.
    Image {
        /// Which place of the trial it has, by time.
        place: usize,
        /// What ends it.
        until: Until,
    },
    /// The grey; the participant cannot end it.
    Grey {
        /// How long it stands at least, from its first frame on the display.
        duration_ns: u64,
    },
    /// The question.
    Ask(Ask),
}

/// What is asked at the end of a trial, and what stands on the screen meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ask {
    /// First or second, on a page of its own.
    Choice,
    /// Left or right, with both images and the reference between them on the screen.
    CloserToReference,
    /// One rating a scale of the protocol, on a page of its own.
    Ratings,
    /// The order of all images on the screen.
    Ranking,
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

/// How a trial begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TrialStart {
    /// By its own button on a page with one button a trial.
    Menu,
    /// By one button.
    Button,
    /// By itself, right after the answer to the one before.
    Itself,
}

/// Every procedure there is.
pub const PROCEDURES: &[&Procedure] = &[
    &no_reference::NO_REFERENCE,
    &no_reference_timed::NO_REFERENCE_TIMED,
    &rating::RATING,
    &reference::REFERENCE,
    &rank_order::RANK_ORDER,
];

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

/// The flaw of a field that only another procedure reads; `None` where it is not set.
fn needless(set: bool, field: &str, name: &str) -> Option<String> {
    set.then(|| {
        format!("field `{field}`: the procedure \"{name}\" has no use for it; leave it out")
    })
}

/// The image times, scales and reference that a procedure of choices has no use for.
fn plain_choice_flaw(protocol: &Protocol, timed: bool) -> Option<String> {
    let name = protocol.procedure.name;
    needless(!timed && protocol.image.is_some(), "image", name)
        .or_else(|| needless(!protocol.scales.is_empty(), "scales", name))
        .or_else(|| needless(protocol.reference.is_some(), "reference", name))
}

/// What a procedure without a choice between two images has no use for.
fn no_choice_flaw(protocol: &Protocol) -> Option<String> {
    let name = protocol.procedure.name;
    needless(protocol.cannot_tell, "cannot_tell", name)
        .or_else(|| needless(protocol.catch.is_some(), "catch", name))
        .or_else(|| needless(protocol.reference.is_some(), "reference", name))
}
