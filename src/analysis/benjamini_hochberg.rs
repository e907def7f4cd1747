//! Benjamini and Hochberg's correction: the expected share of false findings stays at alpha.

use super::statistic::{About, Correction};
use super::tails::Probability;

/// The declaration.
pub const CORRECTION: Correction = Correction {
    about: About {
        id: "bh",
        name: "Benjamini–Hochberg step-up correction",
        formula: "p₍ᵢ₎ → min over j ≥ i of min(1, m p₍ⱼ₎ / j), p sorted upwards, m tests",
        source: "Y. Benjamini, Y. Hochberg (1995), JRSS B 57(1), 289–300",
        validity: "bounds the expected share of false findings for independent or positively dependent tests",
    },
    short: "BH",
    adjust,
};

/// Adjusted p-values, in the order given.
#[must_use]
pub fn adjust(p: &[Probability]) -> Vec<Probability> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&i, &j| p[i].total_cmp(&p[j]));
    let mut adjusted = p.to_vec();
    let mut smallest = Probability::ONE;
    for (rank, &i) in order.iter().enumerate().rev() {
        smallest = smallest.min(p[i].times(p.len() as f64 / (rank + 1) as f64));
        adjusted[i] = smallest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn of(values: &[f64]) -> Vec<f64> {
        let p: Vec<_> = values
            .iter()
            .map(|v| Probability::from_ln(v.ln()))
            .collect();
        adjust(&p).iter().map(|p| p.value()).collect()
    }

    #[test]
    fn worked_by_hand() {
        let ours = of(&[0.01, 0.04, 0.03, 0.005]);
        for (ours, expected) in ours.iter().zip([0.02, 0.04, 0.04, 0.02]) {
            assert!((ours - expected).abs() < 1e-15);
        }
    }

    proptest! {
        /// A test is rejected at alpha exactly when the step-up procedure rejects it.
        #[test]
        fn is_the_step_up_procedure(p in prop::collection::vec(1e-6..1.0_f64, 1..12), alpha in 0.001..0.5_f64) {
            let mut sorted = p.clone();
            sorted.sort_by(f64::total_cmp);
            let m = p.len() as f64;
            let rejected = (1..=p.len()).rev().find(|&i| sorted[i - 1] <= alpha * i as f64 / m).unwrap_or(0);
            let ours = of(&p).iter().filter(|&&q| q <= alpha).count();
            prop_assert_eq!(ours, rejected);
        }
    }
}
