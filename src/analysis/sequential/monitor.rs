//! The wealth of the gambler, vote by vote, and the shares that he has not won against.

use crate::analysis::bayes_factor::ln_bayes_factor;
use crate::analysis::dataset::Votes;
use crate::analysis::table::Interval;
use crate::analysis::tails::{Alpha, Binomial, Probability};

/// The test of one condition, fed vote by vote.
///
/// The wealth e of a gambler who starts with 1 and bets on every vote by the uniform prior's
/// prediction, (b + 1)/(n + 2) for b. It is a martingale under an even split, so that by Ville's
/// inequality it ever reaches 1/alpha with probability at most alpha. It equals the Bayes factor
/// with a uniform prior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Monitor {
    votes: Votes,
    /// The votes at which e was largest; none before it was over 1.
    at_largest: Votes,
    /// e by the largest e so far: no logarithm a vote.
    of_largest: f64,
}

impl Default for Monitor {
    fn default() -> Self {
        Self::at_once(Votes::default())
    }
}

impl Monitor {
    /// Votes in an order nobody knows: only what is true of their number can be asked.
    pub(super) fn at_once(votes: Votes) -> Self {
        Self {
            votes,
            at_largest: Votes::default(),
            of_largest: 1.0,
        }
    }

    /// One vote more. Whether e is larger than ever before.
    pub fn vote(&mut self, for_b: bool) -> bool {
        /// Far from where it would round to 0 and stay there.
        const SMALL: f64 = 1e-200;
        let n = f64::from(self.votes.a) + f64::from(self.votes.b);
        let side = if for_b {
            &mut self.votes.b
        } else {
            &mut self.votes.a
        };
        let factor = 2.0 * (f64::from(*side) + 1.0) / (n + 2.0);
        *side = side.saturating_add(1);
        self.of_largest = if self.of_largest > SMALL {
            self.of_largest * factor
        } else {
            (self.ln_e_value() - self.ln_largest_e_value()).exp()
        };
        let larger = self.of_largest > 1.0;
        if larger {
            self.at_largest = self.votes;
            self.of_largest = 1.0;
        }
        larger
    }

    /// The votes so far.
    #[must_use]
    pub fn votes(&self) -> Votes {
        self.votes
    }

    /// Number of votes at which e was largest.
    #[must_use]
    pub fn largest_at(&self) -> u32 {
        self.at_largest.total()
    }

    /// ln e now.
    #[must_use]
    pub fn ln_e_value(&self) -> f64 {
        ln_e_value(self.votes)
    }

    /// ln of the largest e so far, at least 0.
    #[must_use]
    pub fn ln_largest_e_value(&self) -> f64 {
        ln_e_value(self.at_largest).max(0.0)
    }

    /// The anytime-valid p: may be read after every vote, and never rises.
    #[must_use]
    pub fn p(&self) -> Probability {
        Probability::from_ln(-self.ln_largest_e_value())
    }

    /// The confidence sequence at this vote.
    #[must_use]
    pub fn interval(&self, alpha: Alpha) -> Interval {
        confidence_sequence(self.votes, alpha)
    }
}

/// ln e of a condition's votes against an even split, whatever their order.
#[must_use]
pub fn ln_e_value(votes: Votes) -> f64 {
    ln_bayes_factor(votes, 1.0)
}

/// The shares of b that a gambler with these votes has not won 1/alpha against: holds the true
/// share at every number of votes at once, with probability at least 1 − alpha.
#[must_use]
pub fn confidence_sequence(votes: Votes, alpha: Alpha) -> Interval {
    let Votes { a, b } = votes;
    Interval {
        low: lower_end(b, a, alpha).0,
        high: lower_end(a, b, alpha).1,
    }
}

/// The lower end of the share of `k` against `others`, and 1 minus it, each to full precision.
///
/// With C(n, k) B(k + 1, n − k + 1) = 1/(n + 1), e(p) < 1/alpha is P(X = k) > alpha/(n + 1) for
/// X ~ Bin(n, p). Its logarithm is concave in the logit of p, so that Newton, bracketed, comes up to
/// the root from below.
fn lower_end(k: u32, others: u32, alpha: Alpha) -> (f64, f64) {
    if k == 0 {
        return (0.0, 1.0);
    }
    let n = k.saturating_add(others);
    let target = alpha.get().ln() - (f64::from(n) + 1.0).ln();
    if others == 0 {
        let ln_p = target / f64::from(n);
        return (ln_p.exp(), -ln_p.exp_m1());
    }
    let share = f64::from(k) / f64::from(n);
    let most = (f64::from(k) / f64::from(others)).ln();
    let (mut low, mut high) = (-800.0_f64, most);
    let mut logit = most
        - (2.0 * -target / (f64::from(n) * share * (1.0 - share)))
            .sqrt()
            .min(700.0);
    for _ in 0..200 {
        let x = Binomial::from_logit(n, logit);
        let excess = x.ln_pmf(k) - target;
        if excess < 0.0 {
            low = logit;
        } else {
            high = logit;
        }
        // d ln P(X = k) / d logit = k − n p.
        let newton = logit - excess / (f64::from(k) - f64::from(n) * x.p());
        // NaN (no slope) is outside too.
        let next = if newton > low && newton < high {
            newton
        } else {
            f64::midpoint(low, high)
        };
        let step = (next - logit).abs();
        logit = next;
        if step <= 1e-15 * logit.abs().max(1.0) {
            break;
        }
    }
    let x = Binomial::from_logit(n, logit);
    (x.p(), x.q())
}
