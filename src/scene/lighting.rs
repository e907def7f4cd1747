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

/// A light from one point, all round or in a cone.
#[derive(Debug, Clone, PartialEq)]
pub struct PointLight {
    /// Where it is, metres.
    pub position_m: Vec3,
    /// Linear RGB radiant intensity: irradiance on a surface that faces it at 1 m.
    pub intensity: Vec3,
    /// For a spot light, where it shines; `None` shines all round.
    pub cone: Option<Cone>,
}

/// The cone of a spot light, with the smooth edge of `KHR_lights_punctual`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Unit vector from the light along the axis.
    pub along: Vec3,
    /// Half angle within which the light is whole, radians.
    pub inner_rad: f32,
    /// Half angle beyond which there is none, radians; more than `inner_rad`.
    pub outer_rad: f32,
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
    /// Whether surfaces mirror the environment, by their roughness.
    pub reflections: bool,
    /// A directional light, if there is one.
    pub sun: Option<Sun>,
    /// Lights from points.
    pub points: Vec<PointLight>,
    /// What the model's own lights are multiplied by; `None` leaves them dark.
    pub model_lights: Option<f32>,
    /// Light from all round; present where `ambient` or `background` use it.
    pub environment: Option<Environment>,
    /// Exposure in stops: radiance is multiplied by 2 to this power before the tone map.
    pub exposure_ev: f32,
    /// The tone map.
    pub tone_map: ToneMap,
}
