//! Intervals of response times and of the common odds ratio, and sizes of the tests beside them.

use greyfield::analysis::dataset::{Dataset, Order};
use greyfield::analysis::{Settings, cochran_q, order_effect, response_times};
use rand_chacha::ChaCha20Rng;

use super::Effort;
use super::claim::{AT_MOST_5_5, Claim, NEAR_95, Simulation};
use super::study::{self, Trial, cell, chance, holds, logistic, normal, rejects, skewed};

const PAIR: (&str, &str) = ("x", "y");
const CONDITIONS: usize = 7;
/// Mean of ln t, t in milliseconds.
const MEAN_LN: f64 = 7.5;
/// Standard deviation of ln t.
const SD_LN: f64 = 0.6;

/// The geometric mean of one condition: ln t normal, and ln t skewed.
pub fn geometric_mean(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36], &[10, 100]) {
        let simulation = Simulation {
            purpose: "inference-times",
            seed: 20_140 + 100 * u64::from(n),
            studies: 4000 * effort.times,
        };
        let [of_normal, of_skewed] = simulation.count(|_, rng| {
            [
                covers_mean(n, 0.05, || normal(rng)),
                covers_mean(n, 0.05, || skewed(rng)),
            ]
        });
        let name = format!("geometric mean time, {n} participants");
        claims.push(Claim::new(
            format!("{name}: ln t normal"),
            NEAR_95,
            of_normal,
        ));
        let what = format!("{name}: ln t of skewness 1");
        claims.push(if n >= 36 {
            Claim::new(what, NEAR_95, of_skewed)
        } else {
            Claim::told(what, of_skewed)
        });
    }
    claims
}

/// An interval that is claimed to be one of 95 % and is one of 90 %: what must be refuted.
pub fn ninety_percent_interval(effort: Effort) -> Claim {
    let simulation = Simulation {
        purpose: "inference-times",
        seed: 20_141,
        studies: 4000 * effort.times,
    };
    let [measured] = simulation.count(|_, rng| [covers_mean(36, 0.10, || normal(rng))]);
    Claim::new("an interval of 90 % told as one of 95 %", NEAR_95, measured)
}

fn covers_mean(n: u32, alpha: f64, mut standard: impl FnMut() -> f64) -> bool {
    let data = study::answers(&[PAIR], n, |participant, _| Trial {
        order: Order::AThenB,
        for_b: participant.is_multiple_of(2),
        time_ms: Some((MEAN_LN + SD_LN * standard()).exp() as f32),
    });
    let settings = Settings {
        alpha: alpha.try_into().unwrap_or_default(),
        ..Settings::default()
    };
    let section = study::section(&response_times::STATISTIC, &data, &settings);
    let interval = cell(&section, "by_condition", "geometric_mean_ms_ci", 0);
    holds(interval, MEAN_LN.exp())
}

/// Times by the position chosen, participants of different speed; and Friedman's test of conditions that do
/// not differ.
pub fn times_by_position(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36], &[20, 100]) {
        let simulation = Simulation {
            purpose: "inference-times-by-position",
            seed: 20_142 + 100 * u64::from(n),
            studies: 4000 * effort.times,
        };
        let [covered, friedman] = simulation.count(|_, rng| {
            let data = slower_when_second(n, rng);
            let section = study::section(&response_times::STATISTIC, &data, &Settings::default());
            let interval = cell(&section, "position_test", "ratio_ci", 0);
            let p = cell(&section, "condition_test", "p_friedman", 0);
            [holds(interval, RATIO), rejects(p)]
        });
        claims.push(Claim::new(
            format!("ratio of times by position, {n} participants, 7 conditions"),
            NEAR_95,
            covered,
        ));
        claims.push(Claim::new(
            format!("Friedman's test of times, {n} participants, 7 equal conditions: size"),
            AT_MOST_5_5,
            friedman,
        ));
    }
    claims
}

/// Time choosing first by time choosing second.
const RATIO: f64 = 0.9;

