//! Binomial probabilities and tails by their logarithms.

use std::f64::consts::{LN_2, PI};

use super::Probability;
use super::saddle_point::{deviance, stirling_error};

/// X ~ Bin(n, p): the number of successes in `n` independent trials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Binomial {
    n: u32,
    p: f64,
    /// 1 − p, held apart so that neither loses digits near 0.
    q: f64,
}

impl Binomial {
    /// `None` unless 0 ≤ p ≤ 1.
    #[must_use]
    pub fn new(n: u32, p: f64) -> Option<Self> {
        (0.0..=1.0)
            .contains(&p)
            .then_some(Self { n, p, q: 1.0 - p })
    }

    /// With p = 1 / (1 + e^−logit), precise at both ends.
    pub(super) fn from_logit(n: u32, logit: f64) -> Self {
        Self {
            n,
            p: 1.0 / (1.0 + (-logit).exp()),
            q: 1.0 / (1.0 + logit.exp()),
        }
    }

    /// Probability of a success.
    #[must_use]
    pub fn p(&self) -> f64 {
        self.p
    }

    /// Probability of a failure.
    #[must_use]
    pub fn q(&self) -> f64 {
        self.q
    }

    /// P(X = k), natural logarithm; −∞ where it is impossible.
    #[must_use]
    pub fn ln_pmf(&self, k: u32) -> f64 {
        let Self { n, p, q } = *self;
        if k > n {
            return f64::NEG_INFINITY;
        }
        let (successes, failures, trials) = (f64::from(k), f64::from(n - k), f64::from(n));
        if k == 0 || k == n {
            // No 0 · ln 0: a certain event has probability 1.
            return if n == 0 {
                0.0
            } else if k == 0 {
                trials * ln_of(q, p)
            } else {
                trials * ln_of(p, q)
            };
        }
        if p <= 0.0 || q <= 0.0 {
            return f64::NEG_INFINITY;
        }
        // k − np, formed with one rounding and from the smaller of p and q.
        let difference = if p <= q {
            (-trials).mul_add(p, successes)
        } else {
            trials.mul_add(q, -failures)
        };
        let correction =
            stirling_error(trials) - stirling_error(successes) - stirling_error(failures);
        correction
            - deviance(successes, trials * p, difference)
            - deviance(failures, trials * q, -difference)
            - 0.5 * (2.0 * PI * successes * (failures / trials)).ln()
    }

    /// P(X ≥ k).
    #[must_use]
    pub fn upper_tail(&self, k: u32) -> Probability {
        if k == 0 {
            return Probability::ONE;
        }
        if k > self.n {
            return Probability::from_ln(f64::NEG_INFINITY);
        }
        if f64::from(k) < f64::from(self.n) * self.p {
            // The long side: 1 minus the short one.
            let below = self.turned().sum_upwards(self.n - k + 1);
            return Probability::from_ln((-below.exp()).ln_1p());
        }
        Probability::from_ln(self.sum_upwards(k))
    }

    /// P(X ≤ k).
    #[must_use]
    pub fn lower_tail(&self, k: u32) -> Probability {
        if k >= self.n {
            return Probability::ONE;
        }
        self.turned().upper_tail(self.n - k)
    }

    /// The same trials, counting failures.
    fn turned(&self) -> Self {
        Self {
            n: self.n,
            p: self.q,
            q: self.p,
        }
    }

    /// ln P(X ≥ k) as P(X = k) times the sum of the ratios to it. All terms are positive and, for
    /// k ≥ np, falling, so nothing cancels; about 9 standard deviations' worth of them count.
    fn sum_upwards(&self, k: u32) -> f64 {
        let first = self.ln_pmf(k);
        if first == f64::NEG_INFINITY {
            return first;
        }
        let odds = self.p / self.q;
        let (mut term, mut sum) = (1.0_f64, 0.0_f64);
        for j in k..=self.n {
            sum += term;
            term *= f64::from(self.n - j) / (f64::from(j) + 1.0) * odds;
            if term < sum * 1e-20 {
                break;
            }
        }
        first + sum.ln()
    }
}

/// ln(value), given value and 1 − value: the one near 1 is better taken from its complement.
fn ln_of(value: f64, complement: f64) -> f64 {
    if complement < 0.5 {
        (-complement).ln_1p()
    } else {
        value.ln()
    }
}

/// Exact two-sided p of `k` successes in `n` trials against p = ½: twice the smaller tail, at most
/// 1. The distribution is symmetric, so this is also the minimum-likelihood p. 1 for n = 0.
#[must_use]
pub fn two_sided_even(k: u32, n: u32) -> Probability {
    let fewer = k.min(n.saturating_sub(k));
    // The two tails meet or overlap: exactly 1, without rounding.
    if fewer >= n - fewer || n - fewer == fewer + 1 {
        return Probability::ONE;
    }
    let even = Binomial { n, p: 0.5, q: 0.5 };
    Probability::from_ln(even.sum_upwards(n - fewer) + LN_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn small_tails_are_the_counted_ones() {
        // 36 votes, 11 : 25. Σ C(36, i), i = 0 … 11, counted in whole numbers.
        let mut choose = 1_u64;
        let mut sum = 0_u64;
        for i in 0..=11_u64 {
            sum += choose;
            choose = choose * (36 - i) / (i + 1);
        }
        let exact = 2.0 * sum as f64 / (1_u64 << 36) as f64;
        let ours = two_sided_even(11, 36).value();
        assert!((ours / exact - 1.0).abs() < 1e-14, "{ours} {exact}");
    }

    #[test]
    fn certain_and_impossible_counts() {
        for p in [0.0, 1e-300, 0.3, 1.0] {
            let x = Binomial::new(5, p).unwrap();
            assert_eq!(x.upper_tail(0).value(), 1.0);
            assert_eq!(x.upper_tail(6).value(), 0.0);
            assert_eq!(x.lower_tail(5).value(), 1.0);
        }
        assert_eq!(Binomial::new(5, 0.0).unwrap().upper_tail(1).value(), 0.0);
        assert_eq!(Binomial::new(5, 1.0).unwrap().upper_tail(5).value(), 1.0);
        assert!(Binomial::new(5, f64::NAN).is_none());
        assert!(Binomial::new(5, 1.000_001).is_none());
        assert_eq!(two_sided_even(0, 0), Probability::ONE);
        assert_eq!(two_sided_even(1, 1), Probability::ONE);
    }

    proptest! {
        #[test]
        fn tails_are_probabilities_and_fall(n in 1_u32..3_000_000, at in 0.0..1.0_f64, p in 0.0..=1.0_f64) {
            let k = (f64::from(n) * at) as u32;
            let x = Binomial::new(n, p).unwrap();
            let (here, next) = (x.upper_tail(k).ln(), x.upper_tail(k + 1).ln());
            prop_assert!(here <= 0.0 && next <= 0.0);
            // Beyond rounding: a tail never grows with k.
            prop_assert!(next <= here + 1e-9 * here.abs().max(1e-6), "{here} {next}");
            // P(X ≥ k) + P(X ≤ k − 1) = 1.
            if k > 0 {
                let whole = x.upper_tail(k).value() + x.lower_tail(k - 1).value();
                prop_assert!((whole - 1.0).abs() < 1e-11, "{whole}");
            }
        }

        #[test]
        fn two_sided_is_symmetric(n in 0_u32..2_000_000, at in 0.0..=1.0_f64) {
            let k = (f64::from(n) * at) as u32;
            prop_assert_eq!(two_sided_even(k, n), two_sided_even(n - k, n));
        }
    }
}
