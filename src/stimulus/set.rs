//! Stimulus sets: `stimuli/*.toml`, each a list of conditions, each two images of one scene
//! that differ in the occlusion technique alone.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::{MapAccess, Visitor};
use toml::Spanned;

use crate::config::{self, ConfigError, quantity};
use crate::digest;
use crate::render::technique::{Settings, SettingsError};
use crate::render::{FrameRequest, Precision};
use crate::scene::{SceneConfig, SceneError};

quantity::quantity! {
    /// Width or height of an image.
    Pixels: u32, 1, 8192, "px"
}

/// A stimulus set, with the scenes it uses.
#[derive(Debug, Clone)]
pub struct StimulusSet {
    /// Id (`thesis-2010`).
    pub id: String,
    /// The file it came from.
    pub path: PathBuf,
    /// For people.
    pub title: String,
    /// Seed of kernels and noise.
    pub seed: u64,
    /// Size of every image, pixels.
    pub size_px: (u32, u32),
    /// How finely buffers are stored.
    pub precision: Precision,
    /// Whether every effect runs, called for or not.
    pub all_effects: bool,
    /// The scenes, each once.
    pub scenes: Vec<SceneConfig>,
    /// The conditions, in the file's order.
    pub conditions: Vec<SetCondition>,
    /// SHA-256 of this file's text and of the scenes' texts, in order.
    pub sha256: String,
}

/// One condition of a set.
#[derive(Debug, Clone)]
pub struct SetCondition {
    /// Id, as in trial rows.
    pub id: String,
    /// Index into [`StimulusSet::scenes`].
    pub scene: usize,
    /// Name of the scene's lighting variant.
    pub lighting: String,
    /// `low`, `moderate`, `high`, or what the study calls its levels.
    pub validity: String,
    /// What it asks.
    pub hypothesis: String,
    /// Technique of the image that comes first in the base order.
    pub first: Settings,
    /// Technique of the other.
    pub second: Settings,
}

/// A set that cannot be used: its own config is wrong, or a scene's.
#[derive(Debug, thiserror::Error)]
pub enum SetError {
    /// The set's config.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A scene's.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SetFile {
    id: Spanned<String>,
    title: String,
    seed: u64,
    width_px: Pixels,
    height_px: Pixels,
    #[serde(default)]
    precision: Precision,
    condition: Vec<ConditionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ConditionFile {
    id: Spanned<String>,
    scene: Spanned<PathBuf>,
    lighting: Spanned<String>,
    validity: Option<String>,
    #[serde(default)]
    hypothesis: String,
    first: Spanned<TechniqueFile>,
    second: Spanned<TechniqueFile>,
}

/// `"blizzard24"`, or `{ technique = "blizzard24", label = "blizzard24-wide", radius_m = 2 }`.
#[derive(Debug)]
struct TechniqueFile {
    technique: String,
    label: Option<String>,
    parameters: BTreeMap<String, Spanned<f64>>,
}

impl<'de> Deserialize<'de> for TechniqueFile {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TechniqueVisitor;
        impl<'de> Visitor<'de> for TechniqueVisitor {
            type Value = TechniqueFile;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a technique such as \"blizzard24\", or a table with `technique` and parameters")
            }

            fn visit_str<E>(self, label: &str) -> Result<TechniqueFile, E> {
                Ok(TechniqueFile {
                    technique: label.to_owned(),
                    label: None,
                    parameters: BTreeMap::new(),
                })
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<TechniqueFile, A::Error> {
                let (mut technique, mut label, mut parameters) = (None, None, BTreeMap::new());
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "technique" => technique = Some(map.next_value()?),
                        "label" => label = Some(map.next_value()?),
                        _ => {
                            parameters.insert(key, map.next_value()?);
                        }
                    }
                }
                let technique =
                    technique.ok_or_else(|| serde::de::Error::missing_field("technique"))?;
                Ok(TechniqueFile {
                    technique,
                    label,
                    parameters,
                })
            }
        }
        deserializer.deserialize_any(TechniqueVisitor)
    }
}

impl StimulusSet {
    /// Reads a set and the scenes it names (paths are relative to the set's file).
    ///
    /// # Errors
    /// [`SetError`] naming file, line, field, what was found and what is allowed.
    pub fn load(path: &Path) -> Result<Self, SetError> {
        Self::parse(path, &config::read(path)?)
    }

    /// As [`load`](Self::load), from text.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(path: &Path, text: &str) -> Result<Self, SetError> {
        let file: SetFile = config::parse(path, text)?;
        let error = |span: std::ops::Range<usize>, field: &str, message: &str| {
            ConfigError::at(path, text, Some(span), field, message)
        };
        check_id(file.id.get_ref()).map_err(|message| error(file.id.span(), "id", &message))?;
        if file.condition.is_empty() {
            return Err(
                ConfigError::whole_file(path, "a set needs at least one [[condition]]").into(),
            );
        }
        let mut loader = Loader {
            path,
            text,
            scenes: Vec::new(),
        };
        let mut conditions: Vec<SetCondition> = Vec::new();
        for (index, condition) in file.condition.iter().enumerate() {
            let field = format!("condition[{index}]");
            let resolved = loader.condition(condition, &field)?;
            if conditions.iter().any(|earlier| earlier.id == resolved.id) {
                let message = format!("there is already a condition \"{}\"", resolved.id);
                return Err(error(condition.id.span(), &format!("{field}.id"), &message).into());
            }
            conditions.push(resolved);
        }
        let texts: Vec<&str> = std::iter::once(text)
            .chain(loader.scenes.iter().map(|s| s.text.as_str()))
            .collect();
        Ok(Self {
            id: file.id.into_inner(),
            path: path.to_owned(),
            title: file.title,
            seed: file.seed,
            size_px: (file.width_px.get(), file.height_px.get()),
            precision: file.precision,
            all_effects: false,
            sha256: digest::sha256_hex(texts.join("\0").as_bytes()),
            scenes: loader.scenes,
            conditions,
        })
    }

    /// What to draw for one image of a condition.
    ///
    /// # Panics
    /// Never for conditions of this set: their scene and lighting were checked when it was read.
    #[must_use]
    pub fn request(&self, condition: &SetCondition, technique: &Settings) -> FrameRequest {
        let scene = &self.scenes[condition.scene];
        let lighting = &scene.lightings[&condition.lighting];
        let mut request =
            FrameRequest::new(scene, lighting, technique.clone(), self.size_px, self.seed);
        request.precision = self.precision;
        request.all_effects = self.all_effects;
        request
    }
}

