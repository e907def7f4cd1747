//! The models beside each other, all given the same.

use crate::multi_bounce::{COEFFICIENTS, MODELS, Openness};
use crate::reference::bounce_fit::Study;

/// E/E₀ of a uniform openness, the direct light measured there, and an albedo, each 0 to 1.
type Value<'a> = Box<dyn Fn(f64, f64, f64) -> f64 + 'a>;

/// A model as figures show it.
pub struct Shown<'a> {
    /// Name in the registry, or that of the refitted one.
    pub name: String,
    /// Whether it takes the direct light in place of the openness.
    pub is_cosine: bool,
    /// Whether it is finite and in 0 to 1 everywhere.
    pub is_safe: bool,
    /// What it says.
    pub value: Value<'a>,
}

/// Name of our own form with the coefficients that the study found.
pub const REFITTED: &str = "greyfield, refitted";

/// Every model of the registry, then the refitted one where there is one of its own.
pub fn models(study: &Study) -> Vec<Shown<'_>> {
    let mut found: Vec<Shown> = MODELS
        .iter()
        .map(|model| Shown {
            name: model.name.to_owned(),
            is_cosine: model.openness == Openness::Cosine,
            is_safe: model.is_safe,
            value: match model.openness {
                Openness::Uniform => Box::new(|alpha, _, rho| (model.f64)(alpha, rho)),
                Openness::Cosine => Box::new(|_, direct, rho| (model.f64)(direct, rho)),
            },
        })
        .collect();
    if let Some(refitted) = study.refitted.as_ref().filter(|own| **own != COEFFICIENTS) {
        found.push(Shown {
            name: REFITTED.to_owned(),
            is_cosine: false,
            is_safe: true,
            value: Box::new(|alpha, _, rho| refitted.value(alpha, rho)),
        });
    }
    found
}
