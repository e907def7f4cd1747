//! A fair coin: what an effect of exactly nothing looks like.

use rand_chacha::ChaCha20Rng;

use super::{Behaviour, Kind, Observer, Question};
use crate::protocol::Position;
use crate::protocol::procedure::Ask;
use crate::seed;
use crate::session::Answer;

/// `random:SEED`.
pub const RANDOM: Kind = Kind {
    name: "random",
    argument: "SEED",
    summary: "chooses, rates and ranks by chance, after some seconds each",
    make: |argument, _| match argument.parse() {
        Ok(seed) => Ok(Box::new(Random { seed })),
        Err(_) => Err("a whole number from 0 behind the colon".to_owned()),
    },
};

#[derive(Debug)]
struct Random {
    seed: u64,
}

impl Observer for Random {
    fn behave(&self, question: &Question<'_>) -> Behaviour {
        let mut rng = seed::generator(self.seed, "observer-random", question.index());
        let looks_ns = [(); 2].map(|()| seconds_between(&mut rng, 2.0, 12.0));
        let decision_ns = seconds_between(&mut rng, 0.4, 2.0);
        Behaviour {
            looks_ns,
            decision_ns,
            answer: by_chance(&mut rng, question),
        }
    }
}

/// Any answer that fits, each equally often.
pub(super) fn by_chance(rng: &mut ChaCha20Rng, question: &Question<'_>) -> Answer {
    match question.ask {
        Ask::Choice | Ask::CloserToReference => {
            let answers = if question.protocol.cannot_tell { 3 } else { 2 };
            match seed::below(rng, answers) {
                0 => Answer::Choice(Position::First),
                1 => Answer::Choice(Position::Second),
                _ => Answer::CannotTell,
            }
        }
        Ask::Ratings => {
            let scales = question.protocol.scales.iter();
            Answer::Ratings(
                scales
                    .map(|scale| 1 + seed::below(rng, scale.points.get()))
                    .collect(),
            )
        }
        Ask::Ranking => {
            let mut places: Vec<usize> = (0..question.trial.places.len()).collect();
            seed::shuffle(rng, &mut places);
            Answer::Ranking(places)
        }
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 12e9
pub(super) fn seconds_between(rng: &mut ChaCha20Rng, low: f64, high: f64) -> u64 {
    ((low + (high - low) * seed::unit_f64(rng)) * 1e9) as u64
}
