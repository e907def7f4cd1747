//! A fair coin: what an effect of exactly nothing looks like.

use rand_chacha::ChaCha20Rng;

use super::{Behaviour, Kind, Observer};
use crate::protocol::{Position, SessionPlan, Trial};
use crate::seed;

/// `random:SEED`.
pub const RANDOM: Kind = Kind {
    name: "random",
    argument: "SEED",
    summary: "chooses by a fair coin, after some seconds each",
    make: |argument| match argument.parse() {
        Ok(seed) => Ok(Box::new(Random { seed })),
        Err(_) => Err("a whole number from 0 behind the colon".to_owned()),
    },
};

#[derive(Debug)]
struct Random {
    seed: u64,
}

impl Observer for Random {
    fn behave(&self, plan: &SessionPlan, trial: &Trial) -> Behaviour {
        let index = (u64::from(plan.slot) << 32) | trial.index as u64;
        let mut rng = seed::generator(self.seed, "observer-random", index);
        Behaviour {
            first_look_ns: seconds_between(&mut rng, 2.0, 12.0),
            second_look_ns: seconds_between(&mut rng, 2.0, 12.0),
            decision_ns: seconds_between(&mut rng, 0.4, 2.0),
            choice: if seed::below(&mut rng, 2) == 0 {
                Position::First
            } else {
                Position::Second
            },
        }
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 12e9
fn seconds_between(rng: &mut ChaCha20Rng, low: f64, high: f64) -> u64 {
    ((low + (high - low) * seed::unit_f64(rng)) * 1e9) as u64
}
