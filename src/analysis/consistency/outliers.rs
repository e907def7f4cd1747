//! How far each observer's choices are from what the others chose. One answer a condition is enough.

use super::names;
use crate::analysis::conclusion::plural;
use crate::analysis::dataset::Dataset;
use crate::analysis::table::{Cell, Undefined};

/// So many interquartile ranges under the lower quartile an observer is flagged (Tukey's fence).
pub const FAR: f64 = 1.5;
/// With fewer observers quartiles say nothing.
const FEWEST: usize = 5;

/// What one answer to a condition says.
#[derive(Debug, Clone, Copy, Default)]
struct Said {
    /// ln of the share of the others who chose the same.
    ln_share: f64,
    /// In halves: 2 with the others' majority, 1 where they are even, 0 against it.
    with_majority: u32,
}

/// A condition seen from one of its observers.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    a: Said,
    b: Said,
    mean: f64,
    variance: f64,
    is_shared: bool,
}

impl Seen {
    /// The share of the others is (votes − 1 + ½)/((n − 1) + 1): half a vote is added to either side,
    /// so that being the only one does not weigh without end.
    fn of(a: u32, b: u32) -> Self {
        let n = f64::from(a) + f64::from(b);
        if n < 2.0 {
            return Self::default();
        }
        let said = |own: u32, other: u32| Said {
            // Asked for only where somebody chose it; at least one vote keeps it finite.
            ln_share: ((f64::from(own.max(1)) - 0.5) / n).ln(),
            with_majority: match (own.max(1) - 1).cmp(&other) {
                std::cmp::Ordering::Less => 0,
                std::cmp::Ordering::Equal => 1,
                std::cmp::Ordering::Greater => 2,
            },
        };
        let (for_a, for_b) = (said(a, b), said(b, a));
        let (p, q) = (f64::from(a) / n, f64::from(b) / n);
        Self {
            a: for_a,
            b: for_b,
            mean: p * for_a.ln_share + q * for_b.ln_share,
            variance: p * q * (for_a.ln_share - for_b.ln_share).powi(2),
            is_shared: true,
        }
    }
}

/// One observer's sums.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    answers: u32,
    with_majority: u32,
    ln_share: f64,
    excess: f64,
    variance: f64,
}

impl Sums {
    /// How much more the observer agrees with the others than those agree among themselves, in
    /// standard deviations.
    fn z(&self) -> Option<f64> {
        (self.variance > 0.0).then(|| self.excess / self.variance.sqrt())
    }
}

/// All observers' sums, and the quartiles of their z.
#[derive(Debug, Clone)]
pub struct Outliers {
    observers: Vec<Sums>,
    /// Lower quartile and interquartile range.
    quartiles: Result<(f64, f64), Undefined>,
}

impl Outliers {
    /// One pass over the answers.
    #[must_use]
    pub fn of(data: &Dataset) -> Self {
        let seen: Vec<Seen> = data
            .conditions
            .iter()
            .map(|condition| Seen::of(condition.votes.a, condition.votes.b))
            .collect();
        let mut observers = vec![Sums::default(); data.participants.len()];
        for answer in &data.answers {
            let Some(chose_b) = answer.chose_b() else {
                continue;
            };
            let seen = &seen[answer.condition as usize];
            if !seen.is_shared {
                continue;
            }
            let said = if chose_b { &seen.b } else { &seen.a };
            let sums = &mut observers[answer.participant as usize];
            sums.answers += 1;
            sums.with_majority += said.with_majority;
            sums.ln_share += said.ln_share;
            sums.excess += said.ln_share - seen.mean;
            sums.variance += seen.variance;
        }
        Self {
            quartiles: quartiles(&observers),
            observers,
        }
    }

    /// Whether anybody can be told from anybody.
    #[must_use]
    pub fn is_defined(&self) -> bool {
        self.observers.iter().any(|sums| sums.z().is_some())
    }

    /// Interquartile ranges under the lower quartile, 0 for who is not under it.
    fn score(&self, participant: usize) -> Result<f64, Undefined> {
        let z = self.observers[participant].z().ok_or(NOTHING_TOLD)?;
        let (lower, range) = self.quartiles?;
        Ok(((lower - z) / range).max(0.0))
    }

    /// Who is far out.
    #[must_use]
    pub fn flagged(&self) -> Vec<usize> {
        (0..self.observers.len())
            .filter(|at| self.score(*at).is_ok_and(|score| score > FAR))
            .collect()
    }

    /// Answers, agreement, mean ln p, z, score.
    pub(super) fn cells(&self, participant: usize) -> [Cell; 5] {
        let sums = &self.observers[participant];
        let n = f64::from(sums.answers);
        let mean = |sum: f64| {
            if sums.answers == 0 {
                Cell::Undefined(NO_ANSWERS)
            } else {
                Cell::Number(sum / n)
            }
        };
        [
            Cell::Count(sums.answers),
            mean(f64::from(sums.with_majority) / 2.0),
            mean(sums.ln_share),
            Cell::or_undefined(sums.z().ok_or(NOTHING_TOLD), Cell::Number),
            Cell::or_undefined(self.score(participant), Cell::Number),
        ]
    }

    pub(super) fn finding(&self, participants: &[String]) -> String {
        if let Err(why) = self.quartiles {
            return format!("Observers were not screened for outliers: {}.", why.reason);
        }
        let flagged = self.flagged();
        let scored = self
            .observers
            .iter()
            .filter(|sums| sums.z().is_some())
            .count();
        let of = plural(scored, "observer");
        if flagged.is_empty() {
            return format!(
                "None of {of} disagrees with the others by more than {FAR} interquartile ranges under the lower quartile."
            );
        }
        format!(
            "{} of {of} disagree with the others by more than {FAR} interquartile ranges under the lower quartile (normal scores would put 0.35\u{a0}% there): {}. Nobody was left out for it.",
            flagged.len(),
            names(flagged.iter().map(|at| participants[*at].as_str())),
        )
    }
}

const NO_ANSWERS: Undefined =
    Undefined::degenerate("no answer to a condition that others answered, too");
const NOTHING_TOLD: Undefined =
    Undefined::degenerate("no answer to a condition on which observers differ");

fn quartiles(observers: &[Sums]) -> Result<(f64, f64), Undefined> {
    let mut z: Vec<f64> = observers.iter().filter_map(Sums::z).collect();
    if z.len() < FEWEST {
        return Err(Undefined::degenerate(
            "quartiles need five observers whose answers can differ",
        ));
    }
    z.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * (z.len() - 1) as f64;
        let below = place.floor() as usize;
        let above = (below + 1).min(z.len() - 1);
        z[below] + (place - place.floor()) * (z[above] - z[below])
    };
    let (lower, range) = (at(0.25), at(0.75) - at(0.25));
    if range > 1e-9 {
        Ok((lower, range))
    } else {
        Err(Undefined::degenerate(
            "half of the observers agree with the others equally much",
        ))
    }
}
