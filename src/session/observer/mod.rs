//! Scripted observers: they sit through the session a person sits through, in
//! virtual time. One file an observer, one line in [`KINDS`].

mod first;
mod random;

use std::fmt;
use std::str::FromStr;

use super::Answer;
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
    pub make: fn(&str) -> Result<Box<dyn Observer>, String>,
}

/// Every kind of observer.
pub const KINDS: &[&Kind] = &[&random::RANDOM, &first::FIRST];

/// An observer and the name it was made from.
#[derive(Debug)]
pub struct Scripted {
    /// As on the command line.
    pub name: String,
    /// The observer.
    pub observer: Box<dyn Observer>,
}

impl Scripted {
    /// Participant id of the `number`th such observer, from 1: `random1p0001`.
    #[must_use]
    pub fn participant_id(&self, number: u32) -> String {
        let plain: String = self
            .name
            .chars()
            .filter(char::is_ascii_alphanumeric)
            .collect();
        format!("{plain}p{number:04}")
    }
}

impl FromStr for Scripted {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, argument) = text.split_once(':').unwrap_or((text, ""));
        let Some(kind) = KINDS.iter().find(|kind| kind.name == name) else {
            let allowed: Vec<String> = KINDS.iter().map(ToString::to_string).collect();
            return Err(format!(
                "found {text:?}, allowed is {}",
                allowed.join(" or ")
            ));
        };
        let observer = (kind.make)(argument)
            .map_err(|message| format!("found {text:?}, {kind} needs {message}"))?;
        Ok(Self {
            name: text.to_owned(),
            observer,
        })
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
mod tests {
    use super::*;

    #[test]
    fn observers_are_named_as_on_the_command_line() {
        let random: Scripted = "random:17".parse().unwrap();
        assert_eq!(random.participant_id(3), "random17p0003");
        assert!("first".parse::<Scripted>().is_ok());
    }

    #[test]
    fn wrong_names_say_what_is_allowed() {
        for text in [
            "last",
            "random",
            "random:",
            "random:x",
            "random:-1",
            "first:1",
            "",
        ] {
            let message = text.parse::<Scripted>().unwrap_err();
            assert!(message.contains(&format!("{text:?}")), "{message}");
            assert!(
                message.contains("random:SEED") || message.contains("first needs"),
                "{message}"
            );
        }
    }
}
