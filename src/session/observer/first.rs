//! Always the image shown first: what a position bias alone looks like.

use super::{Behaviour, Kind, Observer};
use crate::protocol::{Position, SessionPlan, Trial};

/// `first`.
pub const FIRST: Kind = Kind {
    name: "first",
    argument: "",
    summary: "chooses the image shown first, after a second each",
    make: |argument| {
        if argument.is_empty() {
            Ok(Box::new(First))
        } else {
            Err("nothing behind the colon".to_owned())
        }
    },
};

#[derive(Debug)]
struct First;

impl Observer for First {
    fn behave(&self, _plan: &SessionPlan, _trial: &Trial) -> Behaviour {
        Behaviour {
            first_look_ns: 1_000_000_000,
            second_look_ns: 1_000_000_000,
            decision_ns: 1_000_000_000,
            choice: Position::First,
        }
    }
}
