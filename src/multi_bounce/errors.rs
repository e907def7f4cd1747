//! How far what a model says lies from what light does.

/// Distance of a model's E/E₀ from the truth, over many values. Errors are of E/E₀, of which 1 is a
/// point in the open.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ModelError {
    /// Root of the mean squared error.
    pub rmse: f64,
    /// Mean error: above 0 the model is too bright.
    pub bias: f64,
    /// 95th percentile of the absolute error.
    pub p95: f64,
    /// The largest absolute error.
    pub worst: f64,
    /// Values that the errors are of.
    pub values: u64,
    /// Values that are no finite number; the errors leave them out.
    pub not_finite: u64,
    /// Values below 0 or above 1; the errors are of them too.
    pub outside: u64,
}

impl ModelError {
    /// Of pairs (what the model says, the truth); all 0 of none.
    #[must_use]
    pub fn of(pairs: impl Iterator<Item = (f64, f64)>) -> Self {
        let (mut not_finite, mut outside, mut count) = (0, 0, 0.0_f64);
        let (mut sum, mut squares) = (0.0, 0.0);
        let mut apart: Vec<f64> = Vec::new();
        for (found, truth) in pairs {
            if !found.is_finite() {
                not_finite += 1;
                continue;
            }
            outside += u64::from(!(0.0..=1.0).contains(&found));
            let error = found - truth;
            (sum, squares, count) = (sum + error, squares + error * error, count + 1.0);
            apart.push(error.abs());
        }
        // The nearest rank: the smallest error that 95 % of the values do not exceed.
        let rank = ((0.95 * count).ceil() as usize).saturating_sub(1);
        let worst = apart.iter().copied().fold(0.0, f64::max);
        let p95 = match apart.is_empty() {
            true => 0.0,
            false => *apart.select_nth_unstable_by(rank, f64::total_cmp).1,
        };
        let count = count.max(1.0);
        Self {
            rmse: (squares / count).sqrt(),
            bias: sum / count,
            p95,
            worst,
            values: apart.len() as u64,
            not_finite,
            outside,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 38 right, one too dark by ½ and one too bright by 1: of 40, the 38th is the 95th percentile.
    /// What is no number counts for nothing but its count.
    #[test]
    fn known_errors_give_known_numbers() {
        let found = (0..43).map(|k| match k {
            7 => 0.0,
            9 => 1.5,
            40 => f64::NAN,
            41 => f64::INFINITY,
            42 => f64::NEG_INFINITY,
            _ => 0.5,
        });
        let found = ModelError::of(found.map(|value| (value, 0.5)));
        let expected = ModelError {
            rmse: (1.25_f64 / 40.0).sqrt(),
            bias: 0.5 / 40.0,
            p95: 0.0,
            worst: 1.0,
            values: 40,
            not_finite: 3,
            outside: 1,
        };
        assert_eq!(found, expected);
        let p95 = ModelError::of((0..40).map(|k| (if k < 3 { 0.25 } else { 0.5 }, 0.5))).p95;
        assert_eq!(p95, 0.25);
        assert_eq!(ModelError::of(std::iter::empty()).rmse, 0.0);
    }
}
