//! Pearson's chi-square of the votes against an even split: the thesis' test (section 5.6).

use super::dataset::{ConditionData, Votes};
use super::statistic::{About, ConditionStatistic, ConditionTest};
use super::table::{Cell, Column, Group, Style, Undefined};
use super::tails::{Probability, chi_square_upper};

/// Fewest votes for which both expected counts reach 5, the usual floor of the approximation.
pub const FEWEST_VOTES: u32 = 10;

/// The declaration.
pub const STATISTIC: ConditionStatistic = ConditionStatistic {
    about: About {
        id: "chi_square",
        name: "chi-square test against an even split",
        formula: "χ² = Σ (O − E)²/E = (a − b)²/(a + b), one degree of freedom, no continuity correction",
        source: "K. Pearson (1900), Philosophical Magazine 50, 157–175; the test of the 2010 study",
        validity: "an approximation, and poor under 10 votes (expected counts under 5): use the exact p there",
    },
    columns: &[
        Column::new("chi_square", "χ²", Style::UpTo(6), Group::Tests),
        Column::new("p_chi_square", "p χ²", Style::P, Group::Tests),
    ],
    cells: |condition, _| {
        vec![
            Cell::or_undefined(chi_square(condition.votes), Cell::Number),
            Cell::or_undefined(p(condition), Cell::Probability),
        ]
    },
    test: Some(ConditionTest {
        p_key: "p_chi_square",
        short: "χ²",
        p,
    }),
};

/// χ² of a : b against an even split.
///
/// # Errors
/// Without votes.
pub fn chi_square(votes: Votes) -> Result<f64, Undefined> {
    if votes.total() == 0 {
        return Err(Undefined::NO_VOTES);
    }
    let difference = f64::from(votes.a) - f64::from(votes.b);
    Ok(difference * difference / f64::from(votes.total()))
}

fn p(condition: &ConditionData) -> Result<Probability, Undefined> {
    chi_square(condition.votes).map(|x| chi_square_upper(x, 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The five different splits of the 2010 study: χ² by hand, p from scipy 1.17 `chi2.sf(x, 1)`.
    #[test]
    fn the_2010_splits() {
        for (a, b, expected, p) in [
            (18, 18, 0.0, 1.0),
            (14, 22, 16.0 / 9.0, 0.182_422_439_451_731_98),
            (11, 25, 49.0 / 9.0, 0.019_630_657_257_290_702),
            (16, 20, 4.0 / 9.0, 0.504_985_075_093_845_7),
            (21, 15, 1.0, 0.317_310_507_862_911_15),
        ] {
            let ours = chi_square(Votes { a, b }).unwrap();
            assert!((ours - expected).abs() < 1e-14);
            let ours = chi_square_upper(ours, 1).value();
            assert!((ours - p).abs() < 1e-12, "{a}:{b} {ours}");
        }
    }

    #[test]
    fn no_votes_no_value() {
        assert_eq!(chi_square(Votes::default()), Err(Undefined::NO_VOTES));
    }
}
