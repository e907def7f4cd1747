//! Making a stimulus set: images first, the manifest last. Images are rendered here, or made
//! elsewhere and converted; a set without rendered ones needs no GPU.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::files;
use super::folders::Folders;
use super::loaded::LoadedImage;
use super::manifest::{self, AdapterRecord, ImageRecord, Manifest, PairRecord, StimulusError};
use super::pair_check;
use super::progress::Progress;
use super::set::{ImageSource, LoadedPair, RenderedPair, SetCondition, StimulusSet};
use super::truth::SceneTracer;
use crate::digest;
use crate::render::technique::Settings;
use crate::render::{RenderError, Renderer, View};
use crate::scene::SceneError;

/// A set that could not be made.
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
    /// An image made elsewhere that cannot be taken.
    #[error(transparent)]
    Source(StimulusError),
    /// Two images made elsewhere that do not belong together.
    #[error("condition \"{condition}\": {message}")]
    Pair {
        /// The condition's id.
        condition: String,
        /// What is wrong.
        message: String,
    },
    /// No such condition.
    #[error("the set has no condition \"{wanted}\"; it has: {known}")]
    NoSuchCondition {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
}

/// A set that was made.
#[derive(Debug, Clone)]
pub struct Produced {
    /// What was written.
    pub manifest: Manifest,
    /// What whoever made the set should look at.
    pub warnings: Vec<String>,
}

/// Makes `set`, or only the condition `only`, in `folders`, and writes its manifest.
///
/// `open` opens the renderer, and is called only if something is rendered. `progress` is told
/// what is about to be made. An image that two conditions share is drawn once and written
/// for both.
///
/// # Errors
/// [`ProduceError`]; the manifest is written last, so a folder that has one is whole.
pub fn produce(
    open: &dyn Fn() -> Result<Renderer, RenderError>,
    set: &StimulusSet,
    folders: Folders<'_>,
    only: Option<&str>,
    progress: &Progress<'_>,
) -> Result<Produced, ProduceError> {
    let chosen = choose(set, only)?;
    folders.create()?;
    let folder = folders.images;
    let mut made = Made::default();
    // First what needs no GPU and fails soonest.
    for condition in &chosen {
        if let ImageSource::Loaded(pair) = &condition.images {
            made.loaded_pair(set, folder, condition, pair, progress)?;
        }
    }
    if chosen
        .iter()
        .any(|c| matches!(c.images, ImageSource::Rendered(_)))
    {
        (progress.step)("opening the adapter");
        let renderer = open()?;
        made.adapter = Some(renderer.gpu().adapter.clone());
        for scene in 0..set.scenes.len() {
            made.scene(&renderer, set, folders, scene, &chosen, progress)?;
        }
    }
    for pair in made.pairs.values() {
        made.warnings.extend(pair_check::identical(pair));
    }
    let manifest = assemble(set, folder, only, made.adapter, made.pairs);
    write_manifest(&manifest, folder)?;
    Ok(Produced {
        manifest,
        warnings: made.warnings,
    })
}

/// The condition `only`, or all.
///
/// # Errors
/// [`ProduceError::NoSuchCondition`].
pub(super) fn choose<'a>(
    set: &'a StimulusSet,
    only: Option<&str>,
) -> Result<Vec<&'a SetCondition>, ProduceError> {
    let chosen: Vec<&SetCondition> = set
        .conditions
        .iter()
        .filter(|c| only.is_none_or(|only| c.id == only))
        .collect();
    if !chosen.is_empty() {
        return Ok(chosen);
    }
    let known: Vec<&str> = set.conditions.iter().map(|c| c.id.as_str()).collect();
    Err(ProduceError::NoSuchCondition {
        wanted: only.unwrap_or_default().to_owned(),
        known: known.join(", "),
    })
}

