//! Irradiance over openness: what multi-bounce models are fitted to.

use serde::{Deserialize, Serialize};

use super::transport::Bounces;

/// Bins of the openness.
pub const BINS: usize = 100;

/// What the texels of one bin of openness receive of one bounce: a line of `curves.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Which bounce; 0 is direct light.
    pub bounce: usize,
    /// The middle of the bin, 0 closed to 1 open.
    pub openness: f64,
    /// Texels in it.
    pub texels: u64,
    /// Mean irradiance, as a share of the π of a point in the open.
    pub mean: f64,
    /// Standard deviation of that share: how much else than its openness a point depends on.
    pub deviation: f64,
}

/// The bin that an openness of 0 to 1 belongs to.
#[must_use]
pub fn bin_of(openness: f32) -> usize {
    ((openness * BINS as f32) as usize).min(BINS - 1)
}

/// The curves of all bounces; bins without a texel are left out.
#[must_use]
pub fn curves(bounces: &Bounces) -> Vec<CurvePoint> {
    let of = |(bounce, irradiance): (usize, &Vec<f32>)| {
        let mut sums = [(0_u64, 0.0_f64, 0.0_f64); BINS];
        for (openness, irradiance) in bounces.openness.iter().zip(irradiance) {
            let bin = bin_of(*openness);
            let share = f64::from(*irradiance) / std::f64::consts::PI;
            let (count, sum, squares) = &mut sums[bin];
            *count += 1;
            *sum += share;
            *squares += share * share;
        }
        let point = move |(bin, (count, sum, squares)): (usize, (u64, f64, f64))| {
            let texels = count as f64;
            let mean = sum / texels;
            (count > 0).then(|| CurvePoint {
                bounce,
                openness: (bin as f64 + 0.5) / BINS as f64,
                texels: count,
                mean,
                deviation: (squares / texels - mean * mean).max(0.0).sqrt(),
            })
        };
        sums.into_iter()
            .enumerate()
            .filter_map(point)
            .collect::<Vec<_>>()
    };
    bounces.irradiance.iter().enumerate().flat_map(of).collect()
}
