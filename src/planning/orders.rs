//! Power where the image shown first is favoured: the votes of the two orders are two binomials, and
//! the votes of a condition their sum.

use super::power::{Region, Test};
use crate::analysis::tails::{Alpha, Binomial, Probability};

/// A share, a preference for the image shown first, and how often a condition was shown in each
/// order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orders {
    /// Share of technique b without a bias, above 0 and below 1.
    pub p: f64,
    /// Preference for the image shown first, on the logit scale; negative for the second.
    pub bias: f64,
    /// Standard deviation of each participant's own preference for b, on the logit scale. A
    /// participant answers a condition once, so votes stay independent; their shares are means over
    /// the participants.
    pub participant_sd: f64,
    /// Participants who see a, then b.
    pub a_then_b: u32,
    /// Participants who see b, then a.
    pub b_then_a: u32,
}

impl Orders {
    /// Share of b in each order: (a then b, b then a).
    #[must_use]
    pub fn shares(&self) -> (f64, f64) {
        let mean = |by| mean_share(self.p, by, self.participant_sd);
        (mean(-self.bias), mean(self.bias))
    }

    /// Mean share of b over the orders as they were shown; `p` without participants.
    #[must_use]
    pub fn mean_share(&self) -> f64 {
        let (ab, ba) = (f64::from(self.a_then_b), f64::from(self.b_then_a));
        let (first, second) = self.shares();
        match self.a_then_b.saturating_add(self.b_then_a) {
            0 => self.p,
            _ => (ab * first + ba * second) / (ab + ba),
        }
    }

    /// The probability that a test of the votes against an even split rejects.
    #[must_use]
    pub fn power(&self, test: Test, alpha: Alpha) -> Probability {
        let (first, second) = self.shares();
        let (Some(ab), Some(ba)) = (
            Binomial::new(self.a_then_b, first),
            Binomial::new(self.b_then_a, second),
        ) else {
            return Probability::from_ln(f64::NEG_INFINITY);
        };
        let n = self.a_then_b.saturating_add(self.b_then_a);
        let region = Region::of(test, n, alpha);
        let mut sum = 0.0;
        for votes in 0..=self.a_then_b {
            // The votes of the other order that make the sum reject: above, and below.
            let above = ba.upper_tail(region.at_least.saturating_sub(votes)).value();
            let below = region.at_most.and_then(|most| most.checked_sub(votes));
            let below = below.map_or(0.0, |most| ba.lower_tail(most).value());
            sum += ab.ln_pmf(votes).exp() * (above + below);
        }
        Probability::from_ln(sum.ln())
    }
}

/// Mean of a share moved on the logit scale by `by` and a normal number of standard deviation `sd`:
/// the trapezium rule over ±9 standard deviations, which for such an integrand is good to the last
/// digits (L. N. Trefethen, J. A. C. Weideman (2014), SIAM Review 56, 385–458).
#[must_use]
pub fn mean_share(p: f64, by: f64, sd: f64) -> f64 {
    const STEPS: i32 = 288;
    if sd <= 0.0 {
        return shifted(p, by);
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for step in -STEPS..=STEPS {
        let z = 9.0 * f64::from(step) / f64::from(STEPS);
        let weight = libm::exp(-0.5 * z * z);
        sum += weight * shifted(p, by + sd * z);
        weights += weight;
    }
    sum / weights
}

/// A share moved on the logit scale.
fn shifted(p: f64, by: f64) -> f64 {
    let logit = libm::log(p) - libm::log1p(-p);
    1.0 / (1.0 + libm::exp(-(logit + by)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIVE: Alpha = Alpha::FIVE_PERCENT;

    #[test]
    fn without_a_bias_the_orders_do_not_matter() {
        for (a_then_b, b_then_a) in [(18, 18), (21, 15), (36, 0), (0, 36)] {
            let orders = Orders {
                p: 0.65,
                bias: 0.0,
                participant_sd: 0.0,
                a_then_b,
                b_then_a,
            };
            let plain = Test::Exact.power(36, 0.65, FIVE).value();
            assert!((orders.power(Test::Exact, FIVE).value() - plain).abs() < 1e-13);
            assert!((orders.mean_share() - 0.65).abs() < 1e-15);
        }
    }

    /// A bias hides behind balanced orders and shows as a preference behind uneven ones.
    #[test]
    fn uneven_orders_turn_a_bias_into_a_preference() {
        let orders = |a_then_b, b_then_a| Orders {
            p: 0.5,
            bias: 1.0,
            participant_sd: 0.0,
            a_then_b,
            b_then_a,
        };
        let nothing = Test::Exact.power(36, 0.5, FIVE).value();
        assert!(orders(18, 18).power(Test::Exact, FIVE).value() < nothing);
        assert!(
            orders(21, 15).power(Test::Exact, FIVE).value()
                > orders(18, 18).power(Test::Exact, FIVE).value()
        );
        assert!(orders(36, 0).power(Test::Exact, FIVE).value() > 0.5);
        assert!((orders(18, 18).mean_share() - 0.5).abs() < 1e-15);
        assert!(orders(21, 15).mean_share() < 0.5);
    }

    #[test]
    fn nobody_finds_nothing() {
        let orders = Orders {
            p: 0.7,
            bias: 0.0,
            participant_sd: 0.0,
            a_then_b: 0,
            b_then_a: 0,
        };
        assert_eq!(orders.power(Test::Exact, FIVE).value(), 0.0);
    }
}
