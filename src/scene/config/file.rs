//! A scene config as it is written: the tables and their keys, each value in its range.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::TechniqueParameters;
use super::geometry::GeometryFile;
use crate::config::quantity;
use crate::scene::ToneMap;

quantity::quantity! {
    /// A vertical field of view.
    FieldOfView: f32, 5.0, 150.0, "degrees"
}
quantity::quantity! {
    /// One component of a linear radiance or irradiance.
    Light: f32, 0.0, 10_000.0, ""
}
quantity::quantity! {
    /// What a model's lights, in candela and lux, are multiplied by.
    LightFactor: f32, 0.0, 1_000_000.0, ""
}
quantity::quantity! {
    /// One coordinate of a point.
    Coordinate: f32, -100_000.0, 100_000.0, "m"
}
quantity::quantity! {
    /// Exposure in photographic stops.
    Stops: f32, -20.0, 20.0, "EV"
}
quantity::quantity! {
    /// Shaded samples along one side of a pixel.
    Supersampling: u32, 1, 4, "samples a side"
}
quantity::quantity! {
    /// Half width of the occlusion blur.
    BlurRadius: u32, 0, 16, "px"
}
quantity::quantity! {
    /// A positive length.
    PositiveMetres: f32, 0.0001, 100_000.0, "m"
}

pub(super) type Colour = [Light; 3];
pub(super) type Point = [Coordinate; 3];

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    pub title: String,
    #[serde(default)]
    pub seed: u64,
    pub geometry: GeometryFile,
    pub camera: CameraFile,
    #[serde(default)]
    pub image: ImageFile,
    #[serde(default)]
    pub occlusion: OcclusionFile,
    #[serde(default)]
    pub technique: TechniqueParameters,
    pub environment: Option<EnvironmentFile>,
    pub lighting: BTreeMap<String, LightingFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraFile {
    pub position_m: Point,
    pub target_m: Spanned<Point>,
    pub vertical_fov_deg: FieldOfView,
    pub near_m: PositiveMetres,
    pub far_m: Spanned<PositiveMetres>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ImageFile {
    pub supersampling: Supersampling,
}

impl Default for ImageFile {
    fn default() -> Self {
        Self {
            supersampling: Supersampling(2),
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct OcclusionFile {
    pub blur_radius_px: BlurRadius,
    pub blur_plane_m: PositiveMetres,
    pub baked: bool,
}

impl Default for OcclusionFile {
    fn default() -> Self {
        Self {
            blur_radius_px: BlurRadius(4),
            blur_plane_m: PositiveMetres(0.05),
            baked: false,
        }
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnvironmentFile {
    pub right: Colour,
    pub left: Colour,
    pub up: Colour,
    pub down: Colour,
    pub front: Colour,
    pub back: Colour,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightingFile {
    pub extends: Option<Spanned<String>>,
    pub ambient: Option<Spanned<AmbientFile>>,
    pub background: Option<Spanned<BackgroundFile>>,
    pub reflections: Option<Spanned<bool>>,
    pub sun: Option<SunFile>,
    pub model_lights: Option<LightFactor>,
    pub exposure_ev: Option<Stops>,
    pub tone_map: Option<ToneMapFile>,
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

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SunFile {
    pub towards: Spanned<[Coordinate; 3]>,
    pub irradiance: Colour,
    #[serde(default = "yes")]
    pub casts_shadows: bool,
}

fn yes() -> bool {
    true
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

quantity::quantity! {
    /// A luminance above nothing.
    PositiveLight: f32, 0.01, 10_000.0, ""
}
