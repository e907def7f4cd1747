//! The scale where participants differ: Wald's interval takes votes as independent and is too short; that is
//! why there are intervals over resampled participants.

use greyfield::analysis::Settings;
use greyfield::analysis::dataset::Dataset;
use greyfield::analysis::scaling::{self, link::PROBIT_OF_JOD};
use greyfield::analysis::tails::normal_upper;
use rand_chacha::ChaCha20Rng;

use super::Effort;
use super::claim::{Claim, Measured, NEAR_95, Simulation};
use super::scales::pairs;
use super::study::{self, Trial, cell, chance, holds, normal};

/// Conditions of every pair: so many answers of a participant hang together.
const ANSWERS_A_PAIR: usize = 4;
/// Standard deviation of what a participant adds to a technique, by that of the noise in one answer.
const SPREAD: f64 = 0.7;
/// Resamples of the participants.
const RESAMPLES: u32 = 400;

/// Three techniques; the last against the first.
pub fn intervals(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for participants in effort.of(&[60], &[20, 36, 120]) {
        let simulation = Simulation {
            purpose: "inference-participants",
            seed: 20_130 + 100 * u64::from(participants),
            studies: if effort.wide { 30_000 } else { 300 },
        };
        let [wald, bootstrap] = simulation.count(|index, rng| {
            let (data, truth) = study(participants, rng);
            let settings = Settings {
                bootstrap: RESAMPLES,
                seed: index,
                ..Settings::default()
            };
            let section = study::section(&scaling::STATISTIC, &data, &settings);
            ["jod_ci", "jod_bootstrap"].map(|key| holds(cell(&section, "jod", key, 2), truth))
        });
        claims.extend(claimed(participants, wald, bootstrap));
    }
    claims
}

fn claimed(participants: u32, wald: Measured, bootstrap: Measured) -> [Claim; 2] {
    let name = format!("JOD, {participants} participants who differ");
    let resampled = format!("{name}: {RESAMPLES} resampled studies");
    [
        Claim::new(format!("{name}: Wald is too short"), 0.0..=0.9, wald),
        Claim::new(resampled, NEAR_95, bootstrap),
    ]
}

/// A participant adds SPREAD · N(0, 1) to every technique, for all answers. The difference of two techniques
/// has the variance 2 SPREAD² over participants, and one answer adds the noise's 1: over participants the model
/// holds with scales shrunk by √(1 + 2 SPREAD²), and that is what all intervals are of.
fn study(participants: u32, rng: &mut ChaCha20Rng) -> (Dataset, f64) {
    let pairs = pairs(3);
    let repeated: Vec<_> = (0..ANSWERS_A_PAIR)
        .flat_map(|_| pairs.iter().map(|(names, _)| *names))
        .collect();
    // By pair, as in `pairs`: the techniques' numbers.
    let numbers = [(0, 1), (0, 2), (1, 2)];
    let mut share = [0.0; 3];
    let data = study::answers(&repeated, participants, |_, condition| {
        if condition == 0 {
            let own = [(); 3].map(|()| SPREAD * normal(rng));
            for (share, ((_, jod), (a, b))) in share.iter_mut().zip(pairs.iter().zip(numbers)) {
                let distance = PROBIT_OF_JOD * jod + own[b] - own[a];
                *share = 1.0 - normal_upper(distance).value();
            }
        }
        Trial::choice(chance(rng, share[condition % 3]))
    });
    let shrunk = pairs[1].1 / (1.0 + 2.0 * SPREAD * SPREAD).sqrt();
    (data, shrunk)
}
