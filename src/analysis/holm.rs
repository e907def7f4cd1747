//! Holm's correction: the family-wise error stays at alpha, whatever the tests' dependence.

use super::statistic::{About, Correction};
use super::tails::Probability;

/// The declaration.
pub const CORRECTION: Correction = Correction {
    about: About {
        id: "holm",
        name: "Holm's step-down correction",
        formula: "p₍ᵢ₎ → max over j ≤ i of min(1, (m − j + 1) p₍ⱼ₎), p sorted upwards, m tests",
        source: "S. Holm (1979), Scandinavian Journal of Statistics 6(2), 65–70",
        validity: "bounds the chance of any false finding in the family, for any dependence between the tests",
    },
    short: "Holm",
    adjust,
};

/// Adjusted p-values, in the order given.
#[must_use]
pub fn adjust(p: &[Probability]) -> Vec<Probability> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&i, &j| p[i].total_cmp(&p[j]));
    let mut adjusted = p.to_vec();
    let mut largest = Probability::from_ln(f64::NEG_INFINITY);
    for (rank, &i) in order.iter().enumerate() {
        largest = largest.max(p[i].times((p.len() - rank) as f64));
        adjusted[i] = largest;
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

    /// R's manual page of `p.adjust` names the property; the values are worked by hand.
    #[test]
    fn worked_by_hand() {
        let ours = of(&[0.01, 0.04, 0.03, 0.005]);
        for (ours, expected) in ours.iter().zip([0.03, 0.06, 0.06, 0.02]) {
            assert!((ours - expected).abs() < 1e-15);
        }
        assert!(of(&[]).is_empty());
    }

    proptest! {
        /// A test is rejected at alpha exactly when the step-down procedure rejects it.
        #[test]
        fn is_the_step_down_procedure(p in prop::collection::vec(1e-6..1.0_f64, 1..12), alpha in 0.001..0.5_f64) {
            let mut sorted = p.clone();
            sorted.sort_by(f64::total_cmp);
            let m = p.len();
            let rejected = sorted.iter().enumerate().take_while(|(i, p)| **p <= alpha / (m - i) as f64).count();
            let ours = of(&p).iter().filter(|&&q| q <= alpha).count();
            prop_assert_eq!(ours, rejected);
        }
    }
}
