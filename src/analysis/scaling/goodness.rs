//! How well a model fits: likelihood-ratio and Pearson chi-square against the saturated model, in
//! which every row has a probability of its own.

use nalgebra::DVector;

use super::fit::Design;
use super::link::Link;

/// Misfit of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// G², twice the log of the likelihood ratio.
    pub g2: f64,
    /// Pearson's X².
    pub x2: f64,
    /// The smallest expected count of a cell.
    pub smallest_expected: f64,
    /// The log-likelihood, without binomial coefficients.
    pub log_likelihood: f64,
}

/// Misfit of a design at given parameters.
#[must_use]
pub fn misfit(design: &Design, link: Link, beta: &DVector<f64>) -> Misfit {
    let mut sum = Misfit {
        g2: 0.0,
        x2: 0.0,
        smallest_expected: f64::INFINITY,
        log_likelihood: 0.0,
    };
    for row in &design.rows {
        let at = link.at(design.eta(row, beta));
        sum.log_likelihood += row.wins * at.ln_win + row.losses * at.ln_loss;
        let votes = row.wins + row.losses;
        for (observed, ln_share) in [(row.wins, at.ln_win), (row.losses, at.ln_loss)] {
            let expected = votes * ln_share.exp();
            sum.smallest_expected = sum.smallest_expected.min(expected);
            if expected > 0.0 {
                let difference = observed - expected;
                sum.x2 += difference * difference / expected;
                sum.g2 += 2.0 * expected * half_deviance(difference / expected);
            }
        }
    }
    sum
}

/// (1 + d) ln(1 + d) − d for d ≥ −1. Summed over the two cells of a row, the −d cancel, and what is
/// left keeps its digits where observed and expected counts are large and close.
fn half_deviance(d: f64) -> f64 {
    if d <= -1.0 {
        return 1.0;
    }
    if d.abs() < 0.01 {
        // Σ (−d)^k / (k (k − 1)), k = 2, 3, …
        let mut power = d * d;
        let mut sum = 0.0;
        for k in 2..12 {
            let k = f64::from(k);
            sum += power / (k * (k - 1.0));
            power *= -d;
        }
        return sum;
    }
    (1.0 + d) * d.ln_1p() - d
}
