//! The Clopper–Pearson interval of the share.

use super::dataset::Votes;
use super::statistic::{About, ConditionStatistic};
use super::table::{Cell, Column, Group, Interval, Style, Undefined};
use super::tails::{self, Alpha};

/// The declaration.
pub const STATISTIC: ConditionStatistic = ConditionStatistic {
    about: About {
        id: "clopper_pearson",
        name: "Clopper–Pearson interval",
        formula: "the p with P(X ≥ b | p) = alpha/2 and with P(X ≤ b | p) = alpha/2, X ~ Bin(a + b, p)",
        source: "C. J. Clopper, E. S. Pearson (1934), Biometrika 26(4), 404–413",
        validity: "coverage at least 1 − alpha for every share and every n; wider than Wilson's",
    },
    columns: &[Column::new(
        "clopper_pearson",
        "Clopper–Pearson",
        Style::Interval(3),
        Group::Choices,
    )],
    cells: |condition, settings| {
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
    let (low, high) = tails::clopper_pearson(votes.b, votes.total(), alpha);
    Ok(Interval { low, high })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rule of three: none of n, and the 95 % one-sided bound is near 3/n.
    #[test]
    fn none_of_a_thousand() {
        let alpha = Alpha::try_from(0.10).unwrap();
        let ours = interval(Votes { a: 1000, b: 0 }, alpha).unwrap();
        assert_eq!(ours.low, 0.0);
        assert!((ours.high - 3.0 / 1000.0).abs() < 2e-5, "{ours:?}");
    }

    #[test]
    fn no_votes_no_interval() {
        assert_eq!(
            interval(Votes::default(), Alpha::FIVE_PERCENT),
            Err(Undefined::NO_VOTES)
        );
    }
}
