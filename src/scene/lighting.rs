//! How a scene is lit: one of the variants (validity levels) of its config.

use glam::Vec3;

use super::Environment;

/// Light from everywhere, the part that occlusion takes away.
#[derive(Debug, Clone, PartialEq)]
pub enum Ambient {
    /// The same radiance from every direction (thesis eq. 5, L_A), linear RGB.
    Constant(Vec3),
    /// Irradiance of the scene's environment.
    Environment,
}

/// What stands where there is no surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// One linear RGB colour.
    Colour(Vec3),
    /// The environment's own radiance.
    Environment,
}

/// A directional light.
#[derive(Debug, Clone, PartialEq)]
pub struct Sun {
    /// Unit vector towards the light.
    pub towards: Vec3,
    /// Linear RGB irradiance on a surface that faces it.
    pub irradiance: Vec3,
    /// Whether surfaces cast shadows.
    pub casts_shadows: bool,
}

/// How linear radiance becomes a value to display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToneMap {
    /// Values above 1 are clipped; for scenes that have none.
    None,
    /// Reinhard et al. 2002, eq. 4, on luminance; `white` is the luminance that
    /// becomes 1.
    ReinhardExtended {
        /// Linear luminance that maps to display white.
        white: f32,
    },
    /// Narkowicz 2016's rational fit of the ACES filmic curve, a channel at a time.
    Aces,
}

/// One lighting variant of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    /// The ambient term.
    pub ambient: Ambient,
    /// Where no surface is.
    pub background: Background,
    /// A directional light, if there is one.
    pub sun: Option<Sun>,
    /// Light from all round; present where `ambient` or `background` use it.
    pub environment: Option<Environment>,
    /// Exposure in stops: radiance is multiplied by 2 to this power before the tone map.
    pub exposure_ev: f32,
    /// The tone map.
    pub tone_map: ToneMap,
}
