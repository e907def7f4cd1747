//! Power of Holm's procedure over a family of conditions that all have the effect.
//!
//! With independent, equally distributed p-values the number of rejections has a distribution that
//! can be summed: the procedure goes on at step j while at least j of the K p-values are at most
//! alpha/(K − j + 1). The number of p-values under each threshold is a chain of binomials.
//!
//! Source of the procedure: S. Holm (1979), Scandinavian Journal of Statistics 6(2), 65–70. The sum is
//! checked against an enumeration of all outcomes (`tests/data/power.R`).

use crate::analysis::tails::Binomial;

/// How many of K conditions Holm's procedure finds, as probabilities.
#[derive(Debug, Clone, PartialEq)]
pub struct Holm {
    /// P(exactly r rejections), r from 0 to K.
    rejections: Vec<f64>,
}

impl Holm {
    /// Given P(p ≤ alpha/(K − j + 1)) of one condition, for the steps j = 1 … K.
    #[must_use]
    pub fn new(at_most: &[f64]) -> Self {
        let conditions = at_most.len();
        let mut rejections = vec![0.0; conditions + 1];
        // P(the procedure is still going, and so many p-values are under the last threshold).
        let mut going = vec![0.0; conditions + 1];
        going[0] = 1.0;
        let mut before = 0.0;
        for (step, &here) in at_most.iter().enumerate() {
            let here = here.clamp(before, 1.0);
            // Of those above the last threshold, the share under this one.
            let share = if before < 1.0 {
                (here - before) / (1.0 - before)
            } else {
                1.0
            };
            going = moved(&going, share);
            // With `step` or fewer under the threshold of step + 1, it stops after `step`.
            rejections[step] = going[..=step].iter().sum();
            going[..=step].fill(0.0);
            before = here;
        }
        rejections[conditions] = going.iter().sum();
        Self { rejections }
    }

    /// A given condition is found; also the mean share of conditions found.
    #[must_use]
    pub fn each(&self) -> f64 {
        let conditions = self.rejections.len() - 1;
        let found = self.rejections.iter().zip(0_u32..);
        let mean: f64 = found.map(|(p, count)| p * f64::from(count)).sum();
        (mean / conditions.max(1) as f64).min(1.0)
    }

    /// At least one is found.
    #[must_use]
    pub fn any(&self) -> f64 {
        self.rejections[1..].iter().sum::<f64>().min(1.0)
    }

    /// All are found.
    #[must_use]
    pub fn all(&self) -> f64 {
        self.rejections.last().copied().unwrap_or(0.0).min(1.0)
    }

    /// P(exactly r are found), r from 0.
    #[must_use]
    pub fn rejections(&self) -> &[f64] {
        &self.rejections
    }
}

/// Each of those not yet under the threshold gets there with probability `share`.
fn moved(counts: &[f64], share: f64) -> Vec<f64> {
    let conditions = counts.len() - 1;
    let mut after = vec![0.0; counts.len()];
    for (already, &p) in counts.iter().enumerate().filter(|(_, p)| **p > 0.0) {
        add_binomial(&mut after[already..], conditions - already, share, p);
    }
    after
}

/// Adds `weight` · P(k of `n`) at every k, from the likeliest k outwards: what is far from it is
/// nothing, and a family of a hundred is summed in a millisecond.
fn add_binomial(at: &mut [f64], n: usize, share: f64, weight: f64) {
    let trials = u32::try_from(n).unwrap_or(u32::MAX);
    let Some(binomial) = Binomial::new(trials, share) else {
        return;
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // from 0 to n
    let likeliest = (((f64::from(trials) + 1.0) * share) as u32).min(trials);
    let top = weight * binomial.ln_pmf(likeliest).exp();
    let odds = binomial.p() / binomial.q();
    let likeliest = likeliest as usize;
    let mut term = top;
    for (k, sum) in at.iter_mut().enumerate().take(n + 1).skip(likeliest) {
        *sum += term;
        term *= (n - k) as f64 / (k as f64 + 1.0) * odds;
        if term < top * 1e-20 {
            break;
        }
    }
    let mut term = top;
    for k in (0..likeliest).rev() {
        term *= (k as f64 + 1.0) / (n - k) as f64 / odds;
        if term < top * 1e-20 {
            break;
        }
        at[k] += term;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::holm;
    use crate::analysis::tails::Probability;
    use crate::seed;
    use proptest::prelude::*;

    /// One condition is its own family.
    #[test]
    fn a_family_of_one() {
        let holm = Holm::new(&[0.3]);
        for found in [holm.each(), holm.any(), holm.all()] {
            assert!((found - 0.3).abs() < 1e-15);
        }
    }

    /// Two conditions, worked by hand: rejects both if both are under alpha and one is under
    /// alpha/2: F₂² − (F₂ − F₁)²; none with (1 − F₁)².
    #[test]
    fn a_family_of_two() {
        let (half, full) = (0.2, 0.5);
        let holm = Holm::new(&[half, full]);
        let none = (1.0 - half) * (1.0 - half);
        let both = full * full - (full - half) * (full - half);
        assert!((holm.rejections()[0] - none).abs() < 1e-15);
        assert!((holm.all() - both).abs() < 1e-15);
        assert!((holm.any() - (1.0 - none)).abs() < 1e-15);
    }

    /// The analysis' own correction over uniform p-values drawn a hundred thousand times, each
    /// count within four standard errors.
    #[test]
    fn agrees_with_the_correction_itself() {
        const FAMILY: usize = 5;
        const DRAWS: u32 = 100_000;
        let mut rng = seed::generator(1, "test-holm", 0);
        let mut counts = [0_u32; FAMILY + 1];
        for _ in 0..DRAWS {
            // p = u³ has P(p ≤ t) = t^⅓: small p-values, as under an effect.
            let p: Vec<Probability> = (0..FAMILY)
                .map(|_| Probability::from_ln(3.0 * seed::unit_f64(&mut rng).ln()))
                .collect();
            let found = holm::adjust(&p)
                .iter()
                .filter(|p| p.value() <= 0.05)
                .count();
            counts[found] += 1;
        }
        let levels: Vec<f64> = (1..=FAMILY)
            .map(|step| (0.05 / (FAMILY - step + 1) as f64).cbrt())
            .collect();
        let exact = Holm::new(&levels);
        for (&count, &p) in counts.iter().zip(exact.rejections()) {
            let (found, n) = (f64::from(count) / f64::from(DRAWS), f64::from(DRAWS));
            let error = (p * (1.0 - p) / n).sqrt();
            assert!((found - p).abs() < 4.0 * error, "{found} {p}");
        }
    }

    proptest! {
        #[test]
        fn is_a_distribution_between_bonferroni_and_no_correction(
            mut levels in prop::collection::vec(0.0..=1.0_f64, 1..30)
        ) {
            levels.sort_by(f64::total_cmp);
            let holm = Holm::new(&levels);
            prop_assert!((holm.rejections().iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let (first, last) = (levels[0], levels[levels.len() - 1]);
            prop_assert!(holm.each() >= first - 1e-12 && holm.each() <= last + 1e-12);
            prop_assert!(holm.all() <= holm.each() + 1e-12 && holm.each() <= holm.any() + 1e-12);
            // The first step is Bonferroni's.
            let any = 1.0 - (1.0 - first).powi(i32::try_from(levels.len()).unwrap());
            prop_assert!((holm.any() - any).abs() < 1e-12);
        }
    }
}
