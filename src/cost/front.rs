//! The Pareto front: what nothing else beats in both time and error.

/// Which of some (time, error) points no other point beats: none is at least as fast and at
/// least as right, and better in one of the two.
#[must_use]
pub fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1);
    let is_beaten = |point| points.iter().any(|&other| beats(other, point));
    points
        .iter()
        .map(|&point| point.0.is_finite() && point.1.is_finite() && !is_beaten(point))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_slower_and_no_better_is_not_on_it() {
        let points = [
            (1.0, 9.0),
            (2.0, 5.0),
            (3.0, 5.0),
            (4.0, 1.0),
            (2.0, 6.0),
            (0.0, 20.0),
        ];
        assert_eq!(front(&points), [true, true, false, true, false, true]);
    }

    proptest! {
        /// Along the front error falls as time grows, and every other point has one that beats it.
        #[test]
        fn time_buys_error_along_it(
            points in prop::collection::vec((0.0_f64..10.0, 0.0_f64..1.0), 1..40),
        ) {
            let on = front(&points);
            let mut kept: Vec<_> = points.iter().zip(&on).filter(|(_, on)| **on).map(|(p, _)| *p).collect();
            prop_assert!(!kept.is_empty());
            kept.sort_by(|a, b| a.0.total_cmp(&b.0));
            prop_assert!(kept.windows(2).all(|two| two[0] == two[1] || two[0].1 > two[1].1));
            for (point, on) in points.iter().zip(&on) {
                let is_met = kept.iter().any(|k| k.0 <= point.0 && k.1 <= point.1);
                prop_assert!(*on || is_met);
            }
        }
    }
}
