//! Always the image shown first: what a position bias alone looks like.

use super::{Behaviour, Kind, Observer, Question};
use crate::protocol::Position;
use crate::protocol::procedure::Ask;
use crate::session::Answer;

/// `first`.
pub const FIRST: Kind = Kind {
    name: "first",
    argument: "",
    summary: "chooses the image shown first, rates all alike, ranks as shown, after a second each",
    make: |argument, _| {
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
    fn behave(&self, question: &Question<'_>) -> Behaviour {
        let answer = match question.ask {
            Ask::Choice | Ask::CloserToReference => Answer::Choice(Position::First),
            Ask::Ratings => Answer::Ratings(vec![1; question.protocol.scales.len()]),
            Ask::Ranking => Answer::Ranking((0..question.trial.places.len()).collect()),
        };
        Behaviour {
            looks_ns: [1_000_000_000; 2],
            decision_ns: 1_000_000_000,
            answer,
        }
    }
}
