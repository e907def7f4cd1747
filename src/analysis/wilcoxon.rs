//! Wilcoxon's signed-rank test: do the same people rate one technique higher than another?

use super::blocks::by_size;
use super::statistic::About;
use super::table::Undefined;
use super::tails::{Probability, normal_upper};

/// The declaration.
pub const ABOUT: About = About {
    id: "wilcoxon",
    name: "Wilcoxon's signed-rank test",
    formula: "V = sum of the ranks of |d| where d > 0, d a participant's difference, zero differences left out, ties at their mean rank; r = (V₊ − V₋)/(V₊ + V₋)",
    source: "F. Wilcoxon (1945), Biometrics Bulletin 1(6), 80–83; W. J. Conover (1999), Practical Nonparametric Statistics, section 5.7; D. S. Kerby (2014), Comprehensive Psychology 3, 11.IT.3.1",
    validity: "p from the exact distribution of the signs, given the ties, to 100 differences; beyond from the normal with Conover's variance for ties, no continuity correction",
};

/// With more differences the normal is used.
const MOST_EXACT: usize = 100;

/// The result of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedRank {
    /// Differences that are not zero.
    pub n: u32,
    /// Differences that are.
    pub zeros: u32,
    /// Sum of the ranks of the positive ones.
    pub positive: f64,
    /// Two-sided.
    pub p: Probability,
    /// Whether it is exact.
    pub exact: bool,
    /// Matched-pairs rank-biserial correlation, −1 to 1.
    pub biserial: f64,
}

/// The test of differences against a distribution that is symmetric about 0.
///
/// # Errors
/// Where no difference is there that is not zero.
pub fn signed_rank(differences: impl Iterator<Item = f64>) -> Result<SignedRank, Undefined> {
    let all: Vec<f64> = differences.collect();
    let largest = all.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    // Ratings are held to seven digits: what differs by less is a tie.
    let quantum = largest * 1e-6;
    let mut rounded: Vec<f64> = (all.iter())
        .map(|d| (d / quantum).round())
        .filter(|d| d.is_finite() && *d != 0.0)
        .collect();
    if rounded.is_empty() {
        return Err(Undefined::degenerate(
            "no participant rated the two differently",
        ));
    }
    rounded.sort_by(|one, other| by_size(&one.abs(), &other.abs()));
    // Twice the ranks, which are whole numbers.
    let (mut ranks, mut positive, mut ties) = (Vec::with_capacity(rounded.len()), 0, 0.0);
    for alike in rounded.chunk_by(|one, other| one.abs() == other.abs()) {
        let doubled = 2 * ranks.len() + alike.len() + 1;
        let above = alike.iter().filter(|d| **d > 0.0).count();
        positive += above * doubled;
        let t = alike.len() as f64;
        ties += t * t * t - t;
        ranks.extend(std::iter::repeat_n(doubled, alike.len()));
    }
    let n = ranks.len();
    let total = n * (n + 1);
    let exact = n <= MOST_EXACT;
    let p = if exact {
        exact_p(&ranks, positive, total)
    } else {
        let n = n as f64;
        let variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ties / 48.0;
        let z = (positive as f64 / 2.0 - n * (n + 1.0) / 4.0).abs() / variance.sqrt();
        normal_upper(z).times(2.0)
    };
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    Ok(SignedRank {
        n: count(n),
        zeros: count(all.len() - n),
        positive: positive as f64 / 2.0,
        p,
        exact,
        biserial: 2.0 * positive as f64 / total as f64 - 1.0,
    })
}

/// Twice the smaller tail of the sum of those ranks that a fair coin picks.
fn exact_p(ranks: &[usize], positive: usize, total: usize) -> Probability {
    let mut chance = vec![0.0_f64; total + 1];
    chance[0] = 1.0;
    let mut most = 0;
    for &rank in ranks {
        most += rank;
        for sum in (0..=most).rev() {
            let with = if sum >= rank { chance[sum - rank] } else { 0.0 };
            chance[sum] = (chance[sum] + with) / 2.0;
        }
    }
    // Symmetric about half the total.
    let nearer = positive.min(total - positive);
    let tail: f64 = chance[..=nearer].iter().sum();
    Probability::from_ln(tail.ln()).times(2.0)
}

#[cfg(test)]
mod tests;