/// The manifest of what was made; with `only`, joined by what is there already, if that was
/// made the same way.
fn assemble(
    set: &StimulusSet,
    folder: &Path,
    only: Option<&str>,
    adapter: Option<AdapterRecord>,
    mut pairs: BTreeMap<String, PairRecord>,
) -> Manifest {
    let mut manifest = Manifest {
        schema_version: manifest::SCHEMA_VERSION,
        set_id: set.id.clone(),
        config_sha256: set.sha256.clone(),
        seed: set.seed,
        app_version: env!("CARGO_PKG_VERSION").to_owned(),
        adapter,
        pairs: Vec::new(),
    };
    let mut earlier = Vec::new();
    if only.is_some()
        && let Ok(found) = Manifest::load(folder)
    {
        // Converting images made elsewhere opens no adapter and says nothing against one.
        let adapter = manifest.adapter.clone().or(found.adapter.clone());
        let like = Manifest {
            adapter: found.adapter.clone().and(adapter.clone()),
            pairs: found.pairs.clone(),
            ..manifest.clone()
        };
        if like == found {
            manifest.adapter = adapter;
            earlier = found.pairs;
        }
    }
    for condition in &set.conditions {
        let kept = || earlier.iter().find(|pair| pair.condition == condition.id);
        let pair = pairs.remove(&condition.id).or_else(|| kept().cloned());
        manifest.pairs.extend(pair);
    }
    manifest
}

fn write_manifest(manifest: &Manifest, folder: &Path) -> Result<(), StimulusError> {
    let path = folder.join(manifest::FILE_NAME);
    let text =
        serde_json::to_string_pretty(manifest).map_err(|error| StimulusError::Malformed {
            path: path.clone(),
            message: error.to_string(),
        })?;
    files::write_whole(&path, (text + "\n").as_bytes())
}

/// What has been made so far.
#[derive(Default)]
struct Made {
    pairs: BTreeMap<String, PairRecord>,
    adapter: Option<AdapterRecord>,
    warnings: Vec<String>,
}

impl Made {
    fn loaded_pair(
        &mut self,
        set: &StimulusSet,
        folder: &Path,
        condition: &SetCondition,
        pair: &LoadedPair,
        progress: &Progress<'_>,
    ) -> Result<(), ProduceError> {
        let load = |image: &LoadedImage| {
            (progress.step)(&format!("{} {}", condition.id, image.label));
            image.load(set.size_px).map_err(ProduceError::Source)
        };
        let (first, second) = (load(&pair.first)?, load(&pair.second)?);
        let found = pair_check::compare(&first.picture, &second.picture).map_err(|message| {
            ProduceError::Pair {
                condition: condition.id.clone(),
                message,
            }
        })?;
        let named = |warning| format!("condition \"{}\": {warning}", condition.id);
        self.warnings.extend(found.into_iter().map(named));
        let mut write = |image: &LoadedImage, loaded: super::loaded::Loaded| {
            let file = file_name(condition, &image.label);
            let path = folder.join(&file);
            let bytes = files::encode_png(&path, &loaded.picture)?;
            files::write_whole(&path, &bytes)?;
            self.warnings.extend(loaded.warnings);
            Ok::<_, StimulusError>(ImageRecord {
                file,
                sha256: digest::sha256_hex(&bytes),
                width_px: loaded.picture.width_px,
                height_px: loaded.picture.height_px,
                technique: image.label.clone(),
                parameters: BTreeMap::new(),
                passes: Vec::new(),
                source: Some(loaded.source),
            })
        };
        let record = PairRecord {
            condition: condition.id.clone(),
            scene: pair.scene.clone(),
            validity: condition.validity.clone(),
            hypothesis: condition.hypothesis.clone(),
            first: write(&pair.first, first)?,
            second: write(&pair.second, second)?,
        };
        self.pairs.insert(condition.id.clone(), record);
        Ok(())
    }

