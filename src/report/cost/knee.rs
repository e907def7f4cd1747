//! Where a front bends: before it a little time buys much accuracy, behind it much time buys
//! little.

/// The point of a front that lies furthest below the chord between the front's ends, with the
/// logarithm of time and the error both scaled to 0 to 1 (the idea of Satopaa, Albrecht, Irwin &
/// Raghavan 2011, "Finding a 'kneedle' in a haystack", without their smoothing: a front does not
/// scatter).
///
/// Takes (time, error) in any unit and order and gives an index into them. Points without a
/// positive time have no logarithm and are left out. `None` where fewer than three points are
/// left, or none lies below the chord.
#[must_use]
pub fn knee(front: &[(f64, f64)]) -> Option<usize> {
    let usable = |&(_, &(time, error)): &(usize, &(f64, f64))| {
        time > 0.0 && time.is_finite() && error.is_finite()
    };
    let points: Vec<(usize, f64, f64)> = (front.iter().enumerate())
        .filter(usable)
        .map(|(index, &(time, error))| (index, time.ln(), error))
        .collect();
    let by_time = |a: &&(usize, f64, f64), b: &&(usize, f64, f64)| a.1.total_cmp(&b.1);
    let (&(_, first, worst), &(_, last, best)) = (
        points.iter().min_by(by_time)?,
        points.iter().max_by(by_time)?,
    );
    let (wide, high) = (last - first, worst - best);
    if points.len() < 3 || wide <= 0.0 || high <= 0.0 {
        return None;
    }
    // On the chord the two parts add up to 1.
    let below =
        |&(_, time, error): &(usize, f64, f64)| 1.0 - (time - first) / wide - (error - best) / high;
    let furthest = (points.iter()).max_by(|a, b| below(a).total_cmp(&below(b)))?;
    (below(furthest) > 1e-9).then_some(furthest.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// error = 1/t at t = 1, 2, …, 64: in (ln t / ln 64, (error − 1/64)/(1 − 1/64)) the chord
    /// falls by 1 − k/6 and the curve to (2^−k − 1/64)·64/63: the gap is widest where the
    /// derivative ln 2 · 2^−k · 64/63 is 1/6, k = 2.08, so at t = 4.
    #[test]
    fn the_knee_of_a_hyperbola_is_where_calculus_puts_it() {
        let front: Vec<(f64, f64)> = (0..=6)
            .map(|k| 2.0_f64.powi(k))
            .map(|time| (time, 1.0 / time))
            .collect();
        assert_eq!(knee(&front), Some(2));
        let mut turned = front;
        turned.reverse();
        turned.push((0.0, 3.0));
        assert_eq!(knee(&turned), Some(4));
    }

    #[test]
    fn a_straight_front_or_a_short_one_has_none() {
        let straight: Vec<(f64, f64)> = (0..4)
            .map(|k| (10.0_f64.powi(k), f64::from(4 - k)))
            .collect();
        assert_eq!(knee(&straight), None);
        assert_eq!(knee(&[(1.0, 2.0), (2.0, 1.0)]), None);
        assert_eq!(knee(&[(1.0, 2.0), (1.0, 1.5), (1.0, 1.0)]), None);
        assert_eq!(knee(&[]), None);
    }
}
