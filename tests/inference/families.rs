//! Errors over families of tests: the verdicts, McNemar's pairs, Benjamini and Hochberg's discoveries.

use greyfield::analysis::conditions::{Family, Verdict, main_family};
use greyfield::analysis::dataset::{Dataset, Votes};
use greyfield::analysis::{Settings, benjamini_hochberg, exact_binomial, mcnemar};
use greyfield::seed;
use rand_chacha::ChaCha20Rng;

use super::Effort;
use super::claim::{AT_MOST_5_5, Claim, Measured, Simulation};
use super::shares::{exact_p, size};
use super::study::{self, Trial, cell, chance, logistic, normal, rejects};

const PAIR: (&str, &str) = ("x", "y");
const CONDITIONS: usize = 7;
const PARTICIPANTS: u32 = 36;

/// How the answers of one participant hang together, where all conditions are even splits.
#[derive(Debug, Clone, Copy)]
enum Dependence {
    /// Not at all.
    None,
    /// Four of five answers are the participant's own side, ½ for either.
    Strong,
    /// One toss for all conditions.
    SameCoin,
}

/// The chance of any false `significant`.
pub fn verdicts(effort: Effort) -> Vec<Claim> {
    let name = format!("any false verdict of {CONDITIONS}, n = {PARTICIPANTS}");
    let mut claims = Vec::new();
    for (dependence, what, seed) in [
        (Dependence::None, "independent answers", 20_170),
        (Dependence::Strong, "participants with a side", 20_171),
        (Dependence::SameCoin, "one coin a participant", 20_172),
    ] {
        let simulation = Simulation {
            purpose: "inference-verdicts",
            seed,
            studies: 10_000 * effort.times,
        };
        let [holm, uncorrected] = simulation.count(|_, rng| false_verdicts(dependence, rng));
        claims.push(Claim::new(
            format!("{name}, {what}: Holm"),
            AT_MOST_5_5,
            holm,
        ));
        claims.push(match dependence {
            // 1 − (1 − size)⁷ = 18.5 %.
            Dependence::None => Claim::new(
                format!("{name}, {what}: without correction far too many"),
                0.15..=1.0,
                uncorrected,
            ),
            _ => Claim::told(format!("{name}, {what}: without correction"), uncorrected),
        });
    }
    // Under independence any adjusted p is at most alpha where the smallest p is at most alpha/7.
    let one = size(PARTICIPANTS, 0.05 / CONDITIONS as f64, exact_p);
    let any = 1.0 - (1.0 - one).powi(CONDITIONS as i32);
    let what = format!("{name}, independent answers: Holm, all cases summed");
    claims.push(Claim::new(what, AT_MOST_5_5, Measured::Exact(any)));
    claims
}

/// Whether anything is significant after Holm, and without a correction.
fn false_verdicts(dependence: Dependence, rng: &mut ChaCha20Rng) -> [bool; 2] {
    let mut votes = [Votes::default(); CONDITIONS];
    for _ in 0..PARTICIPANTS {
        let side = chance(rng, 0.5);
        for votes in &mut votes {
            let for_b = match dependence {
                Dependence::None => chance(rng, 0.5),
                Dependence::Strong => chance(rng, 0.8) == side,
                Dependence::SameCoin => side,
            };
            *(if for_b { &mut votes.b } else { &mut votes.a }) += 1;
        }
    }
    let data = study::counts(votes.map(|votes| (PAIR, votes)));
    let found = verdicts_of(&data);
    let any = |wanted: &[Verdict]| found.iter().any(|it| wanted.contains(it));
    [
        any(&[Verdict::Significant]),
        any(&[Verdict::Significant, Verdict::OnlyUncorrected]),
    ]
}

fn verdicts_of(data: &Dataset) -> Vec<Verdict> {
    let settings = Settings::default();
    let family = main_family(data, &settings);
    (0..data.conditions.len())
        .map(|condition| family.verdict(condition, &settings))
        .collect()
}

/// Three conditions with a preference, four without: any of the four called significant.
pub fn verdicts_beside_true_ones(effort: Effort) -> Vec<Claim> {
    let simulation = Simulation {
        purpose: "inference-verdicts-mixed",
        seed: 20_173,
        studies: 10_000 * effort.times,
    };
    let [measured] = simulation.count(|_, rng| {
        let shares = [0.8, 0.8, 0.8, 0.5, 0.5, 0.5, 0.5];
        let data =
            study::counts(shares.map(|share| (PAIR, study::votes(rng, PARTICIPANTS, share))));
        [verdicts_of(&data)[3..].contains(&Verdict::Significant)]
    });
    vec![Claim::new(
        "any false verdict of 4 beside 3 true ones of 80 %, n = 36: Holm",
        AT_MOST_5_5,
        measured,
    )]
}

/// Any difference that McNemar's tests find between seven conditions in which everybody answers by an own
/// preference, the same in all.
pub fn mcnemar_pairs(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (spread, what, seed) in [
        (0.0, "independent answers", 20_174),
        (2.0, "participants who differ", 20_175),
    ] {
        let simulation = Simulation {
            purpose: "inference-mcnemar",
            seed,
            studies: 4000 * effort.times,
        };
        let [measured] = simulation.count(|_, rng| {
            let mut own = 0.5;
            let data = study::answers(&[PAIR; CONDITIONS], PARTICIPANTS, |_, condition| {
                if condition == 0 {
                    own = logistic(spread * normal(rng));
                }
                Trial::choice(chance(rng, own))
            });
            let section = study::section(&mcnemar::STATISTIC, &data, &Settings::default());
            let pairs = CONDITIONS * (CONDITIONS - 1) / 2;
            [(0..pairs).any(|row| rejects(cell(&section, "pairs", "p_exact_holm", row)))]
        });
        claims.push(Claim::new(
            format!("any of McNemar's 21 pairs, n = 36, {what}: Holm"),
            AT_MOST_5_5,
            measured,
        ));
    }
    claims
}

/// Ten conditions with a preference, ten without: the expected share of false ones among the discoveries. One
/// discovery of a study, drawn at random, is false with exactly that probability, so that studies can be
/// counted.
pub fn false_discoveries(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (n, seed) in effort.of(&[(36, 20_176)], &[(100, 20_177)]) {
        let simulation = Simulation {
            purpose: "inference-false-discoveries",
            seed,
            studies: 10_000 * effort.times,
        };
        let [measured] = simulation.count(|_, rng| {
            let share = |condition| if condition < 10 { 0.5 } else { 0.75 };
            let data = study::counts(
                (0..20).map(|condition| (PAIR, study::votes(rng, n, share(condition)))),
            );
            let found = discoveries(&data);
            let drawn = found.len().max(1) as u32;
            let one = found.get(seed::below(rng, drawn) as usize);
            [one.is_some_and(|condition| *condition < 10)]
        });
        claims.push(Claim::new(
            format!("false discoveries, 10 of 20 even, n = {n}: Benjamini–Hochberg"),
            AT_MOST_5_5,
            measured,
        ));
    }
    claims
}

/// Conditions that Benjamini and Hochberg's correction of the exact p leaves at 5 % or under.
fn discoveries(data: &Dataset) -> Vec<usize> {
    let settings = Settings::default();
    let Some(test) = exact_binomial::STATISTIC.test else {
        return Vec::new();
    };
    let family = Family::new(&test, &benjamini_hochberg::CORRECTION, data, &settings);
    (family.corrected.iter().enumerate())
        .filter(|(_, p)| p.is_ok_and(|p| p.at_most(settings.alpha)))
        .map(|(condition, _)| condition)
        .collect()
}
