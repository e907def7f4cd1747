//! How far an estimate of occlusion lies from another, over some of the pixels.

use serde::{Deserialize, Serialize};

/// Distance of an estimate from what it should be. Occlusion is the coefficient k_A, 0 closed
/// to 1 open, and so are its errors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OcclusionError {
    /// Root of the mean squared error.
    pub rmse: f64,
    /// Mean absolute error.
    pub mae: f64,
    /// 95th percentile of the absolute error.
    pub p95: f64,
    /// Mean error: above 0 the estimate is too open.
    pub bias: f64,
}

impl OcclusionError {
    /// Of pairs (estimate, what it should be); all 0 of none.
    #[must_use]
    pub fn of(pairs: impl Iterator<Item = (f32, f32)>) -> Self {
        let mut apart: Vec<f64> = pairs
            .map(|(found, wanted)| f64::from(found) - f64::from(wanted))
            .collect();
        let count = apart.len();
        if count == 0 {
            return Self {
                rmse: 0.0,
                mae: 0.0,
                p95: 0.0,
                bias: 0.0,
            };
        }
        let mean = |sum: f64| sum / count as f64;
        let squares = apart.iter().map(|error| error * error).sum();
        let absolute = apart.iter().map(|error| error.abs()).sum();
        let bias = mean(apart.iter().sum());
        // The nearest rank: the smallest error that 95 % of the pixels do not exceed.
        let rank = (0.95 * count as f64).ceil() as usize - 1;
        for error in &mut apart {
            *error = error.abs();
        }
        let (_, p95, _) = apart.select_nth_unstable_by(rank, f64::total_cmp);
        Self {
            rmse: mean(squares).sqrt(),
            mae: mean(absolute),
            p95: *p95,
            bias,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// 19 pixels right and one off by −0.5: of 20, the 19th is the 95th percentile.
    #[test]
    fn known_errors_give_known_numbers() {
        let pairs = (0..20).map(|pixel| if pixel == 7 { (0.25, 0.75) } else { (0.5, 0.5) });
        let found = OcclusionError::of(pairs);
        assert!((found.rmse - (0.25_f64 / 20.0).sqrt()).abs() < 1e-12);
        assert!((found.mae - 0.5 / 20.0).abs() < 1e-12);
        assert!((found.bias + 0.5 / 20.0).abs() < 1e-12);
        assert_eq!(found.p95, 0.0);
        let two = OcclusionError::of((0..20).map(|k| (if k < 2 { 0.25 } else { 0.5 }, 0.5)));
        assert_eq!(two.p95, 0.25);
    }

    proptest! {
        #[test]
        fn bias_is_below_mae_and_mae_below_rmse(
            pairs in prop::collection::vec((0.0_f32..1.0, 0.0_f32..1.0), 1..200),
        ) {
            let found = OcclusionError::of(pairs.into_iter());
            prop_assert!(found.bias.abs() <= found.mae + 1e-12);
            prop_assert!(found.mae <= found.rmse + 1e-12);
            prop_assert!(found.p95 <= 1.0);
        }
    }
}
