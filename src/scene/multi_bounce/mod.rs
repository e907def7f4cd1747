//! Models of the light that goes to and fro in cavities: from how open a point is and how much its
//! surface sends back, to how much brighter it is than direct light alone makes it.
//!
//! A model is one file that declares itself, and one line in [`MODELS`]. Its formula stands once,
//! for both float widths; WGSL has a copy of it that a test holds to the same numbers.

mod greyfield;
mod jimenez_2016;
mod none;
mod published;
mod published_safe;

/// What of a point a model is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// In double precision.
    pub f64: fn(openness: f64, albedo: f64) -> f64,
    /// In single precision.
    pub f32: fn(openness: f32, albedo: f32) -> f32,
    /// `fn multi_bounce(openness: f32, albedo: f32) -> f32`.
    pub wgsl: &'static str,
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

/// Writes one formula for both float widths: `formula!(fn name(openness, albedo) { … })` makes a
/// module `name` with `f64` and `f32`. Within, `F` is the float and `c(1.5)` a number of it.
macro_rules! formula {
    ($name:ident, |$openness:ident, $albedo:ident, $c:ident| $body:expr) => {
        mod $name {
            formula!(@one f64, |$openness, $albedo, $c| $body);
            formula!(@one f32, |$openness, $albedo, $c| $body);
        }
    };
    (@one $float:ident, |$openness:ident, $albedo:ident, $c:ident| $body:expr) => {
        pub fn $float($openness: $float, $albedo: $float) -> $float {
            #[allow(dead_code, clippy::cast_possible_truncation)]
            const fn $c(number: f64) -> $float {
                number as $float
            }
            $body
        }
    };
}
use formula;

#[cfg(test)]
mod tests;
