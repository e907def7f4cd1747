//! Which passes a frame needs, and why: decided before anything is created.
//!
//! A pass is in the plan because something the scene asks for reads what it writes. Nothing
//! else is created, bound or run. [`FrameRequest::all_effects`] runs the rest too, at
//! weight nought, to show that it changes nothing.

mod planner;
mod rules;
mod tree;

use super::frame::FrameRequest;
use crate::scene::{Geometry, ModelLights};

/// One kind of pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PassKind {
    /// Surfaces at the shaded resolution.
    Geometry,
    /// Depth from the directional light.
    ShadowMap,
    /// How much of the directional light arrives.
    ShadowFilter,
    /// The technique.
    Occlusion,
    /// Edge-aware blur along rows.
    BlurRows,
    /// Edge-aware blur along columns.
    BlurColumns,
    /// Occlusion of half resolution to every pixel.
    Upsample,
    /// Ambient light to the image at once.
    Shade,
    /// Light from all round.
    Ambient,
    /// The environment mirrored in surfaces.
    Reflections,
    /// What surfaces send out.
    Emission,
    /// The directional light.
    Sun,
    /// Lights from points.
    PointLights,
    /// The environment where no surface is.
    Skybox,
    /// Tone map, average, sRGB.
    Output,
}

impl PassKind {
    /// Name in plans and manifests.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Geometry => "geometry",
            Self::ShadowMap => "shadow-map",
            Self::ShadowFilter => "shadow-filter",
            Self::Occlusion => "occlusion",
            Self::BlurRows => "blur-rows",
            Self::BlurColumns => "blur-columns",
            Self::Upsample => "upsample",
            Self::Shade => "shade",
            Self::Ambient => "ambient",
            Self::Reflections => "reflections",
            Self::Emission => "emission",
            Self::Sun => "sun",
            Self::PointLights => "point-lights",
            Self::Skybox => "skybox",
            Self::Output => "output",
        }
    }
}

/// A pass that will run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedPass {
    /// What it does.
    pub kind: PassKind,
    /// Size of its target, pixels.
    pub size_px: (u32, u32),
    /// What it reads.
    pub reads: Vec<&'static str>,
    /// What it writes.
    pub writes: Vec<&'static str>,
    /// Why it is here: what asked for it.
    pub because: String,
}

/// An effect that will not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// The effect.
    pub effect: &'static str,
    /// Why not.
    pub because: String,
}

/// What the planner needs to know of the geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometryFacts {
    /// Number of triangles.
    pub triangles: usize,
    /// Whether any material has a normal map.
    pub has_normal_maps: bool,
    /// Whether any material sends out light.
    pub emits: bool,
    /// Whether any material has occlusion baked into a texture.
    pub has_baked_occlusion: bool,
    /// Whether any texel is left without a surface: known once the surfaces are drawn.
    pub uncovered: Option<bool>,
    /// The model's own lights, for lightings that ask for them.
    pub lights: ModelLights,
}

impl GeometryFacts {
    /// The facts of a scene's geometry, before it is drawn.
    #[must_use]
    pub fn of(geometry: &Geometry) -> Self {
        Self {
            triangles: geometry.triangles(),
            has_normal_maps: geometry.has_normal_maps(),
            emits: geometry.materials.iter().any(|material| material.emits()),
            has_baked_occlusion: geometry
                .materials
                .iter()
                .any(|material| material.occlusion_texture.is_some()),
            uncovered: None,
            lights: geometry.lights.clone(),
        }
    }
}

/// The passes of one frame, in the order they run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePlan {
    /// What runs.
    pub passes: Vec<PlannedPass>,
    /// What does not, and why.
    pub left_out: Vec<LeftOut>,
    /// Whether anything reads normals (and so whether they are stored).
    pub reads_normals: bool,
    /// Whether anything reads what surfaces send out, or baked occlusion.
    pub reads_emission: bool,
}

impl FramePlan {
    /// Plans a frame.
    #[must_use]
    pub fn new(request: &FrameRequest, geometry: &GeometryFacts) -> Self {
        planner::plan(&request.with_model_lights(&geometry.lights), geometry)
    }

    /// Whether a pass of this kind runs.
    #[must_use]
    pub fn has(&self, kind: PassKind) -> bool {
        self.passes.iter().any(|pass| pass.kind == kind)
    }
}

#[cfg(test)]
mod tests;
