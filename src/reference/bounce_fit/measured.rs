//! What the texels of a bin of openness receive of each bounce: the data that models are fitted to.

use crate::reference::height_field::{BINS, Bounces, bin_of};

/// Texels that a bin has at least to say anything.
pub const LEAST_TEXELS: u64 = 32;

/// A bin of openness.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredBin {
    /// Mean openness of its texels, 0 closed to 1 open.
    pub openness: f64,
    /// How many there are.
    pub texels: u64,
    /// Mean share of the light in the open that each bounce brings at an albedo of 1: F₀, F₁, …
    pub factors: Vec<f64>,
}

/// The curves of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// What it is called.
    pub name: String,
    /// Its bins, by openness; those of few texels are left out.
    pub bins: Vec<MeasuredBin>,
}

impl Measured {
    /// The curves of bounces that were followed at an albedo of 1.
    #[must_use]
    pub fn of(name: impl Into<String>, bounces: &Bounces) -> Self {
        let count = bounces.irradiance.len();
        let mut bins = vec![(0_u64, 0.0_f64, vec![0.0_f64; count]); BINS];
        for (texel, openness) in bounces.openness.iter().enumerate() {
            let (texels, sum, factors) = &mut bins[bin_of(*openness)];
            *texels += 1;
            *sum += f64::from(*openness);
            for (factor, irradiance) in factors.iter_mut().zip(&bounces.irradiance) {
                *factor += f64::from(irradiance[texel]) / std::f64::consts::PI;
            }
        }
        let mean = |(texels, sum, factors): (u64, f64, Vec<f64>)| MeasuredBin {
            openness: sum / texels as f64,
            texels,
            factors: factors.iter().map(|f| f / texels as f64).collect(),
        };
        Self {
            name: name.into(),
            bins: bins
                .into_iter()
                .filter(|(texels, ..)| *texels >= LEAST_TEXELS)
                .map(mean)
                .collect(),
        }
    }
}

impl MeasuredBin {
    /// E/E₀ where every texel has this albedo, 0 to 1: Σ ρⁱ Fᵢ.
    #[must_use]
    pub fn received(&self, albedo: f64) -> f64 {
        let sum = |sum: f64, factor: &f64| sum * albedo + factor;
        self.factors.iter().rev().fold(0.0, sum)
    }
}
