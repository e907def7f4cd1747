//! Power of the tests of one condition's votes against an even split, exactly: the probability that
//! the votes fall where the test rejects, summed over those votes.
//!
//! Source: A. Agresti (2013), Categorical Data Analysis, 3rd ed., section 1.4, on exact inference for a
//! proportion; M. R. Chernick, C. Y. Liu (2002), The American Statistician 56(2), 149–155, on its power.

use crate::analysis::tails::{
    Alpha, Binomial, Probability, chi_square_upper, normal_critical, two_sided_even,
};

/// A test of a : b votes against an even split, two-sided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Test {
    /// The exact binomial test: what the analysis rests its verdicts on.
    Exact,
    /// Pearson's chi-square, without continuity correction: the test of the 2010 study.
    ChiSquare,
}

impl Test {
    /// Name in the text.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact binomial test",
            Self::ChiSquare => "chi-square test",
        }
    }

    /// Name in files, as the analysis has it.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Exact => "exact_binomial",
            Self::ChiSquare => "chi_square",
        }
    }

    /// p of `fewer` votes for one technique, out of `n`: the one the analysis gives.
    #[must_use]
    pub fn p(self, fewer: u32, n: u32) -> Probability {
        match self {
            Self::Exact => two_sided_even(fewer, n),
            Self::ChiSquare if n == 0 => Probability::ONE,
            Self::ChiSquare => {
                let difference = f64::from(n) - 2.0 * f64::from(fewer);
                chi_square_upper(difference * difference / f64::from(n), 1)
            }
        }
    }

    /// Most votes for the technique with fewer of them at which the test still rejects; `None`
    /// where not even all votes one way are enough.
    ///
    /// As n grows by 1, this grows by 0 or 1 (both tests), which [`sample_size`](super::sample_size)
    /// rests on.
    #[must_use]
    pub fn critical(self, n: u32, alpha: Alpha) -> Option<u32> {
        let rejects = |fewer| self.p(fewer, n).at_most(alpha);
        if n == 0 || !rejects(0) {
            return None;
        }
        let (mut low, mut high) = around(n, alpha, rejects);
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if rejects(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    /// Power: the probability to reject when technique b is chosen with probability `p` by `n`
    /// participants independently. At p = ½ this is the test's actual size.
    #[must_use]
    pub fn power(self, n: u32, p: f64, alpha: Alpha) -> Probability {
        Region::of(self, n, alpha).probability(n, p)
    }

    /// The smallest share above ½ at which `n` participants give at least this power; `None` where
    /// even a share of 1 does not.
    #[must_use]
    pub fn detectable(self, n: u32, power: f64, alpha: Alpha) -> Option<f64> {
        let region = Region::of(self, n, alpha);
        let enough = |p| region.probability(n, p).value() >= power;
        if enough(0.5) {
            return Some(0.5);
        }
        if !enough(1.0) {
            return None;
        }
        // Power grows with p above ½, for the region is symmetric and an interval to either side.
        let (mut low, mut high) = (0.5_f64, 1.0_f64);
        while high - low > 1e-12 {
            let middle = 0.5 * (low + high);
            if enough(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high)
    }
}

/// A count at which a test that rejects at 0 rejects, and one at which it does not: found from where
/// the normal approximation puts the critical count, in growing steps.
fn around(n: u32, alpha: Alpha, rejects: impl Fn(u32) -> bool) -> (u32, u32) {
    let (trials, most) = (f64::from(n), n / 2 + 1);
    let guess = 0.5 * (trials - normal_critical(alpha) * trials.sqrt());
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // from 0 to n/2
    let guess = guess.clamp(0.0, f64::from(most - 1)) as u32;
    let mut step = 1;
    if rejects(guess) {
        let mut low = guess;
        loop {
            // An even split has p = 1: at `most` nothing rejects.
            let next = low.saturating_add(step).min(most);
            if next == most || !rejects(next) {
                return (low, next);
            }
            low = next;
            step *= 2;
        }
    }
    let mut high = guess;
    loop {
        let next = high.saturating_sub(step);
        if next == 0 || rejects(next) {
            return (next, high);
        }
        high = next;
        step *= 2;
    }
}

/// Where a test rejects: at `at_most` votes or fewer, and at `at_least` or more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Region {
    pub at_most: Option<u32>,
    pub at_least: u32,
}

impl Region {
    pub fn of(test: Test, n: u32, alpha: Alpha) -> Self {
        let at_most = test.critical(n, alpha);
        Self {
            at_most,
            at_least: at_most.map_or(n + 1, |fewer| n - fewer),
        }
    }

    /// Of the votes of `n` participants who choose b with probability `p`.
    fn probability(self, n: u32, p: f64) -> Probability {
        both(tail_down(n, p, self.at_most), tail_up(n, p, self.at_least))
    }
}

/// P(X ≤ k), X ~ Bin(n, p); 0 for no k.
pub(super) fn tail_down(n: u32, p: f64, k: Option<u32>) -> Probability {
    let impossible = Probability::from_ln(f64::NEG_INFINITY);
    match (k, Binomial::new(n, p.clamp(0.0, 1.0))) {
        (Some(k), Some(votes)) => votes.lower_tail(k),
        _ => impossible,
    }
}

/// P(X ≥ k).
pub(super) fn tail_up(n: u32, p: f64, k: u32) -> Probability {
    // A clamped probability always makes a binomial; NaN claims nothing.
    Binomial::new(n, p.clamp(0.0, 1.0)).map_or(Probability::from_ln(f64::NEG_INFINITY), |votes| {
        votes.upper_tail(k)
    })
}

/// Of two events that exclude each other, either.
pub(super) fn both(one: Probability, other: Probability) -> Probability {
    let (small, large) = (one.min(other).ln(), one.max(other).ln());
    if small == f64::NEG_INFINITY {
        return Probability::from_ln(large);
    }
    Probability::from_ln(large + (small - large).exp().ln_1p())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn alpha(value: f64) -> Alpha {
        Alpha::try_from(value).unwrap()
    }

    /// The figures a reviewer of the 2010 study was given, three digits each.
    #[test]
    fn thirty_six_participants() {
        for (p, power) in [(0.60, 0.162), (0.65, 0.356), (0.70, 0.609)] {
            let ours = Test::Exact.power(36, p, Alpha::FIVE_PERCENT).value();
            assert!((ours - power).abs() < 5e-4, "{p}: {ours}");
        }
        assert_eq!(Test::Exact.critical(36, Alpha::FIVE_PERCENT), Some(11));
        assert_eq!(Test::ChiSquare.critical(36, Alpha::FIVE_PERCENT), Some(12));
    }

    /// Five votes: 2/32 is above 0.05, so nothing rejects; six: 2/64 rejects all one way.
    #[test]
    fn too_few_participants_can_find_nothing() {
        assert_eq!(Test::Exact.critical(5, Alpha::FIVE_PERCENT), None);
        assert_eq!(Test::Exact.power(5, 1.0, Alpha::FIVE_PERCENT).value(), 0.0);
        assert_eq!(Test::Exact.critical(6, Alpha::FIVE_PERCENT), Some(0));
        assert_eq!(Test::Exact.power(6, 1.0, Alpha::FIVE_PERCENT).value(), 1.0);
        let size = Test::Exact.power(6, 0.5, Alpha::FIVE_PERCENT).value();
        assert!((size - 2.0 / 64.0).abs() < 1e-16);
        for test in [Test::Exact, Test::ChiSquare] {
            assert_eq!(test.critical(0, Alpha::FIVE_PERCENT), None);
            assert_eq!(test.power(0, 0.7, Alpha::FIVE_PERCENT).value(), 0.0);
            assert_eq!(test.detectable(3, 0.8, Alpha::FIVE_PERCENT), None);
        }
    }

    #[test]
    fn detectable_is_where_the_power_is_reached() {
        for test in [Test::Exact, Test::ChiSquare] {
            let p = test.detectable(36, 0.8, Alpha::FIVE_PERCENT).unwrap();
            let there = test.power(36, p, Alpha::FIVE_PERCENT).value();
            assert!((there - 0.8).abs() < 1e-9, "{there}");
        }
        assert_eq!(
            Test::Exact.detectable(36, 0.01, Alpha::FIVE_PERCENT),
            Some(0.5)
        );
    }

    proptest! {
        /// Summed vote by vote, with p of each split as the analysis gives it.
        #[test]
        fn power_is_the_sum_over_what_rejects(n in 1_u32..400, p in 0.0..=1.0_f64, level in 1e-6..0.3_f64) {
            let votes = Binomial::new(n, p).unwrap();
            for test in [Test::Exact, Test::ChiSquare] {
                let sum: f64 = (0..=n)
                    .filter(|&k| test.p(k, n).at_most(alpha(level)))
                    .map(|k| votes.ln_pmf(k).exp())
                    .sum();
                let ours = test.power(n, p, alpha(level)).value();
                prop_assert!((ours - sum).abs() < 1e-12, "{ours} {sum}");
            }
        }

        /// The exact test keeps its level; both are blind to the technique's name.
        #[test]
        fn size_and_symmetry(n in 1_u32..100_000, p in 0.0..=1.0_f64, level in 1e-9..0.3_f64) {
            let alpha = alpha(level);
            prop_assert!(Test::Exact.power(n, 0.5, alpha).value() <= level);
            for test in [Test::Exact, Test::ChiSquare] {
                let (here, there) = (test.power(n, p, alpha).value(), test.power(n, 1.0 - p, alpha).value());
                prop_assert!((here - there).abs() < 1e-11, "{here} {there}");
            }
        }

        /// What `sample_size` rests on.
        #[test]
        fn critical_counts_grow_by_one_at_most(n in 1_u32..200_000, level in 1e-9..0.3_f64) {
            let alpha = alpha(level);
            let number = |c: Option<u32>| c.map_or(-1, i64::from);
            for test in [Test::Exact, Test::ChiSquare] {
                let grown = number(test.critical(n + 1, alpha)) - number(test.critical(n, alpha));
                prop_assert!((0..=1).contains(&grown), "{grown}");
            }
        }
    }
}
