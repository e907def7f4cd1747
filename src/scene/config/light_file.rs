//! `[environment]` and `[lighting.NAME]` of a scene config as they are written.

use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use super::file::{Coordinate, Point};
use crate::config::quantity::{Degrees, Unit, quantity};
use crate::scene::ToneMap;

quantity! {
    /// One component of a linear radiance, irradiance or radiant intensity.
    Light: f32, 0.0, 10_000.0, ""
}
quantity! {
    /// Exposure in photographic stops.
    Stops: f32, -20.0, 20.0, "EV"
}
quantity! {
    /// A factor on light.
    Factor: f32, 0.0, 1_000_000.0, ""
}
quantity! {
    /// Height of the sun; the daylight model ends at the horizon.
    SunElevation: f32, 1.0, 90.0, "degrees"
}
quantity! {
    /// Preetham's turbidity; the model was fitted from 2.
    Turbidity: f32, 2.0, 10.0, ""
}
quantity! {
    /// Half angle of a spot light's cone.
    HalfAngle: f32, 0.0, 90.0, "degrees"
}
quantity! {
    /// A luminance above nothing.
    PositiveLight: f32, 0.01, 10_000.0, ""
}

pub(super) type Colour = [Light; 3];

/// Exactly one of: all six axes, `sky`, `file`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnvironmentFile {
    pub right: Option<Colour>,
    pub left: Option<Colour>,
    pub up: Option<Colour>,
    pub down: Option<Colour>,
    pub front: Option<Colour>,
    pub back: Option<Colour>,
    pub sky: Option<SkyFile>,
    pub file: Option<Spanned<PathBuf>>,
    pub rotation_deg: Option<Degrees>,
    pub intensity: Option<Factor>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SkyFile {
    pub sun_elevation_deg: SunElevation,
    pub sun_azimuth_deg: Degrees,
    pub turbidity: Option<Turbidity>,
    pub ground: Option<[Unit; 3]>,
    pub clouds: Option<Unit>,
    pub seed: Option<u64>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightingFile {
    pub extends: Option<Spanned<String>>,
    pub ambient: Option<Spanned<AmbientFile>>,
    pub background: Option<Spanned<BackgroundFile>>,
    pub environment: Option<EnvironmentChange>,
    pub reflections: Option<Spanned<bool>>,
    pub sun: Option<Spanned<SunFile>>,
    pub point: Option<Vec<PointFile>>,
    pub model_lights: Option<Factor>,
    pub exposure_ev: Option<Stops>,
    pub tone_map: Option<ToneMapFile>,
}

impl LightingFile {
    /// Takes from `parent` every key that is not said here. A list of point lights is one key: a
    /// variant that has any has those and no others.
    pub fn or(self, parent: &Self) -> Self {
        let parent = parent.clone();
        Self {
            extends: None,
            ambient: self.ambient.or(parent.ambient),
            background: self.background.or(parent.background),
            environment: match (self.environment, parent.environment) {
                (Some(own), Some(parent)) => Some(own.or(parent)),
                (own, parent) => own.or(parent),
            },
            reflections: self.reflections.or(parent.reflections),
            sun: self.sun.or(parent.sun),
            point: self.point.or(parent.point),
            model_lights: self.model_lights.or(parent.model_lights),
            exposure_ev: self.exposure_ev.or(parent.exposure_ev),
            tone_map: self.tone_map.or(parent.tone_map),
        }
    }
}

/// What one variant changes of the scene's environment.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnvironmentChange {
    pub rotation_deg: Option<Degrees>,
    pub intensity: Option<Factor>,
}

impl EnvironmentChange {
    fn or(self, parent: Self) -> Self {
        Self {
            rotation_deg: self.rotation_deg.or(parent.rotation_deg),
            intensity: self.intensity.or(parent.intensity),
        }
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum AmbientFile {
    Constant(Colour),
    Environment,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum BackgroundFile {
    Colour(Colour),
    Environment,
}

/// The sky's own sun, or one given by hand.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SunFile {
    pub towards: Spanned<Towards>,
    pub irradiance: Option<Colour>,
    #[serde(default = "yes")]
    pub casts_shadows: bool,
}

fn yes() -> bool {
    true
}

/// `[x, y, z]`, or `"sky"`.
#[derive(Debug, Clone, Copy)]
pub(super) enum Towards {
    Vector([f32; 3]),
    Sky,
}

impl<'de> Deserialize<'de> for Towards {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TowardsVisitor;
        impl<'de> serde::de::Visitor<'de> for TowardsVisitor {
            type Value = Towards;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a direction such as [1, 2, 0], or \"sky\" for the sky's own sun")
            }

            fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<Towards, E> {
                match word {
                    "sky" => Ok(Towards::Sky),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(word), &self)),
                }
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(self, seq: A) -> Result<Towards, A::Error> {
                let list = serde::de::value::SeqAccessDeserializer::new(seq);
                Ok(Towards::Vector(
                    <[Coordinate; 3]>::deserialize(list)?.map(Coordinate::get),
                ))
            }
        }
        deserializer.deserialize_any(TowardsVisitor)
    }
}

/// A light from one point; with a cone, a spot light.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PointFile {
    pub position_m: Point,
    pub intensity: Colour,
    pub cone: Option<Spanned<ConeFile>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConeFile {
    pub target_m: Point,
    pub inner_deg: Option<HalfAngle>,
    pub outer_deg: HalfAngle,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum ToneMapFile {
    None,
    ReinhardExtended { white: PositiveLight },
    Aces,
}

impl From<ToneMapFile> for ToneMap {
    fn from(file: ToneMapFile) -> Self {
        match file {
            ToneMapFile::None => Self::None,
            ToneMapFile::Aces => Self::Aces,
            ToneMapFile::ReinhardExtended { white } => {
                Self::ReinhardExtended { white: white.get() }
            }
        }
    }
}
