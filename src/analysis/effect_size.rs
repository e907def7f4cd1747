//! How large the preference is: Cohen's g and w.

use super::dataset::Votes;
use super::statistic::{About, ConditionStatistic};
use super::table::{Cell, Column, Group, Style, Undefined};

/// The declaration.
pub const STATISTIC: ConditionStatistic = ConditionStatistic {
    about: About {
        id: "effect_size",
        name: "Cohen's g and w",
        formula: "g = b/(a + b) − ½, positive towards technique b; w = √(χ²/n) = 2 |g|",
        source: "J. Cohen (1988), Statistical Power Analysis, 2nd ed., chapters 5 and 7",
        validity: "a description of the votes; Cohen calls |g| 0.05 small, 0.15 medium, 0.25 large",
    },
    columns: &[
        Column::new("cohens_g", "g", Style::Decimals(3), Group::Effects),
        Column::new("cohens_w", "w", Style::Decimals(3), Group::Effects),
    ],
    cells: |condition, _| {
        let g = cohens_g(condition.votes);
        vec![
            Cell::or_undefined(g, Cell::Number),
            Cell::or_undefined(g.map(|g| 2.0 * g.abs()), Cell::Number),
        ]
    },
    test: None,
};

/// Cohen's g, −½ to ½, positive towards technique b.
///
/// # Errors
/// Without votes.
pub fn cohens_g(votes: Votes) -> Result<f64, Undefined> {
    if votes.total() == 0 {
        return Err(Undefined::NO_VOTES);
    }
    // (b − a)/2n, so that an even split is exactly 0.
    Ok((f64::from(votes.b) - f64::from(votes.a)) / (2.0 * f64::from(votes.total())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::chi_square::chi_square;

    #[test]
    fn g_and_w_agree_with_chi_square() {
        for (a, b) in [(11, 25), (18, 18), (21, 15), (0, 1), (7, 0)] {
            let votes = Votes { a, b };
            let w = (chi_square(votes).unwrap() / f64::from(votes.total())).sqrt();
            let g = cohens_g(votes).unwrap();
            assert!((w - 2.0 * g.abs()).abs() < 1e-15);
            assert_eq!(g > 0.0, b > a);
        }
    }
}
