//! Wald intervals of scales, votes independent.

use greyfield::analysis::dataset::{Dataset, Order};
use greyfield::analysis::scaling::link::{Link, PROBIT_OF_JOD};
use greyfield::analysis::tails::normal_upper;
use rand_chacha::ChaCha20Rng;

use super::Effort;
use super::claim::{Claim, NEAR_95, Simulation};
use super::study::{self, Trial, cell, chance, holds, logistic};

/// Four techniques, and where they stand in JOD: in units in which 1 is 75 % preferred.
const TECHNIQUES: [(&str, f64); 4] = [("s", 0.0), ("t", 0.5), ("u", 1.0), ("v", 1.5)];
/// One JOD in logits.
const LOGIT_OF_JOD: f64 = 1.098_612_288_668_109_8;

/// Share preferred at a distance in JOD.
pub fn preferred(link: Link, jod: f64) -> f64 {
    match link {
        Link::Thurstone => 1.0 - normal_upper(PROBIT_OF_JOD * jod).value(),
        Link::BradleyTerry => logistic(LOGIT_OF_JOD * jod),
    }
}

/// All pairs of the first techniques, and their distances b − a in JOD.
pub fn pairs(techniques: usize) -> Vec<((&'static str, &'static str), f64)> {
    let used = &TECHNIQUES[..techniques];
    let of = |(at, (a, low)): (usize, &(&'static str, f64))| {
        let (a, low) = (*a, *low);
        (used[at + 1..].iter()).map(move |(b, high)| ((a, *b), high - low))
    };
    used.iter().enumerate().flat_map(of).collect()
}

/// Every technique against the first, and the last against the one before, under the model that is fitted.
pub fn wald(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36], &[18, 72, 150]) {
        for (link, seed) in [(Link::Thurstone, 20_120), (Link::BradleyTerry, 20_121)] {
            let simulation = Simulation {
                purpose: "inference-wald",
                seed: seed + 100 * u64::from(n),
                studies: 4000 * effort.times,
            };
            let [second, third, fourth, difference] =
                simulation.count(|_, rng| wald_study(link, n, rng));
            let name = format!("{}, 4 techniques, {n} votes a pair", link.name());
            for (jod, measured) in [(0.5, second), (1.0, third), (1.5, fourth)] {
                claims.push(Claim::new(format!("{name}: {jod} JOD"), NEAR_95, measured));
            }
            if link == Link::Thurstone {
                claims.push(Claim::new(
                    format!("{name}: difference of two"),
                    NEAR_95,
                    difference,
                ));
            }
        }
    }
    claims
}

fn wald_study(link: Link, n: u32, rng: &mut ChaCha20Rng) -> [bool; 4] {
    let data = study::counts(
        (pairs(TECHNIQUES.len()).into_iter())
            .map(|(pair, jod)| (pair, study::votes(rng, n, preferred(link, jod)))),
    );
    let scaling = study::scaling(&data);
    let (table, key, unit) = match link {
        Link::Thurstone => ("jod", "jod_ci", 1.0),
        Link::BradleyTerry => ("bradley_terry", "logit_ci", LOGIT_OF_JOD),
    };
    let of = |row: usize| holds(cell(&scaling, table, key, row), unit * TECHNIQUES[row].1);
    // The last row of the pairs is that of the last two techniques.
    let last = cell(&scaling, "pairwise", "difference_ci", 5);
    let difference = holds(last, TECHNIQUES[3].1 - TECHNIQUES[2].1);
    [of(1), of(2), of(3), difference]
}

/// Davidson and Beaver's order effect, three techniques.
pub fn order_effect(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36], &[72]) {
        let simulation = Simulation {
            purpose: "inference-order-effect",
            seed: 20_122 + 100 * u64::from(n),
            studies: 2000 * effort.times,
        };
        let [covered] = simulation.count(|_, rng| {
            let scaling = study::scaling(&shown_in_both_orders(n, rng));
            [holds(cell(&scaling, "order_effect", "delta_ci", 0), DELTA)]
        });
        claims.push(Claim::new(
            format!("order effect δ, 3 techniques, {n} participants"),
            NEAR_95,
            covered,
        ));
    }
    claims
}

/// What the image shown first gains, in logits.
const DELTA: f64 = 0.4;

fn shown_in_both_orders(participants: u32, rng: &mut ChaCha20Rng) -> Dataset {
    let pairs = pairs(3);
    let names: Vec<_> = pairs.iter().map(|(pair, _)| *pair).collect();
    study::answers(&names, participants, |participant, condition| {
        let (order, gain) = if (participant as usize + condition).is_multiple_of(2) {
            (Order::AThenB, -DELTA)
        } else {
            (Order::BThenA, DELTA)
        };
        let for_b = chance(rng, logistic(LOGIT_OF_JOD * pairs[condition].1 + gain));
        Trial {
            order,
            for_b,
            time_ms: None,
        }
    })
}
