//! Ambient-occlusion techniques: each one file that declares itself and one WGSL file that
//! computes, and one line in [`TECHNIQUES`]. The config parser, the command line's help,
//! the application's lists and the cost sweep read this registry.

mod alchemy;
mod blizzard;
mod crytek;
mod gtao;
mod hbao;
mod none;
mod ray_march;
mod ray_traced;
mod sampling;
mod settings;
mod slices;
mod ssdo;
mod taps;
mod two_band;
mod vbao;

use crate::multi_bounce::Openness;
use crate::seed;
pub use settings::{Settings, SettingsError};

/// Every technique there is.
pub const TECHNIQUES: &[&Technique] = &[
    &none::NONE,
    &crytek::CRYTEK,
    &blizzard::BLIZZARD,
    &ray_march::RAY_MARCH,
    &alchemy::ALCHEMY,
    &hbao::HBAO,
    &gtao::GTAO,
    &vbao::VBAO,
    &two_band::TWO_BAND,
    &ssdo::SSDO,
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
    /// Spheres in place of the scene's triangles, seen or not: as many as the parameter
    /// [`PROXIES`] says.
    pub proxies: bool,
    /// Colours, and the light that falls on them. A technique that reads them answers by direction and
    /// colour, too: beside k_A it gives what the ambient light of a point changes by.
    pub light: bool,
}

impl Inputs {
    /// Nothing.
    pub const NONE: Self = Self {
        depth: false,
        normals: false,
        proxies: false,
        light: false,
    };

    /// Depth and normals.
    pub const SURFACES: Self = Self {
        depth: true,
        normals: true,
        ..Self::NONE
    };
}

/// What of an estimate differs from pixel to pixel on one even surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noise {
    /// Nothing: there is nothing to blur.
    None,
    /// The samples turn with the 4 × 4 tile of [`noise_tile`].
    Tile,
    /// The samples turn along a Hilbert curve, well spread over any patch of pixels.
    Hilbert,
}

/// How often a technique looks at the scene for one estimate: what its work grows with, and
/// what techniques are compared by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Taps {
    /// Never.
    None,
    /// As often as a parameter says.
    Count(&'static str),
    /// At `steps` places along each of `count` lines, to one or two `sides`.
    Lines {
        /// The parameter that is the number of lines.
        count: &'static str,
        /// 1, or 2 where a line is looked along both ways.
        sides: u32,
        /// The parameter that is the number of places along a side.
        steps: &'static str,
    },
}

/// Something a technique can be set to.
#[derive(Debug)]
pub struct Parameter {
    /// Name in configs, with its unit.
    pub name: &'static str,
    /// What it does, one line.
    pub meaning: &'static str,
    /// Which values there are.
    pub range: Range,
}

/// The values of a parameter.
#[derive(Debug, Clone, Copy)]
pub enum Range {
    /// Numbers.
    Number {
        /// Unit for messages; empty for a plain number.
        unit: &'static str,
        /// Smallest value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
        /// Value where nothing else is said.
        default: f64,
        /// Only multiples of this; 0 for any number.
        multiple_of: f64,
    },
    /// Words; the first is the value where nothing else is said. WGSL gets its place among them.
    Choice(&'static [&'static str]),
}

impl Parameter {
    /// A number in a unit, from `low` to `high`.
    #[must_use]
    pub const fn number(
        name: &'static str,
        unit: &'static str,
        (low, high): (f64, f64),
        default: f64,
        meaning: &'static str,
    ) -> Self {
        Self {
            name,
            meaning,
            range: Range::Number {
                unit,
                low,
                high,
                default,
                multiple_of: 0.0,
            },
        }
    }

    /// A count, from `low` to `high` in steps of `step`.
    #[must_use]
    pub const fn count(
        name: &'static str,
        (low, high): (f64, f64),
        step: f64,
        default: f64,
        meaning: &'static str,
    ) -> Self {
        Self {
            name,
            meaning,
            range: Range::Number {
                unit: "",
                low,
                high,
                default,
                multiple_of: step,
            },
        }
    }

