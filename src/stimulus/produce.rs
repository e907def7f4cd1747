//! Drawing a stimulus set: images first, the manifest last.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::files;
use super::manifest::{self, ImageRecord, Manifest, PairRecord, StimulusError};
use super::set::{SetCondition, StimulusSet};
use crate::digest;
use crate::render::technique::Settings;
use crate::render::{RenderError, Renderer, View};
use crate::scene::SceneError;

/// A set that could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum ProduceError {
    /// The frame.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The files.
    #[error(transparent)]
    Stimulus(#[from] StimulusError),
    /// No such condition.
    #[error("the set has no condition \"{wanted}\"; it has: {known}")]
    NoSuchCondition {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
}

/// Draws `set`, or only the condition `only`, into `folder`, and writes its manifest.
///
/// `progress` is called with what is about to be drawn. An image that two conditions share
/// is drawn once and written for both.
///
/// # Errors
/// [`ProduceError`]; the manifest is written last, so a folder that has one is whole.
pub fn produce(
    renderer: &Renderer,
    set: &StimulusSet,
    folder: &Path,
    only: Option<&str>,
    progress: &mut dyn FnMut(&str),
) -> Result<Manifest, ProduceError> {
    let chosen: Vec<&SetCondition> = set
        .conditions
        .iter()
        .filter(|c| only.is_none_or(|only| c.id == only))
        .collect();
    if chosen.is_empty() {
        let known: Vec<&str> = set.conditions.iter().map(|c| c.id.as_str()).collect();
        return Err(ProduceError::NoSuchCondition {
            wanted: only.unwrap_or_default().to_owned(),
            known: known.join(", "),
        });
    }
    std::fs::create_dir_all(folder).map_err(|source| StimulusError::Unwritable {
        path: folder.to_owned(),
        source,
    })?;
    let mut pairs = BTreeMap::new();
    for (index, scene) in set.scenes.iter().enumerate() {
        let conditions: Vec<_> = chosen.iter().filter(|c| c.scene == index).collect();
        if conditions.is_empty() {
            continue;
        }
        progress(&format!("scene {}", scene.id));
        let geometry = scene.geometry.load()?;
        let surfaces = renderer.upload(&geometry)?;
        drop(geometry);
        let mut producer = Producer {
            set,
            folder,
            view: renderer.view(&surfaces),
            drawn: BTreeMap::new(),
        };
        for condition in conditions {
            pairs.insert(condition.id.as_str(), producer.pair(condition, progress)?);
        }
    }
    let mut manifest = Manifest {
        schema_version: manifest::SCHEMA_VERSION,
        set_id: set.id.clone(),
        config_sha256: set.sha256.clone(),
        seed: set.seed,
        app_version: env!("CARGO_PKG_VERSION").to_owned(),
        adapter: Some(renderer.gpu().adapter.clone()),
        pairs: Vec::new(),
    };
    // A part drawn again joins what is there, if that was made the same way.
    let earlier = Manifest::load(folder).ok().filter(|earlier| {
        only.is_some()
            && Manifest {
                pairs: Vec::new(),
                ..earlier.clone()
            } == manifest
    });
    for condition in &set.conditions {
        let kept = || {
            earlier
                .as_ref()?
                .pairs
                .iter()
                .find(|pair| pair.condition == condition.id)
                .cloned()
        };
        manifest
            .pairs
            .extend(pairs.remove(condition.id.as_str()).or_else(kept));
    }
    let text =
        serde_json::to_string_pretty(&manifest).map_err(|error| StimulusError::Malformed {
            path: folder.join(manifest::FILE_NAME),
            message: error.to_string(),
        })?;
    files::write_whole(&folder.join(manifest::FILE_NAME), (text + "\n").as_bytes())?;
    Ok(manifest)
}

struct Producer<'a> {
    set: &'a StimulusSet,
    folder: &'a Path,
    view: View<'a>,
    /// Images by lighting and technique, as PNG bytes.
    drawn: BTreeMap<String, (Vec<u8>, ImageRecord)>,
}

impl Producer<'_> {
    fn pair(
        &mut self,
        condition: &SetCondition,
        progress: &mut dyn FnMut(&str),
    ) -> Result<PairRecord, ProduceError> {
        let scene = &self.set.scenes[condition.scene];
        Ok(PairRecord {
            condition: condition.id.clone(),
            scene: scene.id.clone(),
            validity: condition.validity.clone(),
            hypothesis: condition.hypothesis.clone(),
            first: self.image(condition, &condition.first, progress)?,
            second: self.image(condition, &condition.second, progress)?,
        })
    }

    fn image(
        &mut self,
        condition: &SetCondition,
        technique: &Settings,
        progress: &mut dyn FnMut(&str),
    ) -> Result<ImageRecord, ProduceError> {
        let file = PathBuf::from(format!("{}--{}.png", condition.id, technique.label));
        progress(&format!("{} {}", condition.id, technique.label));
        let path = self.folder.join(&file);
        let key = format!(
            "{} {} {:?}",
            condition.lighting,
            technique.technique.name,
            technique.values()
        );
        if !self.drawn.contains_key(&key) {
            let drawn = self.draw(condition, technique, &path)?;
            self.drawn.insert(key.clone(), drawn);
        }
        let (bytes, record) = &self.drawn[&key];
        files::write_whole(&path, bytes)?;
        Ok(ImageRecord {
            file,
            technique: technique.label.clone(),
            ..record.clone()
        })
    }

    fn draw(
        &mut self,
        condition: &SetCondition,
        technique: &Settings,
        path: &Path,
    ) -> Result<(Vec<u8>, ImageRecord), ProduceError> {
        let frame = self.view.render(&self.set.request(condition, technique))?;
        let bytes = files::encode_png(path, &frame.picture)?;
        let record = ImageRecord {
            file: PathBuf::new(),
            sha256: digest::sha256_hex(&bytes),
            width_px: frame.picture.width_px,
            height_px: frame.picture.height_px,
            technique: technique.label.clone(),
            parameters: technique.values(),
            passes: frame.passes,
        };
        Ok((bytes, record))
    }
}
