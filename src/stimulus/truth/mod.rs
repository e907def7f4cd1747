//! The truth of a set's pictures: for each scene, occlusion by rays at the points that its
//! images show, as files with a record; and of one scene, light over many bounces.

mod files;
pub mod inter_reflection;
mod record;
mod tracer;

use std::path::{Path, PathBuf};
use std::time::Instant;

pub use files::{read_exr, write_channels, write_exr};
pub use record::{FILE_NAME, TruthImage, TruthKind, TruthRecord};
pub use tracer::SceneTracer;

use super::files::write_whole;
use super::manifest::StimulusError;
use super::produce::{ProduceError, choose};
use super::progress::Progress;
use super::set::{ImageSource, RenderedPair, StimulusSet};
use crate::digest;
use crate::reference::{
    Estimates, OcclusionSettings, RayTraced, SceneBvh, ScreenSpace, Surroundings, estimate,
};
use crate::render::technique::Settings;
use crate::render::{RenderError, Renderer};
use crate::scene::VisibleSurfaces;

/// What is made.
#[derive(Debug, Clone, Copy)]
pub struct TruthOptions {
    /// What is estimated, and how well.
    pub settings: OcclusionSettings,
    /// Whether the depth buffer's own answer is made too.
    pub screen_space: bool,
    /// How deep what is seen goes on behind what is seen of it, metres, for that answer; `None`
    /// for solid.
    pub thickness_m: Option<f32>,
}

/// The scenes that a set, or its condition `only`, renders; each by the first of its pairs.
///
/// # Errors
/// [`ProduceError::NoSuchCondition`]; [`ProduceError::Pair`] if nothing is rendered.
pub fn scenes<'a>(
    set: &'a StimulusSet,
    only: Option<&str>,
) -> Result<Vec<&'a RenderedPair>, ProduceError> {
    let chosen = choose(set, only)?;
    let mut pairs: Vec<&RenderedPair> = Vec::new();
    for condition in &chosen {
        if let ImageSource::Rendered(pair) = &condition.images
            && pairs.iter().all(|known| known.scene != pair.scene)
        {
            pairs.push(pair);
        }
    }
    match chosen.first() {
        Some(condition) if pairs.is_empty() => Err(ProduceError::Pair {
            condition: condition.id.clone(),
            message: String::from("its images were made elsewhere: there is no scene to trace"),
        }),
        _ => Ok(pairs),
    }
}

/// Makes the truth of the scenes that `only` or all conditions show, in `folder`.
///
/// # Errors
/// [`ProduceError`]; the record is written last.
pub fn produce(
    renderer: &Renderer,
    set: &StimulusSet,
    folder: &Path,
    only: Option<&str>,
    options: &TruthOptions,
    progress: &Progress<'_>,
) -> Result<TruthRecord, ProduceError> {
    let pairs = scenes(set, only)?;
    std::fs::create_dir_all(folder).map_err(|source| StimulusError::Unwritable {
        path: folder.to_owned(),
        source,
    })?;
    let mut record = TruthRecord {
        schema_version: record::SCHEMA_VERSION,
        set_id: set.id.clone(),
        config_sha256: set.sha256.clone(),
        app_version: env!("CARGO_PKG_VERSION").to_owned(),
        adapter: renderer.gpu().adapter.clone(),
        size_px: set.size_px.unwrap_or_default(),
        settings: options.settings,
        images: Vec::new(),
    };
    let maker = Maker {
        renderer,
        set,
        folder,
        options,
        progress,
    };
    for pair in pairs {
        record.images.extend(maker.scene(pair)?);
    }
    let path = folder.join(FILE_NAME);
    let text = serde_json::to_string_pretty(&record).map_err(|error| StimulusError::Malformed {
        path: path.clone(),
        message: error.to_string(),
    })?;
    write_whole(&path, (text + "\n").as_bytes())?;
    Ok(record)
}

struct Maker<'a> {
    renderer: &'a Renderer,
    set: &'a StimulusSet,
    folder: &'a Path,
    options: &'a TruthOptions,
    progress: &'a Progress<'a>,
}

impl Maker<'_> {
    fn scene(&self, pair: &RenderedPair) -> Result<Vec<TruthImage>, ProduceError> {
        let scene = &self.set.scenes[pair.scene];
        (self.progress.step)(&format!("scene {}", scene.id));
        let geometry = scene.geometry.load()?;
        let uploaded = self.renderer.upload(&geometry)?;
        let bvh = SceneBvh::new(&geometry);
        drop(geometry);
        let technique = Settings::from_label("ray-traced")
            .map_err(|error| RenderError::Request(error.message))?;
        let request = self.set.request(pair, &technique);
        let surfaces = self.renderer.view(&uploaded).visible_surfaces(&request)?;
        let mut made = Vec::new();
        let points = RayTraced::of_visible(&bvh, &surfaces);
        let (mut image, traced) =
            self.image(&scene.id, TruthKind::RayTraced, &surfaces, &points)?;
        made.push(image);
        if self.options.screen_space {
            let thickness_m = self.options.thickness_m;
            let field =
                ScreenSpace::new(&surfaces).with_thickness_m(thickness_m.unwrap_or(f32::INFINITY));
            let found;
            (image, found) = self.image(&scene.id, TruthKind::ScreenSpace, &surfaces, &field)?;
            image.thickness_m = thickness_m;
            image.information_loss = Some(record::mean_distance(&traced, &found));
            made.push(image);
        }
        Ok(made)
    }

    fn image<S: Surroundings>(
        &self,
        scene: &str,
        kind: TruthKind,
        surfaces: &VisibleSurfaces,
        surroundings: &S,
    ) -> Result<(TruthImage, Estimates), ProduceError> {
        let name = format!("{scene}--{}", kind.name());
        (self.progress.step)(&name);
        let started = Instant::now();
        let found = estimate(surroundings, &self.options.settings, self.progress.pixels)
            .map_err(|error| RenderError::Request(error.to_string()))?;
        let seconds = started.elapsed().as_secs_f64();
        let size_px = (surfaces.width_px, surfaces.height_px);
        let [png, exr] = ["png", "exr"].map(|ending| PathBuf::from(format!("{name}.{ending}")));
        let (png_path, exr_path) = (self.folder.join(&png), self.folder.join(&exr));
        write_whole(&png_path, &files::png(&png_path, &found, size_px)?)?;
        let exr_bytes = files::exr(&exr_path, &found, size_px)?;
        write_whole(&exr_path, &exr_bytes)?;
        let [mean_occlusion, mean_standard_error, largest_standard_error] =
            record::statistics(&found);
        let image = TruthImage {
            scene: scene.to_owned(),
            kind,
            png,
            exr,
            exr_sha256: digest::sha256_hex(&exr_bytes),
            mean_occlusion,
            mean_standard_error,
            largest_standard_error,
            rays_per_pixel: found.rays as f64 / (found.surfaces as f64).max(1.0),
            mrays_per_s: found.rays as f64 / seconds / 1e6,
            seconds,
            information_loss: None,
            thickness_m: None,
        };
        Ok((image, found))
    }
}

#[cfg(test)]
mod tests;
