//! From what is written to what is meant: scenes read, techniques resolved, files found.

use std::path::{Path, PathBuf};

use toml::Spanned;

use super::file::{ConditionFile, ImageFile, LoadedFile, TechniqueFile};
use super::{ImageSource, LoadedPair, RenderedPair, SetCondition, SetError};
use crate::config::{ConfigError, ParameterValue};
use crate::render::technique::{Settings, SettingsError};
use crate::scene::SceneConfig;
use crate::scene::ToneMap;
use crate::scene::config::Stops;
use crate::stimulus::loaded::LoadedImage;

/// Reads the conditions of one set.
pub(super) struct Loader<'a> {
    path: &'a Path,
    text: &'a str,
    pub scenes: Vec<SceneConfig>,
}

impl<'a> Loader<'a> {
    pub fn new(path: &'a Path, text: &'a str) -> Self {
        Self {
            path,
            text,
            scenes: Vec::new(),
        }
    }

    fn error(&self, span: std::ops::Range<usize>, field: &str, message: &str) -> ConfigError {
        ConfigError::at(self.path, self.text, Some(span), field, message)
    }

    pub fn condition(
        &mut self,
        file: &ConditionFile,
        field: &str,
    ) -> Result<SetCondition, SetError> {
        check_id(file.id.get_ref())
            .map_err(|message| self.error(file.id.span(), &format!("{field}.id"), &message))?;
        let images = match (file.first.get_ref(), file.second.get_ref()) {
            (ImageFile::Rendered(first), ImageFile::Rendered(second)) => {
                ImageSource::Rendered(self.rendered(file, first, second, field)?)
            }
            (ImageFile::Loaded(first), ImageFile::Loaded(second)) => {
                ImageSource::Loaded(Box::new(self.loaded(file, first, second, field)?))
            }
            _ => {
                let message = "one image is rendered and the other made elsewhere, so they differ in more than the occlusion; \
                               render both here or name a file for both";
                return Err(self
                    .error(file.second.span(), &format!("{field}.second"), message)
                    .into());
            }
        };
        let validity = match (&file.validity, &file.lighting) {
            (Some(validity), _) => validity.clone(),
            (None, Some(lighting)) => lighting.get_ref().clone(),
            (None, None) => {
                let message = "missing; say the level of ecological validity, such as \"low\", \"moderate\" or \"high\"";
                return Err(self
                    .error(file.id.span(), &format!("{field}.validity"), message)
                    .into());
            }
        };
        let condition = SetCondition {
            id: file.id.get_ref().clone(),
            validity,
            hypothesis: file.hypothesis.clone(),
            images,
        };
        let [first, second] = condition.labels();
        if first == second {
            let message = format!(
                "both images are \"{first}\"; give one of them a `label` of its own or another technique"
            );
            return Err(self
                .error(file.second.span(), &format!("{field}.second"), &message)
                .into());
        }
        Ok(condition)
    }

    fn rendered(
        &mut self,
        file: &ConditionFile,
        first: &TechniqueFile,
        second: &TechniqueFile,
        field: &str,
    ) -> Result<RenderedPair, SetError> {
        let scene = self.scene(&file.scene, field)?;
        let Some(lighting) = &file.lighting else {
            let known: Vec<&str> = self.scenes[scene]
                .lightings
                .keys()
                .map(String::as_str)
                .collect();
            let message = format!("missing; the scene has: {}", known.join(", "));
            return Err(self
                .error(file.id.span(), &format!("{field}.lighting"), &message)
                .into());
        };
        self.scenes[scene]
            .lighting(lighting.get_ref())
            .map_err(|message| {
                self.error(lighting.span(), &format!("{field}.lighting"), &message)
            })?;
        let technique = |table: &Spanned<ImageFile>, technique: &TechniqueFile, which: &str| {
            self.technique(scene, table.span(), technique, &format!("{field}.{which}"))
        };
        Ok(RenderedPair {
            scene,
            lighting: lighting.get_ref().clone(),
            first: technique(&file.first, first, "first")?,
            second: technique(&file.second, second, "second")?,
        })
    }

