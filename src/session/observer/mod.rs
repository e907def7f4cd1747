//! Scripted observers: they sit through the session a person sits through, in
//! virtual time. One file an observer, one line in [`KINDS`].

mod first;
mod model;
mod options;
mod qualities;
mod random;
pub mod share;

use std::fmt;

pub use qualities::{Distances, Metric, Needs, Qualities};
pub use share::Share;

use super::Answer;
use crate::digest;
use crate::protocol::procedure::{Ask, Step};
use crate::protocol::{Protocol, SessionPlan, Trial};

/// What an observer does in one trial.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Behaviour {
    /// How long the images that end with a key are looked at, by place.
    pub looks_ns: [u64; 2],
    /// From the question to the answer.
    pub decision_ns: u64,
    /// The answer.
    pub answer: Answer,
}

/// What an observer is asked, and everything it may know.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// The session it sits.
    pub plan: &'a SessionPlan,
    /// The trial.
    pub trial: &'a Trial,
    /// What the trial asks.
    pub ask: Ask,
    /// The protocol.
    pub protocol: &'a Protocol,
}

impl<'a> Question<'a> {
    /// The question of a trial under a protocol.
    #[must_use]
    pub fn new(protocol: &'a Protocol, plan: &'a SessionPlan, trial: &'a Trial) -> Self {
        let steps = (protocol.procedure.steps)(protocol);
        let ask = match steps.last() {
            Some(Step::Ask(ask)) => *ask,
            // Every procedure ends with a question; a test holds that.
            _ => Ask::Choice,
        };
        Self {
            plan,
            trial,
            ask,
            protocol,
        }
    }

    /// A number that is this slot's and this trial's alone, for generators.
    #[must_use]
    pub fn index(&self) -> u64 {
        (u64::from(self.plan.slot) << 32) | self.trial.index as u64
    }
}

/// A scripted observer. Its behaviour is a pure function of its own seed, the slot
/// and the trial, so that a session that was interrupted goes on as it would have.
pub trait Observer: fmt::Debug {
    /// What the participant does in this trial.
    fn behave(&self, question: &Question<'_>) -> Behaviour;
}

/// An observer, or what it needs, as the end of a sentence.
pub type Made = Result<Box<dyn Observer>, String>;

/// A kind of observer that `--observer` can name.
#[derive(Debug)]
pub struct Kind {
    /// Name before the colon.
    pub name: &'static str,
    /// What stands behind the colon, such as `SEED`; empty for nothing.
    pub argument: &'static str,
    /// What it does, in one sentence.
    pub summary: &'static str,
    /// Makes one from what stands behind the colon.
    pub make: fn(&str, &Needs<'_>) -> Made,
}

/// Every kind of observer.
pub const KINDS: &[&Kind] = &[&random::RANDOM, &first::FIRST, &model::MODEL, &share::SHARE];

/// An observer and the name it was made from.
#[derive(Debug)]
pub struct Scripted {
    /// As on the command line.
    pub name: String,
    /// The observer.
    pub observer: Box<dyn Observer>,
}

impl Scripted {
    /// The observer of a name such as `random:1`.
    ///
    /// # Errors
    /// What was found and what is allowed.
    pub fn new(text: &str, needs: &Needs<'_>) -> Result<Self, String> {
        let (name, argument) = text.split_once(':').unwrap_or((text, ""));
        let Some(kind) = KINDS.iter().find(|kind| kind.name == name) else {
            let allowed: Vec<String> = KINDS.iter().map(ToString::to_string).collect();
            return Err(format!(
                "found {text:?}, allowed is {}",
                allowed.join(" or ")
            ));
        };
        let observer = (kind.make)(argument, needs)
            .map_err(|message| format!("found {text:?}, {kind} needs {message}"))?;
        Ok(Self {
            name: text.to_owned(),
            observer,
        })
    }

    /// Participant id of the `number`th such observer, from 1: `random1p0001`. A name with
    /// options has a checksum in their place, so that two observers are never one participant.
    #[must_use]
    pub fn participant_id(&self, number: u32) -> String {
        let plain = |text: &str| -> String {
            let letters = text.chars().filter(char::is_ascii_alphanumeric);
            letters.collect()
        };
        match self.name.split_once(',') {
            None => format!("{}p{number:04}", plain(&self.name)),
            Some((head, _)) => {
                let checksum = digest::sha256_hex(self.name.as_bytes());
                format!("{}x{}p{number:04}", plain(head), &checksum[..8])
            }
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.argument.is_empty() {
            f.write_str(self.name)
        } else {
            write!(f, "{}:{}", self.name, self.argument)
        }
    }
}

#[cfg(test)]
mod tests;
