//! Scenes that need no file: generated from a seed, the same on every machine.
//!
//! Each generator is one file or folder that declares itself as a [`Generator`], and
//! one line in [`GENERATORS`].

pub mod atrium;
pub mod figures;
pub mod figurine;

use super::Geometry;

/// A procedural scene.
#[derive(Debug)]
pub struct Generator {
    /// Name in scene configs (`[geometry] generator = "atrium"`).
    pub name: &'static str,
    /// One line for help texts.
    pub summary: &'static str,
    /// Makes the geometry; the same seed gives the same bytes.
    pub generate: fn(seed: u64) -> Geometry,
}

/// Every generator there is.
pub const GENERATORS: &[&Generator] = &[
    &atrium::GENERATOR,
    &figurine::GENERATOR,
    &figures::GENERATOR,
];

/// The generator of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Generator> {
    GENERATORS
        .iter()
        .copied()
        .find(|generator| generator.name == name)
}
