//! What a frame is made of, drawn again when somebody asks: the renderer's targets as pictures.

use crate::render::plan::GeometryFacts;
use crate::render::technique::Settings;
use crate::render::{Buffer, Gpu, Renderer};
use crate::scene::Geometry;
use crate::stimulus::StimulusSet;
use crate::stimulus::manifest::{PairRecord, Picture};
use crate::stimulus::progress::Progress;
use crate::stimulus::set::RenderedPair;
use crate::stimulus::truth::SceneTracer;

/// Draws one image of a rendered condition again, on this machine's adapter: its buffers.
///
/// # Errors
/// Scene, adapter or driver, in words.
pub fn redraw(
    set: &StimulusSet,
    pair: &RenderedPair,
    technique: &Settings,
) -> Result<Vec<(Buffer, Picture)>, String> {
    let geometry = geometry(set, pair)?;
    let renderer = Renderer::new(Gpu::open(None).map_err(|error| error.to_string())?);
    let surfaces = renderer
        .upload(&geometry)
        .map_err(|error| error.to_string())?;
    let mut view = renderer.view(&surfaces);
    let mut request = set.request(pair, technique);
    if technique.technique.is_handed_in() {
        request = SceneTracer::new(&geometry)
            .complete(&mut view, request, &Progress::SILENT)
            .map_err(|error| error.to_string())?;
    }
    drop(geometry);
    view.buffers(&request).map_err(|error| error.to_string())
}

/// The frame plans of a rendered pair, as text, with the times on record.
///
/// # Errors
/// The scene, in words.
pub fn plans(
    set: &StimulusSet,
    pair: &RenderedPair,
    record: &PairRecord,
) -> Result<String, String> {
    let facts = GeometryFacts::of(&geometry(set, pair)?);
    let images = [(&pair.first, &record.first), (&pair.second, &record.second)];
    let plans = images.map(|(technique, image)| {
        let plan = set.plan(pair, technique, &facts, &image.passes);
        format!("{}\n{}", technique.label, plan.tree(&image.passes))
    });
    Ok(plans.join("\n"))
}

fn geometry(set: &StimulusSet, pair: &RenderedPair) -> Result<Geometry, String> {
    let scene = &set.scenes[pair.scene];
    scene.geometry.load().map_err(|error| error.to_string())
}