    fn loaded(
        &self,
        file: &ConditionFile,
        first: &LoadedFile,
        second: &LoadedFile,
        field: &str,
    ) -> Result<LoadedPair, ConfigError> {
        check_id(file.scene.get_ref()).map_err(|message| {
            let message = format!("the scene of images made elsewhere is a name: {message}");
            self.error(file.scene.span(), &format!("{field}.scene"), &message)
        })?;
        if let Some(lighting) = &file.lighting {
            let message = "images made elsewhere are lit already; say their level with `validity`";
            return Err(self.error(lighting.span(), &format!("{field}.lighting"), message));
        }
        let image = |table: &Spanned<ImageFile>, image: &LoadedFile, which: &str| {
            self.image(table.span(), image, &format!("{field}.{which}"))
        };
        Ok(LoadedPair {
            scene: file.scene.get_ref().clone(),
            first: image(&file.first, first, "first")?,
            second: image(&file.second, second, "second")?,
        })
    }

    fn image(
        &self,
        span: std::ops::Range<usize>,
        image: &LoadedFile,
        field: &str,
    ) -> Result<LoadedImage, ConfigError> {
        check_id(&image.technique)
            .map_err(|message| self.error(span, &format!("{field}.technique"), &message))?;
        let path = self.beside(image.file.get_ref());
        if !path.is_file() {
            let message = format!("there is no file {}", path.display());
            return Err(self.error(image.file.span(), &format!("{field}.file"), &message));
        }
        Ok(LoadedImage {
            label: image.technique.clone(),
            file: image.file.get_ref().clone(),
            path,
            colour_space: image.colour_space,
            exposure_ev: image.exposure_ev.map(Stops::get),
            tone_map: image.tone_map.map(ToneMap::from),
            metadata: image.metadata.clone(),
        })
    }

    /// A path in the file, which is relative to it.
    fn beside(&self, path: &Path) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    fn scene(&mut self, file: &Spanned<String>, field: &str) -> Result<usize, SetError> {
        let path = self.beside(Path::new(file.get_ref()));
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
        span: std::ops::Range<usize>,
        choice: &TechniqueFile,
        field: &str,
    ) -> Result<Settings, ConfigError> {
        let scene = &self.scenes[scene];
        let mut settings = Settings::from_label(&choice.technique)
            .map_err(|error| self.error(span.clone(), field, &error.message))?;
        let name = settings.technique.name;
        if let Some(model) = &scene.occlusion.inter_reflection {
            settings
                .take_inter_reflection(model.get_ref())
                .map_err(|error| {
                    let field = "occlusion.inter_reflection";
                    let (path, text) = (&scene.path, &scene.text);
                    ConfigError::at(path, text, Some(model.span()), field, &error.message)
                })?;
        }
        for (parameter, value) in scene.occlusion.techniques.get(name).into_iter().flatten() {
            settings
                .set_scene_default(parameter, value.get_ref().clone())
                .map_err(|error| scene_error(scene, name, parameter, value, &error))?;
        }
        for (parameter, value) in &choice.parameters {
            settings
                .set(parameter, value.get_ref().clone())
                .map_err(|error| {
                    self.error(
                        value.span(),
                        &format!("{field}.{parameter}"),
                        &error.message,
                    )
                })?;
        }
        if let Some(label) = &choice.label {
            check_id(label).map_err(|message| self.error(span, field, &message))?;
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
                .set(parameter, value.get_ref().clone())
                .map_err(|error| scene_error(scene, name, parameter, value, &error))?;
        }
    }
    Ok(())
}

fn scene_error(
    scene: &SceneConfig,
    technique: &str,
    parameter: &str,
    value: &Spanned<ParameterValue>,
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
pub(super) fn check_id(id: &str) -> Result<(), String> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if !id.is_empty() && id.len() <= 64 && id.chars().all(allowed) && !id.starts_with('.') {
        return Ok(());
    }
    Err(format!(
        "found \"{id}\"; allowed are 1 to 64 letters, digits, '-', '_' and '.', not starting with '.'"
    ))
}
