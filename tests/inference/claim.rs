//! What is claimed, what was counted, and whether the count refutes the claim.

use std::ops::RangeInclusive;

use greyfield::analysis::tails::{self, Alpha};
use greyfield::seed;
use rand_chacha::ChaCha20Rng;
use rayon::prelude::*;

/// Coverage that a 95 % interval is claimed to have.
pub const NEAR_95: RangeInclusive<f64> = 0.94..=0.96;
/// Coverage of an interval that is claimed to be on the safe side.
pub const AT_LEAST_95: RangeInclusive<f64> = 0.95..=1.0;
/// Error rate that is claimed of a test or of a family of tests at 5 %.
pub const AT_MOST_5_5: RangeInclusive<f64> = 0.0..=0.055;
/// Error rate of a test that guarantees its 5 %.
pub const AT_MOST_5: RangeInclusive<f64> = 0.0..=0.05;

/// A probability, as exact as the sum of all cases, or as often as something happened.
#[derive(Debug, Clone, Copy)]
pub enum Measured {
    /// By summing.
    Exact(f64),
    /// By counting simulated studies.
    Counted { seed: u64, studies: u32, hits: u32 },
}

/// A probability of the analysis, and the range in which it is claimed to be.
#[derive(Debug, Clone)]
pub struct Claim {
    pub what: String,
    /// `None`: told, and nothing is claimed.
    pub range: Option<RangeInclusive<f64>>,
    pub measured: Measured,
}

/// What the measurement says of the claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// All values that the count leaves possible are in the range.
    Holds,
    /// Some are.
    NotRefuted,
    /// None is.
    Refuted,
    /// There is no claim.
    Told,
}

impl Claim {
    pub fn new(what: impl Into<String>, range: RangeInclusive<f64>, measured: Measured) -> Self {
        Self {
            what: what.into(),
            range: Some(range),
            measured,
        }
    }

    pub fn told(what: impl Into<String>, measured: Measured) -> Self {
        Self {
            what: what.into(),
            range: None,
            measured,
        }
    }

    pub fn verdict(&self) -> Verdict {
        let Some(range) = &self.range else {
            return Verdict::Told;
        };
        let (low, high) = self.measured.bounds();
        if high < *range.start() || low > *range.end() {
            Verdict::Refuted
        } else if *range.start() <= low && high <= *range.end() {
            Verdict::Holds
        } else {
            Verdict::NotRefuted
        }
    }
}

impl Measured {
    pub fn estimate(self) -> f64 {
        match self {
            Self::Exact(value) => value,
            Self::Counted { studies, hits, .. } => f64::from(hits) / f64::from(studies),
        }
    }

    /// The probabilities that the count leaves possible: those under which neither as many hits or more
    /// nor as many or fewer have a chance under 10⁻⁴ (Clopper & Pearson). A claim that holds is refuted
    /// by one count in 10 000 at most.
    pub fn bounds(self) -> (f64, f64) {
        match self {
            // Sums of a thousand terms of 12 digits.
            Self::Exact(value) => (value, value),
            Self::Counted { studies, hits, .. } => match Alpha::try_from(2e-4) {
                Ok(alpha) => tails::clopper_pearson(hits, studies, alpha),
                Err(_) => (0.0, 1.0),
            },
        }
    }
}

/// Studies of one kind. The study of an index is the same whatever the number of studies.
#[derive(Debug, Clone, Copy)]
pub struct Simulation {
    pub purpose: &'static str,
    pub seed: u64,
    pub studies: u32,
}

impl Simulation {
    /// In how many studies each of some things happened.
    pub fn count<const N: usize>(
        self,
        study: impl Fn(u64, &mut ChaCha20Rng) -> [bool; N] + Sync,
    ) -> [Measured; N] {
        let hits = (0..u64::from(self.studies))
            .into_par_iter()
            .map(|index| {
                let mut rng = seed::generator(self.seed, self.purpose, index);
                study(index, &mut rng).map(u32::from)
            })
            .reduce(
                || [0; N],
                |mut sum, one| {
                    sum.iter_mut().zip(one).for_each(|(sum, one)| *sum += one);
                    sum
                },
            );
        hits.map(|hits| Measured::Counted {
            seed: self.seed,
            studies: self.studies,
            hits,
        })
    }
}
