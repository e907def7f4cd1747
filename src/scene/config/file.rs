//! A scene config as it is written: the tables and their keys, each value in its range.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::TechniqueParameters;
use super::geometry::GeometryFile;
use super::light_file::{EnvironmentFile, LightingFile};
use crate::config::quantity;

quantity::quantity! {
    /// A vertical field of view.
    FieldOfView: f32, 5.0, 150.0, "degrees"
}
quantity::quantity! {
    /// One coordinate of a point.
    Coordinate: f32, -100_000.0, 100_000.0, "m"
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
    pub environment: Option<Spanned<EnvironmentFile>>,
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
    pub inter_reflection: Option<Spanned<String>>,
}

impl Default for OcclusionFile {
    fn default() -> Self {
        Self {
            blur_radius_px: BlurRadius(4),
            blur_plane_m: PositiveMetres(0.05),
            baked: false,
            inter_reflection: None,
        }
    }
}
