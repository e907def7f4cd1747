//! How many participants it takes.
//!
//! Votes are whole numbers, so exact power saws: one participant more can lower it. Two numbers are
//! therefore given: the smallest n at which the power is reached, and the smallest from which on it is
//! never below it again. The second is the one to plan by, for it also holds where a block is filled
//! up or where more people come than planned.
//!
//! Nothing here is searched and hoped: beyond a bound by Hoeffding (1963) the power is certainly
//! there, and up to it every n is covered, whole stretches at a time where a bound over the stretch
//! says enough. The critical count c(n) and n − c(n) both grow with n ([`Test::critical`]) and so do
//! binomial votes, stochastically; so for every n from a to b
//!
//! P(X_a ≥ b − c(b)) + P(X_b ≤ c(a)) ≤ power(n) ≤ P(X_b ≥ a − c(a)) + P(X_a ≤ c(b)).
//!
//! W. Hoeffding (1963), Journal of the American Statistical Association 58, 13–30, theorem 1.

use super::family::Holm;
use super::power::{Region, Test, both, tail_down, tail_up};
use crate::analysis::tails::{Alpha, normal_critical};

/// Answers (participants times conditions) up to which a power that is certain is looked for: beyond
/// what anybody plans. One condition with p = 0.503 takes 220 000, and is certain from 570 000.
const MOST_ANSWERS: u32 = 1_000_000;

/// What is to happen with a given probability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// One condition is significant at alpha, without correction.
    Uncorrected,
    /// One condition is significant at alpha/K, Holm's smallest step: it is significant after Holm
    /// whatever the other K − 1 do.
    Bonferroni,
    /// A given condition is significant after Holm, all K having the effect: also the mean share of
    /// the conditions found.
    HolmEach,
    /// At least one condition is significant after Holm, all K having the effect.
    HolmAny,
    /// All K conditions are significant after Holm, all K having the effect.
    HolmAll,
}

impl Criterion {
    /// All of them, in the order they are told.
    pub const ALL: [Self; 5] = [
        Self::Uncorrected,
        Self::Bonferroni,
        Self::HolmEach,
        Self::HolmAny,
        Self::HolmAll,
    ];

    /// Name in files.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Uncorrected => "uncorrected",
            Self::Bonferroni => "bonferroni",
            Self::HolmEach => "holm_each",
            Self::HolmAny => "holm_any",
            Self::HolmAll => "holm_all",
        }
    }

    /// In words, given the number of conditions.
    #[must_use]
    pub fn words(self, conditions: u32) -> String {
        match self {
            Self::Uncorrected => "one condition, no correction".to_owned(),
            Self::Bonferroni => format!("one condition, whatever the other {} do", conditions - 1),
            Self::HolmEach => format!("a given one of {conditions} with the effect, Holm"),
            Self::HolmAny => format!("any of {conditions} with the effect, Holm"),
            Self::HolmAll => format!("all of {conditions} with the effect, Holm"),
        }
    }
}

/// A question of sample size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// The test of each condition.
    pub test: Test,
    /// Share of technique b in every condition that has the effect.
    pub p: f64,
    /// Level of the family.
    pub alpha: Alpha,
    /// Number of conditions in the family, from 1.
    pub conditions: u32,
    /// What is to happen.
    pub criterion: Criterion,
}

/// How many participants it takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleSize {
    /// Smallest number at which the power is reached.
    pub smallest: u32,
    /// Smallest number from which on it is never below: for this and every larger number.
    pub stable: u32,
}

impl SampleSize {
    /// The stable number, filled up to whole blocks.
    #[must_use]
    pub fn in_blocks(&self, block: u32) -> u32 {
        self.stable.div_ceil(block.max(1)) * block.max(1)
    }
}

impl Question {
    /// The power of `n` participants.
    #[must_use]
    pub fn power(&self, n: u32) -> f64 {
        self.least(n, n)
    }

    /// The numbers of participants for a power; `None` for an effect of nothing, or one so small
    /// that a million answers are not certain to be enough.
    #[must_use]
    pub fn sample_size(&self, target: f64) -> Option<SampleSize> {
        let certain = self.certain_from(target)?;
        let stable = self.stable(target, certain);
        Some(SampleSize {
            smallest: self.smallest(target, stable),
            stable,
        })
    }

