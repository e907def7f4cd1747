//! Optional stopping: whoever looks after every answer and stops when it pays.

use std::ops::RangeInclusive;

use greyfield::analysis::dataset::{Answer, Votes};
use greyfield::analysis::tails::Alpha;
use greyfield::analysis::{Settings, exact_binomial, sequential};

use super::Effort;
use super::claim::{AT_LEAST_95, AT_MOST_5, Claim, Measured, Simulation};
use super::study::{self, Trial, cell, chance, rejects};

const PAIR: (&str, &str) = ("x", "y");
/// When the exact p is looked at. Before it cannot be at most 5 %.
const LOOKS: RangeInclusive<u32> = 5..=100;

/// An even split, up to a hundred answers: the exact p of every look, and the anytime-valid p of the study.
pub fn looks(effort: Effort) -> Vec<Claim> {
    let simulation = Simulation {
        purpose: "inference-stopping",
        seed: 20_180,
        studies: 4000 * effort.times,
    };
    let [peeked, anytime, once] = simulation.count(|_, rng| {
        let data = study::answers(&[PAIR], *LOOKS.end(), |_, _| {
            Trial::choice(chance(rng, 0.5))
        });
        let section = study::section(&sequential::STATISTIC, &data, &Settings::default());
        let anytime = cell(&section, "by_condition", "p_anytime", 0);
        let peeked = ever(&data.answers, exact_rejects);
        [
            peeked,
            rejects(anytime),
            exact_rejects(data.conditions[0].votes),
        ]
    });
    let name = "an even split, a look after every answer to 100";
    vec![
        Claim::new(format!("{name}: exact p, far too many"), 0.15..=1.0, peeked),
        Claim::new(
            format!("{name}: exact p, all paths summed"),
            0.15..=1.0,
            Measured::Exact(ever_of_all(LOOKS, exact_rejects)),
        ),
        Claim::new(format!("{name}: anytime-valid p"), AT_MOST_5, anytime),
        Claim::new(
            format!("{name}: anytime-valid p, all paths summed"),
            AT_MOST_5,
            Measured::Exact(ever_of_all(1..=*LOOKS.end(), anytime_rejects)),
        ),
        Claim::new("an even split, one look at 100: exact p", AT_MOST_5, once),
    ]
}

fn exact_rejects(votes: Votes) -> bool {
    exact_binomial::exact_p(votes).is_ok_and(|p| p.at_most(Alpha::FIVE_PERCENT))
}

fn anytime_rejects(votes: Votes) -> bool {
    sequential::ln_e_value(votes) >= 20_f64.ln()
}

/// Whether some look at these answers rejects.
fn ever(answers: &[Answer], rejects: fn(Votes) -> bool) -> bool {
    let mut votes = Votes::default();
    answers.iter().any(|answer| {
        let for_b = answer.chose_b().unwrap_or_default();
        *(if for_b { &mut votes.b } else { &mut votes.a }) += 1;
        LOOKS.contains(&votes.total()) && rejects(votes)
    })
}

/// The probability that some look at an even split rejects, summed over all paths.
fn ever_of_all(looks: RangeInclusive<u32>, rejects: fn(Votes) -> bool) -> f64 {
    let mut rejected = 0.0;
    // By votes for b: the probability of coming here without a rejection.
    let mut paths = vec![1.0];
    for n in 1..=*looks.end() {
        let mut next = vec![0.0; n as usize + 1];
        for (b, path) in paths.iter().enumerate() {
            next[b] += path / 2.0;
            next[b + 1] += path / 2.0;
        }
        for (b, path) in (0..=n).zip(&mut next) {
            if looks.contains(&n) && rejects(Votes { a: n - b, b }) {
                rejected += std::mem::take(path);
            }
        }
        paths = next;
    }
    rejected
}

/// Seven even splits, stopped as soon as one of them is significant after Holm.
pub fn family(effort: Effort) -> Vec<Claim> {
    let simulation = Simulation {
        purpose: "inference-stopping-family",
        seed: 20_181,
        studies: 2000 * effort.times,
    };
    let [measured] = simulation.count(|_, rng| {
        let data = study::answers(&[PAIR; 7], 100, |_, _| Trial::choice(chance(rng, 0.5)));
        let section = study::section(&sequential::STATISTIC, &data, &Settings::default());
        [(0..7).any(|row| rejects(cell(&section, "by_condition", "p_anytime_holm", row)))]
    });
    vec![Claim::new(
        "any of 7 even splits, a look after every participant to 100: anytime-valid p, Holm",
        AT_MOST_5,
        measured,
    )]
}

/// A confidence sequence holds the share at every one of a hundred looks.
pub fn confidence_sequence(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (share, seed) in effort.of(&[(0.7, 20_182)], &[(0.5, 20_183), (0.95, 20_184)]) {
        let simulation = Simulation {
            purpose: "inference-confidence-sequence",
            seed,
            studies: 500 * effort.times,
        };
        let [measured] = simulation.count(|_, rng| {
            let mut monitor = sequential::Monitor::default();
            [(0..100).all(|_| {
                monitor.vote(chance(rng, share));
                let interval = monitor.interval(Alpha::FIVE_PERCENT);
                (interval.low..=interval.high).contains(&share)
            })]
        });
        claims.push(Claim::new(
            format!("confidence sequence of a share of {share}, at all of 100 looks"),
            AT_LEAST_95,
            measured,
        ));
    }
    claims
}
