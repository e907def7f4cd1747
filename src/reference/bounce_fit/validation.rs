//! What a model misses on a map.

use super::ALBEDOS;
use super::measured::Measured;

/// A model under trial.
pub struct Candidate<'a> {
    /// What it is called.
    pub name: String,
    /// E/E₀ at a uniform openness and an albedo, with the direct light that the map measured there for
    /// those that take cosine-weighted openness.
    pub value: &'a (dyn Fn(f64, f64, f64) -> f64 + Sync),
}

/// The error of one model on one map at one albedo.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MapError {
    /// The model.
    pub model: String,
    /// The map.
    pub map: String,
    /// Whether the model was fitted to others alone.
    pub held_out: bool,
    /// The albedo, or none for all of 0 to 0.9 together.
    pub albedo: Option<f64>,
    /// Root mean square over bins of openness.
    pub rmse: f64,
    /// The same over the map's texels, each taken as the mean of its bin.
    pub rmse_by_texel: f64,
    /// Largest of any bin.
    pub worst: f64,
    /// Openness of that bin.
    pub worst_openness: f64,
    /// Bins in which the model is no finite number; they are left out of the rest.
    pub not_finite: usize,
}

/// The errors of a model on a map: at every albedo, then over 0 to 0.9.
#[must_use]
pub fn validate(candidate: &Candidate<'_>, map: &Measured, held_out: bool) -> Vec<MapError> {
    let over = |albedos: &[f64], albedo: Option<f64>| {
        let mut sums = Sums::default();
        for bin in &map.bins {
            for &rho in albedos {
                let direct = bin.factors.first().copied().unwrap_or(0.0);
                let missed = (candidate.value)(bin.openness, direct, rho) - bin.received(rho);
                sums.add(missed, bin.texels as f64, bin.openness);
            }
        }
        MapError {
            model: candidate.name.clone(),
            map: map.name.clone(),
            held_out,
            albedo,
            rmse: (sums.squares / sums.count).sqrt(),
            rmse_by_texel: (sums.texel_squares / sums.texels).sqrt(),
            worst: sums.worst.0,
            worst_openness: sums.worst.1,
            not_finite: sums.not_finite,
        }
    };
    ALBEDOS
        .iter()
        .map(|&rho| over(&[rho], Some(rho)))
        .chain([over(&ALBEDOS[..10], None)])
        .collect()
}

#[derive(Default)]
struct Sums {
    count: f64,
    squares: f64,
    texels: f64,
    texel_squares: f64,
    worst: (f64, f64),
    not_finite: usize,
}

impl Sums {
    fn add(&mut self, missed: f64, texels: f64, openness: f64) {
        if !missed.is_finite() {
            self.not_finite += 1;
            return;
        }
        self.count += 1.0;
        self.squares += missed * missed;
        self.texels += texels;
        self.texel_squares += texels * missed * missed;
        if missed.abs() > self.worst.0 {
            self.worst = (missed.abs(), openness);
        }
    }
}