    /// From where on the power is certainly enough, by Hoeffding's inequality.
    ///
    /// The test rejects at n − c(n) ≤ n/2 + w √n + 1 votes, so with δ = |p − ½| the votes miss that
    /// with a probability of at most exp(−2 (δ √n − w)²), which falls with n.
    fn certain_from(&self, target: f64) -> Option<u32> {
        let delta = (self.p - 0.5).abs();
        let (level, miss) = match self.criterion {
            Criterion::Uncorrected => (self.alpha.get(), 1.0 - target),
            // One condition at alpha/K is also what bounds the mean and any of them.
            Criterion::Bonferroni | Criterion::HolmEach | Criterion::HolmAny => {
                (self.level(1).get(), 1.0 - target)
            }
            Criterion::HolmAll => (
                self.level(1).get(),
                (1.0 - target) / f64::from(self.conditions),
            ),
        };
        let width = match self.test {
            Test::Exact => ((2.0 / level).ln() / 2.0).sqrt(),
            Test::ChiSquare => normal_critical(Alpha::try_from(level).ok()?) / 2.0,
        };
        let root = (width + (-miss.ln() / 2.0).sqrt()) / delta;
        let n = (root * root).ceil() + 1.0;
        let most = f64::from(MOST_ANSWERS / self.conditions.max(1));
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 1 and 10⁶
        (n <= most).then_some(n as u32)
    }

    /// Down from `certain`: the last n that falls short, plus one.
    fn stable(&self, target: f64, certain: u32) -> u32 {
        let mut enough_from = certain;
        while enough_from > 1 {
            let end = enough_from - 1;
            if self.least(end, end) < target {
                break;
            }
            // How far down the stretch that ends there is surely enough: least(·, end) falls with
            // a longer stretch, so steps grow until it falls short.
            let (mut short, mut enough, mut step) = (0, end, 1);
            while enough > step {
                let next = enough - step;
                if self.least(next, end) < target {
                    short = next;
                    break;
                }
                enough = next;
                step *= 2;
            }
            while enough - short > 1 {
                let middle = short + (enough - short) / 2;
                if self.least(middle, end) >= target {
                    enough = middle;
                } else {
                    short = middle;
                }
            }
            enough_from = enough;
        }
        enough_from
    }

    /// Up from 1: the first n that is enough, at most `stable`.
    fn smallest(&self, target: f64, stable: u32) -> u32 {
        let mut start = 1;
        while start < stable {
            if self.most(start, start) >= target {
                return start;
            }
            let (mut short, mut enough, mut step) = (start, stable, 1);
            while short + step < stable {
                let next = short + step;
                if self.most(start, next) >= target {
                    enough = next;
                    break;
                }
                short = next;
                step *= 2;
            }
            while enough - short > 1 {
                let middle = short + (enough - short) / 2;
                if self.most(start, middle) < target {
                    short = middle;
                } else {
                    enough = middle;
                }
            }
            start = short + 1;
        }
        stable
    }

    /// No n from `a` to `b` has less power.
    fn least(&self, a: u32, b: u32) -> f64 {
        self.combined(|alpha| {
            let (first, last) = (
                Region::of(self.test, a, alpha),
                Region::of(self.test, b, alpha),
            );
            let up = tail_up(a, self.p, last.at_least);
            both(up, tail_down(b, self.p, first.at_most)).value()
        })
    }

    /// No n from `a` to `b` has more power.
    fn most(&self, a: u32, b: u32) -> f64 {
        self.combined(|alpha| {
            let (first, last) = (
                Region::of(self.test, a, alpha),
                Region::of(self.test, b, alpha),
            );
            let up = tail_up(b, self.p, first.at_least);
            (up.value() + tail_down(a, self.p, last.at_most).value()).min(1.0)
        })
    }

    /// The criterion, given the probability of rejecting one condition at each level. All of them
    /// grow with those probabilities: smaller p-values never cost Holm a rejection.
    fn combined(&self, rejects: impl Fn(Alpha) -> f64) -> f64 {
        let holm = || {
            let steps = 1..=self.conditions;
            Holm::new(
                &steps
                    .map(|step| rejects(self.level(step)))
                    .collect::<Vec<_>>(),
            )
        };
        match self.criterion {
            Criterion::Uncorrected => rejects(self.alpha),
            Criterion::Bonferroni => rejects(self.level(1)),
            Criterion::HolmEach => holm().each(),
            Criterion::HolmAny => holm().any(),
            Criterion::HolmAll => holm().all(),
        }
    }

    /// Level of one of Holm's steps, from 1: alpha/K, alpha/(K − 1), …, alpha.
    #[must_use]
    pub fn level(&self, step: u32) -> Alpha {
        let tests_left = f64::from(self.conditions.saturating_sub(step) + 1);
        // A level that small is never reached by 10⁷ votes; the bound is Alpha's own.
        Alpha::try_from((self.alpha.get() / tests_left).max(1e-300)).unwrap_or(self.alpha)
    }
}

#[cfg(test)]
mod tests;
