//! Scene configs: `stimuli/scenes/*.toml`.
//!
//! One file is one scene: geometry, camera, image, what occlusion techniques use
//! here, and its lighting variants. A variant may `extend` another, so that the
//! validity levels of one scene share what they share.

mod environment;
mod file;
mod geometry;
mod light_file;
mod lighting;

pub(crate) use self::light_file::{Stops, ToneMapFile};

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;
use toml::Spanned;

use self::file::{CameraFile, Coordinate, Point, SceneFile};
use super::lighting::Lighting;
use super::model::ModelError;
use super::{Camera, GeometrySource};
use crate::config::{self, ConfigError, ParameterValue};

/// A scene that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// Its config is wrong.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The model it is made of is.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// A scene config, validated.
#[derive(Debug, Clone)]
pub struct SceneConfig {
    /// The file's stem (`atrium`).
    pub id: String,
    /// The file it came from.
    pub path: PathBuf,
    /// The file's text, for errors about it and for its hash.
    pub text: String,
    /// For people.
    pub title: String,
    /// What makes the geometry.
    pub geometry: GeometrySource,
    /// The camera.
    pub camera: Camera,
    /// Shaded samples along one side of a pixel.
    pub supersampling: u32,
    /// What every occlusion technique shares in this scene.
    pub occlusion: OcclusionConfig,
    /// Lighting variants by name.
    pub lightings: BTreeMap<String, Lighting>,
}

/// How occlusion is blurred, and what single techniques use in this scene.
#[derive(Debug, Clone, PartialEq)]
pub struct OcclusionConfig {
    /// Half width of the edge-aware blur in occlusion pixels; 0 is no blur.
    pub blur_radius_px: u32,
    /// Distance from the centre's plane at which a blur tap has lost 63 % of its weight, metres.
    pub blur_plane_m: f32,
    /// Whether the occlusion that a model's author has baked into textures counts, on
    /// top of any other.
    pub baked: bool,
    /// The model of light between surfaces that every picture of the scene gets, by its name
    /// among [`crate::multi_bounce::MODELS`]; whoever knows the techniques checks it.
    pub inter_reflection: Option<Spanned<String>>,
    /// Parameters by technique: name, value and byte range in the file.
    pub techniques: TechniqueParameters,
}

/// `[technique.NAME]` tables: values by parameter, checked by whoever knows the techniques.
pub type TechniqueParameters = BTreeMap<String, BTreeMap<String, Spanned<ParameterValue>>>;

impl SceneConfig {
    /// Reads a scene config.
    ///
    /// # Errors
    /// [`SceneError`] naming file, line, field, what was found and what is allowed.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::parse(path, &config::read(path)?)
    }

    /// Parses a scene config; `path` names it in errors and gives its id.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(path: &Path, text: &str) -> Result<Self, SceneError> {
        let file: SceneFile = config::parse(path, text)?;
        let source = Source { path, text };
        let environment = file
            .environment
            .as_ref()
            .map(|environment| environment::environment(environment, source))
            .transpose()?;
        let resolve = |name| lighting::resolve(&file, name, environment.as_ref(), source);
        let lightings = file
            .lighting
            .keys()
            .map(|name| Ok((name.clone(), resolve(name)?)))
            .collect::<Result<_, ConfigError>>()?;
        Ok(Self {
            id: path.file_stem().map_or_else(
                || String::from("scene"),
                |stem| stem.to_string_lossy().into_owned(),
            ),
            path: path.to_owned(),
            text: text.to_owned(),
            title: file.title,
            geometry: geometry::resolve(file.geometry, file.seed, source)?,
            camera: camera(&file.camera, source)?,
            supersampling: file.image.supersampling.get(),
            occlusion: OcclusionConfig {
                blur_radius_px: file.occlusion.blur_radius_px.get(),
                blur_plane_m: file.occlusion.blur_plane_m.get(),
                baked: file.occlusion.baked,
                inter_reflection: file.occlusion.inter_reflection,
                techniques: file.technique,
            },
            lightings,
        })
    }

    /// SHA-256 of the environment map that a variant reads from a file, if one does.
    #[must_use]
    pub fn environment_sha256(&self) -> Option<&str> {
        self.lightings
            .values()
            .find_map(|lighting| lighting.environment.as_ref()?.file_sha256())
    }

    /// The lighting variant of that name.
    ///
    /// # Errors
    /// Which variants there are.
    pub fn lighting(&self, name: &str) -> Result<&Lighting, String> {
        self.lightings.get(name).ok_or_else(|| {
            let known: Vec<&str> = self.lightings.keys().map(String::as_str).collect();
            format!(
                "found \"{name}\", the lighting variants of {} are: {}",
                self.path.display(),
                known.join(", ")
            )
        })
    }
}

/// The file an error is about.
#[derive(Clone, Copy)]
struct Source<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Source<'_> {
    fn error(self, span: std::ops::Range<usize>, field: &str, message: &str) -> ConfigError {
        ConfigError::at(self.path, self.text, Some(span), field, message)
    }
}

fn camera(file: &CameraFile, source: Source<'_>) -> Result<Camera, ConfigError> {
    let position_m = point(&file.position_m);
    let target_m = point(file.target_m.get_ref());
    if position_m.distance(target_m) < 1e-4 {
        let message = "the camera looks at its own position; move the target";
        return Err(source.error(file.target_m.span(), "camera.target_m", message));
    }
    let (near_m, far_m) = (file.near_m.get(), file.far_m.get_ref().get());
    if far_m <= near_m {
        let message = format!("found {far_m} m, must be more than near_m = {near_m} m");
        return Err(source.error(file.far_m.span(), "camera.far_m", &message));
    }
    Ok(Camera {
        position_m,
        target_m,
        vertical_fov_rad: file.vertical_fov_deg.get().to_radians(),
        near_m,
        far_m,
    })
}

fn point(components: &Point) -> Vec3 {
    Vec3::from(components.map(Coordinate::get))
}

#[cfg(test)]
mod tests;