fn slower_when_second(n: u32, rng: &mut ChaCha20Rng) -> Dataset {
    let mut own = 0.0;
    study::answers(&[PAIR; CONDITIONS], n, |_, condition| {
        if condition == 0 {
            own = 0.4 * normal(rng);
        }
        let for_b = chance(rng, 0.5);
        let gain = if for_b { 0.0 } else { RATIO.ln() };
        Trial {
            order: Order::AThenB,
            for_b,
            time_ms: Some((MEAN_LN + own + gain + SD_LN * normal(rng)).exp() as f32),
        }
    })
}

/// Mantel and Haenszel's odds ratio over seven conditions of different preference; the sizes of the test of it
/// and of homogeneity where there is no order effect and where it is the same everywhere.
pub fn odds_ratio(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36], &[20, 100]) {
        for (ratio, seed) in [(1.0, 20_150_u64), (2.0, 20_151)] {
            let simulation = Simulation {
                purpose: "inference-odds-ratio",
                seed: seed + 100 * u64::from(n),
                studies: 4000 * effort.times,
            };
            let [covered, found, unlike] = simulation.count(|_, rng| {
                let data = by_order(n, ratio, rng);
                let section = study::section(&order_effect::STATISTIC, &data, &Settings::default());
                let of = |key| cell(&section, "test", key, 0);
                let covered = holds(of("odds_ratio_ci"), ratio);
                [
                    covered,
                    rejects(of("p_chi_square")),
                    rejects(of("p_homogeneity")),
                ]
            });
            let name = format!("7 conditions, {n} participants, true odds ratio {ratio}");
            claims.push(Claim::new(
                format!("common odds ratio, {name}"),
                NEAR_95,
                covered,
            ));
            if ratio == 1.0 {
                let what = format!("Cochran–Mantel–Haenszel, {name}: size");
                claims.push(Claim::new(what, AT_MOST_5_5, found));
            }
            let what = format!("homogeneity of odds ratios, {name}: size");
            // An approximation that wants many answers in each condition, as its section says.
            claims.push(if n >= 100 {
                Claim::new(what, AT_MOST_5_5, unlike)
            } else {
                Claim::told(what, unlike)
            });
        }
    }
    claims
}

fn by_order(n: u32, ratio: f64, rng: &mut ChaCha20Rng) -> Dataset {
    study::answers(&[PAIR; CONDITIONS], n, |participant, condition| {
        let turned = !(participant as usize + condition).is_multiple_of(2);
        // From −1 to 1: shares of b from 27 to 73 %.
        let preference = condition as f64 / 3.0 - 1.0;
        let half = ratio.ln() / 2.0;
        let (order, logit) = if turned {
            (Order::BThenA, preference - half)
        } else {
            (Order::AThenB, preference + half)
        };
        Trial {
            order,
            for_b: chance(rng, logistic(logit)),
            time_ms: None,
        }
    })
}

/// Cochran's Q where every participant has an own preference, the same in all conditions.
pub fn cochran(effort: Effort) -> Vec<Claim> {
    let simulation = Simulation {
        purpose: "inference-cochran",
        seed: 20_160,
        studies: 2000 * effort.times,
    };
    let [chi_square, exact] = simulation.count(|_, rng| {
        let mut own = 0.5;
        let data = study::answers(&[PAIR; 4], 36, |_, condition| {
            if condition == 0 {
                own = logistic(1.5 * normal(rng));
            }
            Trial::choice(chance(rng, own))
        });
        let section = study::section(&cochran_q::STATISTIC, &data, &Settings::default());
        ["p_chi_square", "p_exact"].map(|key| rejects(cell(&section, "families", key, 0)))
    });
    [("chi-square", chi_square), ("exact", exact)]
        .map(|(name, measured)| {
            let what = format!("Cochran's Q ({name}), 4 equal conditions, 36 participants: size");
            Claim::new(what, AT_MOST_5_5, measured)
        })
        .to_vec()
}
