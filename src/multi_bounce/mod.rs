//! Models of the light that goes to and fro in cavities: from how open a point is and how much its
//! surface sends back, to how much of a point's light in the open it receives.
//!
//! A model is one file that declares itself, and one line in [`MODELS`]. Its formula stands once
//! in Rust, for any float; its WGSL takes the same coefficients, and tests hold it to the same
//! numbers. Nothing here knows a scene, a height field or a GPU: the renderer, the truth and the
//! fits all read it.

mod errors;
mod greyfield;
mod jimenez_2016;
mod none;
mod published;
mod published_safe;

use num_traits::Float;

pub use errors::ModelError;
pub use greyfield::{COEFFICIENTS, Coefficients};

/// What of a point a model is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Openness {
    /// The share of directions that are free: α = (1/2π) ∫ V dω.
    Uniform,
    /// The share of cosine-weighted light that arrives: (1/π) ∫ V cosθ dω.
    Cosine,
}

/// A model: E(α, ρ) / E₀, the irradiance of a point against that of one in the open.
#[derive(Debug)]
pub struct Model {
    /// Name in configs.
    pub name: &'static str,
    /// What it does, one line.
    pub summary: &'static str,
    /// Where it comes from.
    pub citation: &'static str,
    /// What its first argument is.
    pub openness: Openness,
    /// Whether it is finite and in [0, 1] for every openness and albedo of [0, 1].
    pub is_safe: bool,
    /// In double precision: openness and albedo, each 0 to 1.
    pub f64: fn(openness: f64, albedo: f64) -> f64,
    /// In single precision.
    pub f32: fn(openness: f32, albedo: f32) -> f32,
    /// WGSL: `fn multi_bounce(openness: f32, albedo: f32) -> f32`.
    pub wgsl: fn() -> String,
}

/// Every model there is.
pub const MODELS: &[&Model] = &[
    &none::NONE,
    &published::PUBLISHED,
    &published_safe::PUBLISHED_SAFE,
    &jimenez_2016::JIMENEZ_2016,
    &greyfield::GREYFIELD,
];

/// The model of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Model> {
    MODELS.iter().copied().find(|model| model.name == name)
}

impl Model {
    /// E/E₀ where what is known is one or the other openness. What the model does not take is
    /// brought to what it does by our own direct term, F₀ = k_A.
    #[must_use]
    pub fn value(&self, given: Openness, openness: f64, albedo: f64) -> f64 {
        let openness = match (given, self.openness) {
            (Openness::Cosine, Openness::Uniform) => COEFFICIENTS.uniform_of(openness),
            (Openness::Uniform, Openness::Cosine) => COEFFICIENTS.cosine_of(openness),
            _ => openness,
        };
        (self.f64)(openness, albedo)
    }

    /// The same in WGSL: `fn inter_reflected(openness: f32, albedo: f32) -> f32`.
    #[must_use]
    pub fn wgsl_given(&self, given: Openness) -> String {
        let (convert, openness) = match (given, self.openness) {
            (Openness::Cosine, Openness::Uniform) => {
                (COEFFICIENTS.uniform_of_wgsl(), "uniform_of(openness)")
            }
            (Openness::Uniform, Openness::Cosine) => {
                (COEFFICIENTS.cosine_of_wgsl(), "cosine_of(openness)")
            }
            _ => (String::new(), "openness"),
        };
        format!(
            "{}{convert}fn inter_reflected(openness: f32, albedo: f32) -> f32 {{ return multi_bounce({openness}, albedo); }}\n",
            (self.wgsl)()
        )
    }
}

/// A number as a float of either width.
fn number<F: Float>(value: f64) -> F {
    // Both f32 and f64 take any f64, rounded.
    F::from(value).unwrap_or_else(F::nan)
}

/// Openness or albedo, which a texture may have rounded to just outside of their range.
fn unit<F: Float>(value: F) -> F {
    value.max(F::zero()).min(F::one())
}

#[cfg(test)]
mod tests;
