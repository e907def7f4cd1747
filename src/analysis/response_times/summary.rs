//! Mean and spread in one pass, and quantiles.

/// Number, mean and squared deviations of some numbers, by Welford's recurrence (1962,
/// Technometrics 4(3), 419–420): no cancellation, however far the mean is from 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    n: f64,
    mean: f64,
    squares: f64,
}

impl FromIterator<f64> for Moments {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut moments = Self::default();
        for value in values {
            moments.n += 1.0;
            let before = value - moments.mean;
            moments.mean += before / moments.n;
            moments.squares += before * (value - moments.mean);
        }
        moments
    }
}

impl Moments {
    /// How many, a whole number.
    pub fn n(&self) -> f64 {
        self.n
    }

    /// Their mean; 0 for none.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Standard deviation with n − 1; `None` under two numbers.
    pub fn sd(&self) -> Option<f64> {
        (self.n >= 2.0).then(|| (self.squares / (self.n - 1.0)).sqrt())
    }

    /// Standard error of the mean; `None` under two numbers.
    pub fn standard_error(&self) -> Option<f64> {
        self.sd().map(|sd| sd / self.n.sqrt())
    }
}

/// Quantiles by linear interpolation between order statistics, definition 7 of Hyndman and Fan
/// (1996, The American Statistician 50(4), 361–365): the default of R and of NumPy. Sorts the times, which must be positive.
pub fn quantiles<const N: usize>(times: &mut [f32], at: [f64; N]) -> Option<[f64; N]> {
    // Positive numbers have the order of their bits.
    times.sort_unstable_by_key(|time| time.to_bits());
    let last = times.len().checked_sub(1)?;
    Some(at.map(|share| {
        let place = share * last as f64;
        let below = (place.floor() as usize).min(last);
        let above = (below + 1).min(last);
        let (low, high) = (f64::from(times[below]), f64::from(times[above]));
        low + (place - below as f64) * (high - low)
    }))
}