struct Loader<'a> {
    path: &'a Path,
    text: &'a str,
    scenes: Vec<SceneConfig>,
}

impl Loader<'_> {
    fn error(&self, span: std::ops::Range<usize>, field: &str, message: &str) -> ConfigError {
        ConfigError::at(self.path, self.text, Some(span), field, message)
    }

    fn condition(&mut self, file: &ConditionFile, field: &str) -> Result<SetCondition, SetError> {
        check_id(file.id.get_ref())
            .map_err(|message| self.error(file.id.span(), &format!("{field}.id"), &message))?;
        let scene = self.scene(&file.scene, field)?;
        let lighting = file.lighting.get_ref();
        self.scenes[scene].lighting(lighting).map_err(|message| {
            self.error(file.lighting.span(), &format!("{field}.lighting"), &message)
        })?;
        let first = self.technique(scene, &file.first, &format!("{field}.first"))?;
        let second = self.technique(scene, &file.second, &format!("{field}.second"))?;
        if first.label == second.label {
            let message = format!(
                "both images are \"{}\"; give one of them a `label` of its own or another technique",
                first.label
            );
            return Err(self
                .error(file.second.span(), &format!("{field}.second"), &message)
                .into());
        }
        Ok(SetCondition {
            id: file.id.get_ref().clone(),
            scene,
            lighting: lighting.clone(),
            validity: file.validity.clone().unwrap_or_else(|| lighting.clone()),
            hypothesis: file.hypothesis.clone(),
            first,
            second,
        })
    }

    fn scene(&mut self, file: &Spanned<PathBuf>, field: &str) -> Result<usize, SetError> {
        let path = self
            .path
            .parent()
            .unwrap_or(Path::new(""))
            .join(file.get_ref());
        if let Some(known) = self.scenes.iter().position(|scene| scene.path == path) {
            return Ok(known);
        }
        if !path.is_file() {
            let message = format!("there is no scene config {}", path.display());
            return Err(self
                .error(file.span(), &format!("{field}.scene"), &message)
                .into());
        }
        let scene = SceneConfig::load(&path)?;
        check_techniques(&scene)?;
        self.scenes.push(scene);
        Ok(self.scenes.len() - 1)
    }

    fn technique(
        &self,
        scene: usize,
        file: &Spanned<TechniqueFile>,
        field: &str,
    ) -> Result<Settings, ConfigError> {
        let choice = file.get_ref();
        let scene = &self.scenes[scene];
        let mut settings = Settings::from_label(&choice.technique)
            .map_err(|error| self.error(file.span(), field, &error.message))?;
        let name = settings.technique.name;
        for (parameter, value) in scene.occlusion.techniques.get(name).into_iter().flatten() {
            settings
                .set_scene_default(parameter, *value.get_ref())
                .map_err(|error| scene_error(scene, name, parameter, value, &error))?;
        }
        for (parameter, value) in &choice.parameters {
            settings.set(parameter, *value.get_ref()).map_err(|error| {
                self.error(
                    value.span(),
                    &format!("{field}.{parameter}"),
                    &error.message,
                )
            })?;
        }
        if let Some(label) = &choice.label {
            check_id(label).map_err(|message| self.error(file.span(), field, &message))?;
            settings.label.clone_from(label);
        }
        Ok(settings)
    }
}

/// Every `[technique.NAME]` table of a scene, whether the set uses it or not.
fn check_techniques(scene: &SceneConfig) -> Result<(), ConfigError> {
    for (name, parameters) in &scene.occlusion.techniques {
        let mut settings = Settings::from_label(name).map_err(|error| {
            ConfigError::at(
                &scene.path,
                &scene.text,
                None,
                &format!("technique.{name}"),
                &error.message,
            )
        })?;
        for (parameter, value) in parameters {
            settings
                .set(parameter, *value.get_ref())
                .map_err(|error| scene_error(scene, name, parameter, value, &error))?;
        }
    }
    Ok(())
}

fn scene_error(
    scene: &SceneConfig,
    technique: &str,
    parameter: &str,
    value: &Spanned<f64>,
    error: &SettingsError,
) -> ConfigError {
    let field = format!("technique.{technique}.{parameter}");
    ConfigError::at(
        &scene.path,
        &scene.text,
        Some(value.span()),
        &field,
        &error.message,
    )
}

/// Ids become file names and columns of tables.
fn check_id(id: &str) -> Result<(), String> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if !id.is_empty() && id.len() <= 64 && id.chars().all(allowed) && !id.starts_with('.') {
        return Ok(());
    }
    Err(format!(
        "found \"{id}\"; allowed are 1 to 64 letters, digits, '-', '_' and '.', not starting with '.'"
    ))
}

#[cfg(test)]
mod tests;
