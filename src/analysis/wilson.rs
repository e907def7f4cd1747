//! Wilson's score interval of the share.

use super::dataset::Votes;
use super::settings::Settings;
use super::statistic::{About, ConditionStatistic};
use super::table::{Cell, Column, Group, Interval, Style, Undefined};
use super::tails::{Alpha, normal_critical};

/// The declaration.
pub const STATISTIC: ConditionStatistic = ConditionStatistic {
    about: About {
        id: "wilson",
        name: "Wilson score interval",
        formula: "(2k + z² ∓ z √(z² + 4k(n − k)/n)) / (2 (n + z²)), z the two-sided normal quantile",
        source: "E. B. Wilson (1927), JASA 22(158), 209–212",
        validity: "coverage near 1 − alpha on average also for small n; not guaranteed for each share",
    },
    columns: &[Column::new(
        "wilson",
        "Wilson",
        Style::Interval(3),
        Group::Choices,
    )],
    cells: |condition, settings: &Settings| {
        vec![Cell::or_undefined(
            interval(condition.votes, settings.alpha),
            Cell::Interval,
        )]
    },
    test: None,
};

/// Interval of technique b's share.
///
/// # Errors
/// Without votes.
pub fn interval(votes: Votes, alpha: Alpha) -> Result<Interval, Undefined> {
    if votes.total() == 0 {
        return Err(Undefined::NO_VOTES);
    }
    let low = |k: u32| {
        let (k, n, z) = (
            f64::from(k),
            f64::from(votes.total()),
            normal_critical(alpha),
        );
        let root = z * (z * z + 4.0 * k * (n - k) / n).sqrt();
        // The ends solve (n + z²) p² − (2k + z²) p + k²/n = 0: the lower one is the product of the
        // roots by the upper one, where the textbook's difference would cancel for small k.
        2.0 * k * k / (n * (2.0 * k + z * z + root))
    };
    Ok(Interval {
        low: low(votes.b),
        high: 1.0 - low(votes.a),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// statsmodels 0.15, `proportion_confint(k, n, method="wilson")`.
    #[test]
    fn small_counts() {
        for (a, b, low, high) in [
            (11, 25, 0.531_437_271_494_896_6, 0.819_955_484_051_700_8),
            (18, 18, 0.344_743_254_096_268_3, 0.655_256_745_903_731_7),
            (36, 0, 0.0, 0.096_418_628_594_463_7),
            (0, 1, 0.206_549_314_377_237_4, 1.0),
            (
                999_999,
                1,
                1.765_245_767_453_717_6e-7,
                5.664_911_804_311_445e-6,
            ),
        ] {
            let ours = interval(Votes { a, b }, Alpha::FIVE_PERCENT).unwrap();
            assert!((ours.low - low).abs() < 1e-12, "{ours:?}");
            assert!((ours.high - high).abs() < 1e-12, "{ours:?}");
        }
    }

    proptest! {
        #[test]
        fn holds_the_share_and_mirrors(a in 0_u32..2_000_000, b in 0_u32..2_000_000) {
            prop_assume!(a + b > 0);
            let votes = Votes { a, b };
            let ours = interval(votes, Alpha::FIVE_PERCENT).unwrap();
            let share = votes.share_b().unwrap();
            prop_assert!(0.0 <= ours.low && ours.low <= share);
            prop_assert!(share <= ours.high && ours.high <= 1.0);
            let turned = interval(Votes { a: b, b: a }, Alpha::FIVE_PERCENT).unwrap();
            prop_assert!((turned.low - (1.0 - ours.high)).abs() < 1e-12);
        }
    }
}
