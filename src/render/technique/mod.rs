//! Ambient-occlusion techniques: each one file that declares itself and one WGSL file that
//! computes, and one line in [`TECHNIQUES`]. The config parser, the command line's help,
//! the application's lists and the cost sweep read this registry.

mod blizzard;
mod crytek;
mod none;
mod ray_march;
mod ray_traced;
mod sampling;
mod settings;

use crate::seed;
pub use settings::{Settings, SettingsError};

/// Every technique there is.
pub const TECHNIQUES: &[&Technique] = &[
    &none::NONE,
    &crytek::CRYTEK,
    &blizzard::BLIZZARD,
    &ray_march::RAY_MARCH,
    &ray_traced::RAY_TRACED,
];

/// What an estimate of occlusion weights directions by. Mixing them is a bias: the
/// multi-bounce model wants uniform, the shading equation cosine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weighting {
    /// There is no estimate.
    None,
    /// An empirical darkening that estimates no integral over the hemisphere.
    Empirical,
    /// Every direction of the hemisphere alike.
    Uniform,
    /// By the cosine to the normal.
    Cosine,
    /// By the distance of what blocks it.
    Obscurance,
}

/// What a technique reads of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inputs {
    /// Linear depth.
    pub depth: bool,
    /// World-space normals.
    pub normals: bool,
}

/// What of an estimate differs from pixel to pixel on one even surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noise {
    /// Nothing: there is nothing to blur.
    None,
    /// The samples turn with the 4 × 4 tile of [`noise_tile`].
    Tile,
}

/// A number a technique can be set to.
#[derive(Debug)]
pub struct Parameter {
    /// Name in configs, with its unit.
    pub name: &'static str,
    /// What it does, one line.
    pub meaning: &'static str,
    /// Unit for messages; empty for a plain number.
    pub unit: &'static str,
    /// Smallest value allowed.
    pub low: f64,
    /// Largest value allowed.
    pub high: f64,
    /// Value where nothing else is said.
    pub default: f64,
    /// Only multiples of this; 0 for any number.
    pub multiple_of: f64,
}

/// A label for settings that people know.
#[derive(Debug)]
pub struct Preset {
    /// As it stands in configs and trial rows (`blizzard24`).
    pub label: &'static str,
    /// What it sets.
    pub values: &'static [(&'static str, f64)],
}

/// A technique, as it declares itself.
#[derive(Debug)]
pub struct Technique {
    /// Name in configs.
    pub name: &'static str,
    /// What it does, one line.
    pub summary: &'static str,
    /// Where it comes from.
    pub citation: &'static str,
    /// What its estimate weights directions by.
    pub weighting: Weighting,
    /// What it reads.
    pub inputs: Inputs,
    /// How its estimate varies between neighbours, for the blur.
    pub noise: Noise,
    /// Its parameters, in the order of the WGSL struct `Params`.
    pub parameters: &'static [Parameter],
    /// The parameter that is its number of samples a pixel, if it has one.
    pub samples: Option<&'static str>,
    /// Known settings.
    pub presets: &'static [Preset],
    /// Its WGSL; `None` for a technique that runs no pass.
    pub shader: Option<&'static str>,
    /// Its seeded points or rotations, for the WGSL's `kernel`.
    pub kernel: fn(&Settings, seed: u64) -> Vec<[f32; 4]>,
}

impl Technique {
    /// Whether it hides any light at all.
    #[must_use]
    pub fn occludes(&self) -> bool {
        self.shader.is_some() || self.is_handed_in()
    }

    /// Whether its occlusion is computed outside of the renderer and handed in: it estimates
    /// something, and no shader does.
    #[must_use]
    pub fn is_handed_in(&self) -> bool {
        self.shader.is_none() && self.weighting != Weighting::None
    }

    /// The parameter of that name.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
    }
}

/// The technique of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Technique> {
    TECHNIQUES
        .iter()
        .copied()
        .find(|technique| technique.name == name)
}

/// The 4 × 4 tile of unit vectors that turns or mirrors a technique's samples from pixel to
/// pixel. Evenly distributed on the sphere, the same on every machine.
#[must_use]
pub fn noise_tile(seed: u64) -> [[f32; 4]; 16] {
    let mut rng = seed::generator(seed, "occlusion-noise-tile", 0);
    std::array::from_fn(|_| sampling::on_sphere(&mut rng).extend(0.0).to_array())
}

/// WGSL that techniques share beyond the common parts.
pub(super) const SHARED_WGSL: &[(&str, &str)] =
    &[("thesis_falloff", include_str!("thesis_falloff.wgsl"))];

#[cfg(test)]
mod tests;
