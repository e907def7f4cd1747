//! What a frame is made of, drawn again when somebody asks: the renderer's targets as pictures.

use crate::render::plan::GeometryFacts;
use crate::render::technique::Settings;
use crate::render::{FloatImage, Gpu, Renderer};
use crate::scene::Geometry;
use crate::stimulus::StimulusSet;
use crate::stimulus::manifest::{PairRecord, Picture};
use crate::stimulus::set::RenderedPair;

/// One target of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Buffer {
    /// Diffuse colour.
    Albedo,
    /// View-space normals.
    Normals,
    /// Linear depth.
    Depth,
    /// The occlusion coefficient, 1 is open.
    Occlusion,
    /// Radiance before the tone map.
    Light,
    /// The image.
    Final,
}

impl Buffer {
    /// All of them, in the order of a frame.
    pub const ALL: [Self; 6] = [
        Self::Albedo,
        Self::Normals,
        Self::Depth,
        Self::Occlusion,
        Self::Light,
        Self::Final,
    ];

    /// As it stands on its button.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Albedo => "Albedo",
            Self::Normals => "Normals",
            Self::Depth => "Depth",
            Self::Occlusion => "Occlusion",
            Self::Light => "Light",
            Self::Final => "Final",
        }
    }
}

/// Draws one image of a rendered condition again, on this machine's adapter: the targets the
/// renderer hands out.
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
    drop(geometry);
    let frame = renderer
        .render(&surfaces, &set.request(pair, technique))
        .map_err(|error| error.to_string())?;
    let mut buffers = Vec::new();
    if let Some(occlusion) = &frame.occlusion {
        buffers.push((Buffer::Occlusion, grey(occlusion)));
    }
    buffers.push((Buffer::Final, frame.picture));
    Ok(buffers)
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
        let plan = set.plan(pair, technique, facts, &image.passes);
        format!("{}\n{}", technique.label, plan.tree(&image.passes))
    });
    Ok(plans.join("\n"))
}

fn geometry(set: &StimulusSet, pair: &RenderedPair) -> Result<Geometry, String> {
    let scene = &set.scenes[pair.scene];
    scene.geometry.load().map_err(|error| error.to_string())
}

/// Values from 0 to 1 as greys; shown as they are, for reading and not for judging.
fn grey(image: &FloatImage) -> Picture {
    let level = |value: &f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    Picture {
        width_px: image.width_px,
        height_px: image.height_px,
        rgba8: image
            .values
            .iter()
            .map(level)
            .flat_map(|level| [level, level, level, 255])
            .collect(),
    }
}
