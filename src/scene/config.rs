//! Scene configs: `stimuli/scenes/*.toml`.
//!
//! One file is one scene: geometry, camera, image, what occlusion techniques use
//! here, and its lighting variants. A variant may `extend` another, so that the
//! validity levels of one scene share what they share.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde::Deserialize;
use toml::Spanned;

use super::lighting::{Ambient, Background, Lighting, Sun, ToneMap};
use super::procedural::{self, Generator};
use super::{Camera, Environment};
use crate::config::{self, ConfigError, quantity};

/// A scene that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// Its config is wrong.
    #[error(transparent)]
    Config(#[from] ConfigError),
}

quantity::quantity! {
    /// A vertical field of view.
    FieldOfView: f32, 5.0, 150.0, "degrees"
}
quantity::quantity! {
    /// One component of a linear radiance or irradiance.
    Light: f32, 0.0, 10_000.0, ""
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

type Colour = [Light; 3];
type Point = [Coordinate; 3];

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
    /// Seed of the geometry.
    pub seed: u64,
    /// What makes the geometry.
    pub generator: &'static Generator,
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
    /// Parameters by technique: name, value and byte range in the file.
    pub techniques: TechniqueParameters,
}

/// `[technique.NAME]` tables: numbers by parameter, checked by whoever knows the techniques.
pub type TechniqueParameters = BTreeMap<String, BTreeMap<String, Spanned<f64>>>;

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
        let lightings = file
            .lighting
            .keys()
            .map(|name| Ok((name.clone(), resolve_lighting(&file, name, source)?)))
            .collect::<Result<_, ConfigError>>()?;
        Ok(Self {
            id: path.file_stem().map_or_else(
                || String::from("scene"),
                |stem| stem.to_string_lossy().into_owned(),
            ),
            path: path.to_owned(),
            text: text.to_owned(),
            title: file.title,
            seed: file.seed,
            generator: find_generator(&file.geometry.generator, source)?,
            camera: camera(&file.camera, source)?,
            supersampling: file.image.supersampling.get(),
            occlusion: OcclusionConfig {
                blur_radius_px: file.occlusion.blur_radius_px.get(),
                blur_plane_m: file.occlusion.blur_plane_m.get(),
                techniques: file.technique,
            },
            lightings,
        })
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

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    title: String,
    #[serde(default)]
    seed: u64,
    geometry: GeometryFile,
    camera: CameraFile,
    #[serde(default)]
    image: ImageFile,
    #[serde(default)]
    occlusion: OcclusionFile,
    #[serde(default)]
    technique: TechniqueParameters,
    environment: Option<EnvironmentFile>,
    lighting: BTreeMap<String, LightingFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GeometryFile {
    generator: Spanned<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraFile {
    position_m: Point,
    target_m: Spanned<Point>,
    vertical_fov_deg: FieldOfView,
    near_m: PositiveMetres,
    far_m: Spanned<PositiveMetres>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct ImageFile {
    supersampling: Supersampling,
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
struct OcclusionFile {
    blur_radius_px: BlurRadius,
    blur_plane_m: PositiveMetres,
}

impl Default for OcclusionFile {
    fn default() -> Self {
        Self {
            blur_radius_px: BlurRadius(4),
            blur_plane_m: PositiveMetres(0.05),
        }
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct EnvironmentFile {
    right: Colour,
    left: Colour,
    up: Colour,
    down: Colour,
    front: Colour,
    back: Colour,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct LightingFile {
    extends: Option<Spanned<String>>,
    ambient: Option<Spanned<AmbientFile>>,
    background: Option<Spanned<BackgroundFile>>,
    sun: Option<SunFile>,
    exposure_ev: Option<Stops>,
    tone_map: Option<ToneMapFile>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum AmbientFile {
    Constant(Colour),
    Environment,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum BackgroundFile {
    Colour(Colour),
    Environment,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct SunFile {
    towards: Spanned<[Coordinate; 3]>,
    irradiance: Colour,
    #[serde(default = "yes")]
    casts_shadows: bool,
}

fn yes() -> bool {
    true
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum ToneMapFile {
    None,
    ReinhardExtended { white: PositiveLight },
    Aces,
}

quantity::quantity! {
    /// A luminance above nothing.
    PositiveLight: f32, 0.01, 10_000.0, ""
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

fn find_generator(
    name: &Spanned<String>,
    source: Source<'_>,
) -> Result<&'static Generator, ConfigError> {
    procedural::find(name.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = procedural::GENERATORS.iter().map(|g| g.name).collect();
        source.error(
            name.span(),
            "geometry.generator",
            &format!(
                "found \"{}\", allowed are: {}",
                name.get_ref(),
                known.join(", ")
            ),
        )
    })
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

/// A variant with everything it extends filled in.
fn resolve_lighting(
    file: &SceneFile,
    name: &str,
    source: Source<'_>,
) -> Result<Lighting, ConfigError> {
    let merged = merge_chain(file, name, source)?;
    let field = |key: &str| format!("lighting.{name}.{key}");
    let missing = |key: &str| {
        let message = "missing, here and in what this variant extends";
        ConfigError::at(source.path, source.text, None, &field(key), message)
    };
    let environment = file.environment.as_ref().map(environment);
    let needs_environment = |span: std::ops::Range<usize>, key: &str| match &environment {
        Some(_) => Ok(()),
        None => Err(source.error(
            span,
            &field(key),
            "asks for the environment, but the scene has no [environment]",
        )),
    };
    let ambient = merged.ambient.ok_or_else(|| missing("ambient"))?;
    let background = merged.background.ok_or_else(|| missing("background"))?;
    let ambient = match ambient.get_ref() {
        AmbientFile::Constant(radiance) => Ambient::Constant(colour(radiance)),
        AmbientFile::Environment => {
            needs_environment(ambient.span(), "ambient")?;
            Ambient::Environment
        }
    };
    let background = match background.get_ref() {
        BackgroundFile::Colour(radiance) => Background::Colour(colour(radiance)),
        BackgroundFile::Environment => {
            needs_environment(background.span(), "background")?;
            Background::Environment
        }
    };
    Ok(Lighting {
        sun: merged
            .sun
            .map(|file| sun(&file, &field("sun"), source))
            .transpose()?,
        environment: environment
            .filter(|_| ambient == Ambient::Environment || background == Background::Environment),
        ambient,
        background,
        exposure_ev: merged.exposure_ev.map_or(0.0, Stops::get),
        tone_map: match merged.tone_map {
            None | Some(ToneMapFile::None) => ToneMap::None,
            Some(ToneMapFile::Aces) => ToneMap::Aces,
            Some(ToneMapFile::ReinhardExtended { white }) => {
                ToneMap::ReinhardExtended { white: white.get() }
            }
        },
    })
}

fn merge_chain(
    file: &SceneFile,
    name: &str,
    source: Source<'_>,
) -> Result<LightingFile, ConfigError> {
    let mut merged = LightingFile::default();
    let mut visited = vec![name];
    let mut current = &file.lighting[name];
    loop {
        merged.ambient = merged.ambient.or_else(|| current.ambient.clone());
        merged.background = merged.background.or_else(|| current.background.clone());
        merged.sun = merged.sun.or_else(|| current.sun.clone());
        merged.exposure_ev = merged.exposure_ev.or(current.exposure_ev);
        merged.tone_map = merged.tone_map.or(current.tone_map);
        let Some(parent) = &current.extends else {
            return Ok(merged);
        };
        let field = format!("lighting.{}.extends", visited.last().unwrap_or(&name));
        if visited.contains(&parent.get_ref().as_str()) {
            let message = format!(
                "\"{}\" extends itself, directly or by others",
                parent.get_ref()
            );
            return Err(source.error(parent.span(), &field, &message));
        }
        current = file.lighting.get(parent.get_ref()).ok_or_else(|| {
            let message = format!("there is no lighting variant \"{}\"", parent.get_ref());
            source.error(parent.span(), &field, &message)
        })?;
        visited.push(parent.get_ref());
    }
}

fn sun(file: &SunFile, field: &str, source: Source<'_>) -> Result<Sun, ConfigError> {
    let towards = point(file.towards.get_ref());
    if towards.length() < 1e-6 {
        let message = "found a vector of length 0, a direction is needed";
        return Err(source.error(file.towards.span(), &format!("{field}.towards"), message));
    }
    Ok(Sun {
        towards: towards.normalize(),
        irradiance: colour(&file.irradiance),
        casts_shadows: file.casts_shadows,
    })
}

fn environment(file: &EnvironmentFile) -> Environment {
    Environment {
        axes: [
            &file.right,
            &file.left,
            &file.up,
            &file.down,
            &file.back,
            &file.front,
        ]
        .map(colour),
    }
}

fn colour(components: &Colour) -> Vec3 {
    Vec3::from(components.map(Light::get))
}

fn point(components: &Point) -> Vec3 {
    Vec3::from(components.map(Coordinate::get))
}

#[cfg(test)]
mod tests;