    /// One of some words, the first by default.
    #[must_use]
    pub const fn choice(
        name: &'static str,
        words: &'static [&'static str],
        meaning: &'static str,
    ) -> Self {
        Self {
            name,
            meaning,
            range: Range::Choice(words),
        }
    }

    /// What is allowed, and the default, for people.
    #[must_use]
    pub fn allowed(&self) -> String {
        match self.range {
            Range::Choice(words) => format!("{} (default {})", words.join(" or "), words[0]),
            Range::Number {
                unit,
                low,
                high,
                default,
                multiple_of,
            } => {
                let space = if unit.is_empty() { "" } else { " " };
                let steps = if multiple_of > 1.0 {
                    format!("multiples of {multiple_of}, ")
                } else {
                    String::new()
                };
                format!("{steps}{low} to {high}{space}{unit} (default {default})")
            }
        }
    }
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
    /// Its own parameters, in the order of the WGSL struct `Params`.
    pub parameters: &'static [Parameter],
    /// The parameter that is its number of samples a pixel, if it has one.
    pub samples: Option<&'static str>,
    /// How often it looks at the scene for one estimate.
    pub taps: Taps,
    /// The parameter that is the distance from which on nothing occludes, metres, if it has one.
    pub reach: Option<&'static str>,
    /// Known settings.
    pub presets: &'static [Preset],
    /// Whether it also says which way its open directions lie, so that the environment's light can
    /// be taken from within their cone.
    pub gives_cone: bool,
    /// Its WGSL; `None` for a technique that runs no pass.
    pub shader: Option<&'static str>,
    /// Its seeded points or rotations, for the WGSL's `kernel`.
    pub kernel: fn(&Settings, seed: u64) -> Vec<[f32; 4]>,
}

impl Technique {
    /// Its own parameters, then those of every technique that runs a pass, then those of every
    /// technique that estimates a share of the hemisphere.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        let common: &[Parameter] = match self.shader {
            Some(_) => COMMON,
            None => &[],
        };
        let reflecting: &[Parameter] = match self.openness() {
            Some(_) => &INTER_REFLECTING,
            None => &[],
        };
        self.parameters.iter().chain(common).chain(reflecting)
    }

    /// What openness its estimate is, if it is any: what a multi-bounce model may start from. An
    /// empirical darkening is none; a technique that answers by direction brings its own bounce.
    #[must_use]
    pub fn openness(&self) -> Option<Openness> {
        match self.weighting {
            _ if self.inputs.light => None,
            Weighting::Uniform => Some(Openness::Uniform),
            Weighting::Cosine => Some(Openness::Cosine),
            Weighting::None | Weighting::Empirical | Weighting::Obscurance => None,
        }
    }

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
        self.all_parameters()
            .find(|parameter| parameter.name == name)
    }
}

/// Name of the parameter that every technique with a pass has: at which resolution it runs.
pub(super) const RESOLUTION: &str = "resolution";

/// Name of the parameter that lets the environment's light in through the bent cone.
pub(super) const BENT_CONE: &str = "bent_cone";

/// Name of the parameter of a technique that reads [`Inputs::proxies`]: how many there are.
pub(super) const PROXIES: &str = "proxies";

/// What every technique that runs a pass can be set to beside its own parameters.
const COMMON: &[Parameter] = &[Parameter::choice(
    RESOLUTION,
    &["full", "half"],
    "one estimate a pixel, or one for 2 x 2 pixels, brought to the others by depth",
)];

/// Name of the parameter that says which light between surfaces is added to the ambient term.
pub const INTER_REFLECTION: &str = "inter_reflection";

/// What every technique with an [`openness`](Technique::openness) can be set to. The published model
/// is not among the words: it has a pole where bright surfaces lie open.
const INTER_REFLECTING: [Parameter; 1] = [Parameter::choice(
    INTER_REFLECTION,
    &["none", "published-safe", "jimenez-2016", "greyfield"],
    "model of the light between surfaces that the ambient term gets by colour channel",
)];

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
pub(super) const SHARED_WGSL: &[(&str, &str)] = &[
    ("thesis_falloff", include_str!("thesis_falloff.wgsl")),
    ("spatial_noise", include_str!("spatial_noise.wgsl")),
    ("slices", include_str!("slices.wgsl")),
    ("proxies", include_str!("proxies.wgsl")),
];

#[cfg(test)]
mod tests;
