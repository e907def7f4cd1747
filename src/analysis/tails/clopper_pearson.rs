//! The Clopper–Pearson bounds, as quantiles of the beta distribution.

use super::Alpha;
use super::beta::{Beta, logistic};

/// The exact interval of a proportion, `k` successes of `n`, at confidence 1 − alpha:
/// the set of p that neither one-sided test at alpha/2 rejects.
///
/// Source: C. J. Clopper, E. S. Pearson (1934), Biometrika 26(4), 404–413.
/// The whole interval [0, 1] for n = 0, which says nothing.
#[must_use]
pub fn clopper_pearson(k: u32, n: u32, alpha: Alpha) -> (f64, f64) {
    let k = k.min(n);
    let (low, _) = lower_bound(k, n, alpha);
    // The upper bound of k successes is the complement of the lower bound of n − k failures.
    let (_, high) = lower_bound(n - k, n, alpha);
    (low, high)
}

/// The p with P(X ≥ k) = alpha/2, and 1 − p, each to full precision.
fn lower_bound(k: u32, n: u32, alpha: Alpha) -> (f64, f64) {
    let ln_tail = (alpha.get() / 2.0).ln();
    if k == 0 {
        return (0.0, 1.0);
    }
    if k == n {
        // Pⁿ = alpha/2.
        let ln_p = ln_tail / f64::from(n);
        return (ln_p.exp(), -ln_p.exp_m1());
    }
    // P(X ≥ k) = I_p(k, n − k + 1); the logit keeps p and 1 − p both precise.
    let Some(beta) = Beta::new(f64::from(k), f64::from(n - k) + 1.0) else {
        return (0.0, 1.0);
    };
    let logit = beta.lower_quantile(ln_tail);
    (logistic(logit), logistic(-logit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ends_have_their_closed_form() {
        let alpha = Alpha::FIVE_PERCENT;
        let (low, high) = clopper_pearson(0, 36, alpha);
        assert_eq!(low, 0.0);
        assert!((high - (1.0 - 0.025_f64.powf(1.0 / 36.0))).abs() < 1e-15);
        assert_eq!(clopper_pearson(36, 36, alpha).1, 1.0);
        assert_eq!(clopper_pearson(0, 0, alpha), (0.0, 1.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn bounds_hold_the_share_and_mirror(
            n in 1_u32..2_000_000,
            at in 0.0..=1.0_f64,
            ln_alpha in -690.0..-0.001_f64,
        ) {
            let k = (f64::from(n) * at) as u32;
            let alpha = Alpha::try_from(ln_alpha.exp()).unwrap();
            let (low, high) = clopper_pearson(k, n, alpha);
            let share = f64::from(k) / f64::from(n);
            prop_assert!((0.0..=share).contains(&low), "{low} {share}");
            prop_assert!((share..=1.0).contains(&high), "{high} {share}");
            let (mirrored, _) = clopper_pearson(n - k, n, alpha);
            prop_assert!((1.0 - mirrored - high).abs() < 1e-12);
        }
    }
}