    /// Renders what the chosen conditions show of one scene.
    fn scene(
        &mut self,
        renderer: &Renderer,
        set: &StimulusSet,
        folders: Folders<'_>,
        index: usize,
        chosen: &[&SetCondition],
        progress: &Progress<'_>,
    ) -> Result<(), ProduceError> {
        let conditions: Vec<(&SetCondition, &RenderedPair)> = chosen
            .iter()
            .filter_map(|condition| match &condition.images {
                ImageSource::Rendered(pair) if pair.scene == index => Some((*condition, pair)),
                _ => None,
            })
            .collect();
        if conditions.is_empty() {
            return Ok(());
        }
        let scene = &set.scenes[index];
        (progress.step)(&format!("scene {}", scene.id));
        let geometry = scene.geometry.load()?;
        let surfaces = renderer.upload(&geometry)?;
        let is_traced = |technique: &Settings| technique.technique.is_handed_in();
        let tracer = (conditions.iter())
            .any(|(_, pair)| is_traced(&pair.first) || is_traced(&pair.second))
            .then(|| SceneTracer::new(&geometry));
        drop(geometry);
        let mut producer = Producer {
            set,
            folders,
            view: renderer.view(&surfaces),
            tracer,
            drawn: BTreeMap::new(),
        };
        for (condition, pair) in conditions {
            let record = producer.pair(condition, pair, progress)?;
            self.pairs.insert(condition.id.clone(), record);
        }
        Ok(())
    }
}

fn file_name(condition: &SetCondition, label: &str) -> PathBuf {
    PathBuf::from(format!("{}--{label}.png", condition.id))
}

/// An image as it is written.
struct DrawnImage {
    png: Vec<u8>,
    /// Its occlusion, where that is wanted and there is any.
    occlusion_png: Option<Vec<u8>>,
    record: ImageRecord,
}

struct Producer<'a> {
    set: &'a StimulusSet,
    folders: Folders<'a>,
    view: View<'a>,
    /// Where a condition asks for what it finds.
    tracer: Option<SceneTracer>,
    /// By lighting and technique.
    drawn: BTreeMap<String, DrawnImage>,
}

impl Producer<'_> {
    fn pair(
        &mut self,
        condition: &SetCondition,
        pair: &RenderedPair,
        progress: &Progress<'_>,
    ) -> Result<PairRecord, ProduceError> {
        Ok(PairRecord {
            condition: condition.id.clone(),
            scene: condition.scene_id(self.set).to_owned(),
            validity: condition.validity.clone(),
            hypothesis: condition.hypothesis.clone(),
            first: self.image(condition, pair, &pair.first, progress)?,
            second: self.image(condition, pair, &pair.second, progress)?,
        })
    }

    fn image(
        &mut self,
        condition: &SetCondition,
        pair: &RenderedPair,
        technique: &Settings,
        progress: &Progress<'_>,
    ) -> Result<ImageRecord, ProduceError> {
        let file = file_name(condition, &technique.label);
        (progress.step)(&format!("{} {}", condition.id, technique.label));
        let path = self.folders.images.join(&file);
        let key = format!(
            "{} {} {:?}",
            pair.lighting,
            technique.technique.name,
            technique.values()
        );
        if !self.drawn.contains_key(&key) {
            let drawn = self.draw(pair, technique, &path, progress)?;
            self.drawn.insert(key.clone(), drawn);
        }
        let drawn = &self.drawn[&key];
        files::write_whole(&path, &drawn.png)?;
        if let (Some(folder), Some(bytes)) = (self.folders.occlusion, &drawn.occlusion_png) {
            files::write_whole(&folder.join(&file), bytes)?;
        }
        Ok(ImageRecord {
            file,
            technique: technique.label.clone(),
            ..drawn.record.clone()
        })
    }

    fn draw(
        &mut self,
        pair: &RenderedPair,
        technique: &Settings,
        path: &Path,
        progress: &Progress<'_>,
    ) -> Result<DrawnImage, ProduceError> {
        let mut request = self.set.request(pair, technique);
        if let Some(tracer) = &mut self.tracer {
            request = tracer.complete(&mut self.view, request, progress)?;
        }
        let frame = self.view.render(&request)?;
        let png = files::encode_png(path, &frame.picture)?;
        let occlusion = (frame.occlusion.as_ref()).filter(|_| self.folders.occlusion.is_some());
        let occlusion_png = occlusion
            .map(|k| files::encode_occlusion(path, &k.values, (k.width_px, k.height_px)))
            .transpose()?;
        let record = ImageRecord {
            file: PathBuf::new(),
            sha256: digest::sha256_hex(&png),
            width_px: frame.picture.width_px,
            height_px: frame.picture.height_px,
            technique: technique.label.clone(),
            parameters: technique.values(),
            passes: frame.passes,
            source: None,
        };
        Ok(DrawnImage {
            png,
            occlusion_png,
            record,
        })
    }
}
