//! The middle of repeated measurements, and how well it is known.

use serde::{Deserialize, Serialize};

/// The median of some numbers with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The interval of the median, free of any distribution: between the order statistics that
    /// the binomial distribution gives (Conover 1999, 3.2). `None` for fewer than six numbers,
    /// of which no two enclose the median with 95 % probability.
    pub interval: Option<(f64, f64)>,
    /// How many there were.
    pub count: usize,
}

impl Spread {
    /// Of some numbers; `None` of none.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        let mut sorted = numbers.to_vec();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        let middle = *sorted.get(count / 2)?;
        let median = match count % 2 {
            1 => middle,
            _ => 0.5 * (sorted[count / 2 - 1] + middle),
        };
        let interval = outermost(count).map(|below| (sorted[below], sorted[count - 1 - below]));
        Some(Self {
            median,
            interval,
            count,
        })
    }
}

/// How many of `count` sorted numbers may be left away at either end so that the rest still
/// encloses the median with a probability of 0.95 at least; `None` if none may and it does not.
fn outermost(count: usize) -> Option<usize> {
    // P(fewer than k + 1 of the numbers lie below the median), one end.
    let mut below = 0.5_f64.powi(i32::try_from(count).ok()?);
    let mut tail = below;
    if 2.0 * tail > 0.05 {
        return None;
    }
    let mut left_away = 0;
    for k in 1..=count / 2 {
        below *= (count - k + 1) as f64 / k as f64;
        tail += below;
        if 2.0 * tail > 0.05 {
            break;
        }
        left_away = k;
    }
    Some(left_away)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Ranks of the 95 % interval of a median from the binomial table (Conover 1999, table A3;
    /// 1-based): n = 6: 1 and 6; n = 10: 2 and 9; n = 30: 10 and 21.
    #[test]
    fn the_ranks_are_the_tables() {
        for (count, rank) in [(6, 1), (9, 2), (10, 2), (20, 6), (30, 10)] {
            assert_eq!(outermost(count), Some(rank - 1), "{count}");
        }
        assert_eq!(outermost(5), None);
    }

    #[test]
    fn few_numbers_have_a_median_and_no_interval() {
        let found = Spread::of(&[3.0, 1.0, 2.0, 10.0]).unwrap();
        assert_eq!((found.median, found.interval, found.count), (2.5, None, 4));
        assert_eq!(Spread::of(&[]), None);
    }

    proptest! {
        #[test]
        fn the_interval_encloses_the_median(numbers in prop::collection::vec(0.0_f64..1e6, 6..60)) {
            let found = Spread::of(&numbers).unwrap();
            let (low, high) = found.interval.unwrap();
            prop_assert!(low <= found.median && found.median <= high);
        }
    }
}
