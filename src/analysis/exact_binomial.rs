//! The exact binomial test of the votes against an even split: the test the verdicts rest on.

use super::dataset::{ConditionData, Votes};
use super::statistic::{About, ConditionStatistic, ConditionTest};
use super::table::{Cell, Column, Group, Style, Undefined};
use super::tails::{Probability, two_sided_even};

/// The declaration.
pub const STATISTIC: ConditionStatistic = ConditionStatistic {
    about: About {
        id: "exact_binomial",
        name: "exact binomial test against an even split",
        formula: "p = min(1, 2 P(X ≤ min(a, b))), X ~ Bin(a + b, ½); two-sided",
        source: "W. J. Conover (1999), Practical Nonparametric Statistics, 3rd ed., section 3.1",
        validity: "exact for every number of independent votes; conservative, for votes are whole numbers",
    },
    columns: &[Column::new("p_exact", "p exact", Style::P, Group::Tests)],
    cells: |condition, _| vec![Cell::or_undefined(p(condition), Cell::Probability)],
    test: Some(ConditionTest {
        p_key: "p_exact",
        short: "exact",
        p,
    }),
};

/// The exact two-sided p.
///
/// # Errors
/// Without votes.
pub fn exact_p(votes: Votes) -> Result<Probability, Undefined> {
    if votes.total() == 0 {
        return Err(Undefined::NO_VOTES);
    }
    Ok(two_sided_even(votes.a, votes.total()))
}

fn p(condition: &ConditionData) -> Result<Probability, Undefined> {
    exact_p(condition.votes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole-number sums: Σ C(n, i) over the tails by 2ⁿ (scipy 1.17 `binomtest` agrees).
    #[test]
    fn small_counts() {
        let p = |a, b| exact_p(Votes { a, b }).unwrap().value();
        assert!((p(11, 25) - 0.028_816_719_655_878_845).abs() < 1e-12);
        assert!((p(0, 5) - 2.0 / 32.0).abs() < 1e-16);
        assert!((p(1, 5) - 14.0 / 64.0).abs() < 1e-15);
        assert_eq!(p(18, 18), 1.0);
        assert_eq!(p(1, 0), 1.0);
    }

    #[test]
    fn a_million_votes_one_way_still_have_a_p() {
        let p = exact_p(Votes { a: 0, b: 1_000_000 }).unwrap();
        // 2 · 2^−1000000.
        let expected = (1.0 - 1e6) * std::f64::consts::LOG10_2;
        assert!((p.log10() - expected).abs() < 1e-8);
        assert_eq!(p.value(), 0.0);
    }
}
