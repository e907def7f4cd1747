//! Stimulus sets: `stimuli/*.toml`, each a list of conditions, each two images of one scene
//! that differ in the occlusion technique alone. The images are rendered from a scene config,
//! or were made elsewhere and are named by their files.

mod file;
mod resolve;

use std::path::{Path, PathBuf};

use self::file::SetFile;
use self::resolve::Loader;
use super::loaded::LoadedImage;
use super::manifest::PassRecord;
use crate::config::{self, ConfigError};
use crate::digest;
use crate::render::plan::{FramePlan, GeometryFacts};
use crate::render::technique::Settings;
use crate::render::{FrameRequest, Precision};
use crate::scene::{SceneConfig, SceneError};

/// A stimulus set, with the scenes it uses.
#[derive(Debug, Clone)]
pub struct StimulusSet {
    /// Id (`thesis-2010`).
    pub id: String,
    /// The file it came from.
    pub path: PathBuf,
    /// For people.
    pub title: String,
    /// Seed of kernels and noise; 0 where nothing is rendered.
    pub seed: u64,
    /// Size of every image, pixels; `None` where nothing is rendered and nothing was said: then
    /// only the two images of a condition must be of one size.
    pub size_px: Option<(u32, u32)>,
    /// How finely buffers are stored.
    pub precision: Precision,
    /// Whether every effect runs, called for or not.
    pub all_effects: bool,
    /// The scenes, each once.
    pub scenes: Vec<SceneConfig>,
    /// The conditions, in the file's order.
    pub conditions: Vec<SetCondition>,
    /// SHA-256 of this file's text, of the scenes' texts, in order, and of the files of
    /// their models and environment maps.
    pub sha256: String,
}

/// One condition of a set.
#[derive(Debug, Clone)]
pub struct SetCondition {
    /// Id, as in trial rows.
    pub id: String,
    /// `low`, `moderate`, `high`, or what the study calls its levels.
    pub validity: String,
    /// What it asks.
    pub hypothesis: String,
    /// Where its two images come from.
    pub images: ImageSource,
}

/// Where the two images of a condition come from.
#[derive(Debug, Clone)]
pub enum ImageSource {
    /// They are rendered from a scene of the set.
    Rendered(RenderedPair),
    /// They were made elsewhere.
    Loaded(Box<LoadedPair>),
}

/// Two images to render.
#[derive(Debug, Clone)]
pub struct RenderedPair {
    /// Index into [`StimulusSet::scenes`].
    pub scene: usize,
    /// Name of the scene's lighting variant.
    pub lighting: String,
    /// Technique of the image that comes first in the base order.
    pub first: Settings,
    /// Technique of the other.
    pub second: Settings,
}

/// Two images made elsewhere.
#[derive(Debug, Clone)]
pub struct LoadedPair {
    /// What trial rows call the scene.
    pub scene: String,
    /// The image that comes first in the base order.
    pub first: LoadedImage,
    /// The other.
    pub second: LoadedImage,
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

impl StimulusSet {
    /// Reads a set and the scenes it names; images made elsewhere are not opened (paths are relative to the set's file).
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
        resolve::check_id(file.id.get_ref())
            .map_err(|message| error(file.id.span(), "id", &message))?;
        if file.condition.is_empty() {
            return Err(
                ConfigError::whole_file(path, "a set needs at least one [[condition]]").into(),
            );
        }
        let mut loader = Loader::new(path, text);
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
        let sha256 = sha256(text, &loader.scenes)?;
        let renders = !loader.scenes.is_empty();
        let missing = |key: &str| {
            let message = format!("missing field `{key}`, which a set that renders images needs");
            ConfigError::at(path, text, None, key, &message)
        };
        if renders && file.seed.is_none() {
            return Err(missing("seed").into());
        }
        let size_px = match (file.width_px, file.height_px) {
            (Some(width), Some(height)) => Some((width.get(), height.get())),
            (None, None) if !renders => None,
            (None, _) => return Err(missing("width_px").into()),
            (_, None) => return Err(missing("height_px").into()),
        };
        Ok(Self {
            id: file.id.into_inner(),
            path: path.to_owned(),
            title: file.title,
            seed: file.seed.unwrap_or(0),
            size_px,
            precision: file.precision,
            all_effects: false,
            sha256,
            scenes: loader.scenes,
            conditions,
        })
    }

    /// The conditions that are rendered.
    pub fn rendered(&self) -> impl Iterator<Item = (&SetCondition, &RenderedPair)> {
        self.conditions.iter().filter_map(|c| match &c.images {
            ImageSource::Rendered(pair) => Some((c, pair)),
            ImageSource::Loaded(_) => None,
        })
    }

    /// What to draw for one image of a rendered condition.
    ///
    /// # Panics
    /// Never for conditions of this set: their scene and lighting were checked when it was read.
    #[must_use]
    pub fn request(&self, pair: &RenderedPair, technique: &Settings) -> FrameRequest {
        let scene = &self.scenes[pair.scene];
        let lighting = &scene.lightings[&pair.lighting];
        // A set that renders says its size; the renderer refuses images without pixels.
        let size_px = self.size_px.unwrap_or_default();
        let mut request = FrameRequest::new(scene, lighting, technique.clone(), size_px, self.seed);
        request.precision = self.precision;
        request.all_effects = self.all_effects;
        request
    }
}

impl StimulusSet {
    /// The plan of one image; `ran` is what ran when it was drawn, and may be empty.
    #[must_use]
    pub fn plan(
        &self,
        pair: &RenderedPair,
        technique: &Settings,
        facts: &GeometryFacts,
        ran: &[PassRecord],
    ) -> FramePlan {
        let facts = GeometryFacts {
            // Whether surfaces cover every pixel is known of a frame that was drawn.
            uncovered: (!ran.is_empty()).then(|| ran.iter().any(|pass| pass.pass == "skybox")),
            ..facts.clone()
        };
        FramePlan::new(&self.request(pair, technique), &facts)
    }

    /// Where the images lie unless somebody says otherwise: a folder beside the config, named
    /// like the set.
    #[must_use]
    pub fn default_folder(&self) -> PathBuf {
        self.path.with_file_name(&self.id)
    }
}

/// Of everything that makes the images but the program.
fn sha256(text: &str, scenes: &[SceneConfig]) -> Result<String, SceneError> {
    let mut parts = vec![text.to_owned()];
    parts.extend(scenes.iter().map(|scene| scene.text.clone()));
    for scene in scenes {
        parts.extend(scene.geometry.sha256()?);
        parts.extend(scene.environment_sha256().map(str::to_owned));
    }
    Ok(digest::sha256_hex(parts.join("\0").as_bytes()))
}

impl SetCondition {
    /// What trial rows call the two images, in the base order.
    #[must_use]
    pub fn labels(&self) -> [&str; 2] {
        match &self.images {
            ImageSource::Rendered(pair) => [&pair.first.label, &pair.second.label],
            ImageSource::Loaded(pair) => [&pair.first.label, &pair.second.label],
        }
    }

    /// What trial rows call the scene.
    #[must_use]
    pub fn scene_id<'a>(&'a self, set: &'a StimulusSet) -> &'a str {
        match &self.images {
            ImageSource::Rendered(pair) => &set.scenes[pair.scene].id,
            ImageSource::Loaded(pair) => &pair.scene,
        }
    }
}

#[cfg(test)]
mod tests;
