//! Which passes a frame needs, and why: decided before anything is created.
//!
//! A pass is in the plan because something the scene asks for reads what it writes. Nothing
//! else is created, bound or run.

use std::fmt;

use super::frame::FrameRequest;
use crate::scene::{Ambient, Background, Geometry, ToneMap};

/// One kind of pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PassKind {
    /// Depth from the directional light.
    ShadowMap,
    /// Surfaces at the shaded resolution.
    Geometry,
    /// Surfaces at the image's resolution, for occlusion.
    OcclusionGeometry,
    /// The technique.
    Occlusion,
    /// Edge-aware blur along rows.
    BlurRows,
    /// Edge-aware blur along columns.
    BlurColumns,
    /// Shading.
    Lighting,
    /// Tone map, average, sRGB.
    Output,
}

impl PassKind {
    /// Name in plans and manifests.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ShadowMap => "shadow-map",
            Self::Geometry => "geometry",
            Self::OcclusionGeometry => "occlusion-geometry",
            Self::Occlusion => "occlusion",
            Self::BlurRows => "blur-rows",
            Self::BlurColumns => "blur-columns",
            Self::Lighting => "lighting",
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GeometryFacts {
    /// Number of triangles.
    pub triangles: usize,
    /// Whether any material has a normal map.
    pub has_normal_maps: bool,
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
}

impl GeometryFacts {
    /// The facts of a scene's geometry.
    #[must_use]
    pub fn of(geometry: &Geometry) -> Self {
        Self {
            triangles: geometry.triangles(),
            has_normal_maps: geometry.has_normal_maps(),
        }
    }
}

impl FramePlan {
    /// Plans a frame.
    #[must_use]
    pub fn new(request: &FrameRequest, geometry: GeometryFacts) -> Self {
        Planner {
            request,
            geometry,
            plan: Self {
                passes: Vec::new(),
                left_out: Vec::new(),
                reads_normals: false,
            },
        }
        .run()
    }

    /// Whether a pass of this kind runs.
    #[must_use]
    pub fn has(&self, kind: PassKind) -> bool {
        self.passes.iter().any(|pass| pass.kind == kind)
    }
}

struct Planner<'a> {
    request: &'a FrameRequest,
    geometry: GeometryFacts,
    plan: FramePlan,
}

impl Planner<'_> {
    fn run(mut self) -> FramePlan {
        let occludes = self.request.occlusion.technique.shader.is_some();
        self.plan.reads_normals = occludes
            || self.request.lighting.ambient == Ambient::Environment
            || self.request.lighting.sun.is_some();
        self.shadow_map();
        self.geometry();
        self.occlusion(occludes);
        self.lighting(occludes);
        self.output();
        self.plan
    }

    fn pass(
        &mut self,
        kind: PassKind,
        size_px: (u32, u32),
        reads: &[&'static str],
        writes: &[&'static str],
        because: impl Into<String>,
    ) {
        self.plan.passes.push(PlannedPass {
            kind,
            size_px,
            reads: reads.to_vec(),
            writes: writes.to_vec(),
            because: because.into(),
        });
    }

    fn leave_out(&mut self, effect: &'static str, because: impl Into<String>) {
        self.plan.left_out.push(LeftOut {
            effect,
            because: because.into(),
        });
    }

    fn image_size(&self) -> (u32, u32) {
        (self.request.width_px, self.request.height_px)
    }

    fn shadow_map(&mut self) {
        let side = super::frame::SHADOW_SIZE_PX;
        match &self.request.lighting.sun {
            None => self.leave_out("shadow map", "the lighting has no directional light"),
            Some(sun) if !sun.casts_shadows => {
                self.leave_out("shadow map", "the directional light casts no shadows");
            }
            Some(_) if self.geometry.triangles == 0 => {
                self.leave_out("shadow map", "there is no surface to cast a shadow");
            }
            Some(_) => self.pass(
                PassKind::ShadowMap,
                (side, side),
                &["triangles"],
                &["shadow depth"],
                "the directional light casts shadows",
            ),
        }
    }

    fn geometry(&mut self) {
        let mut writes = vec!["albedo", "linear depth"];
        let because = if self.plan.reads_normals {
            writes.push("normals");
            "surfaces are shaded; normals are read by the lighting or the occlusion"
        } else {
            self.leave_out(
                "normals target",
                "constant ambient light alone depends on no normal",
            );
            "surfaces are shaded, each in its own colour"
        };
        if !self.geometry.has_normal_maps {
            self.leave_out("normal mapping", "no material has a normal map");
        } else if !self.plan.reads_normals {
            self.leave_out("normal mapping", "nothing reads normals");
        }
        self.pass(
            PassKind::Geometry,
            self.request.shaded_size(),
            &["triangles", "textures"],
            &writes,
            because,
        );
    }

    fn occlusion(&mut self, occludes: bool) {
        let technique = self.request.occlusion.technique;
        if !occludes {
            let because = format!("the technique is `{}`", technique.name);
            self.leave_out("occlusion", because.clone());
            self.leave_out("occlusion blur", because);
            return;
        }
        let size = self.image_size();
        if self.request.supersampling > 1 {
            self.pass(
                PassKind::OcclusionGeometry,
                size,
                &["triangles", "textures"],
                &["occlusion depth", "occlusion normals"],
                "occlusion is estimated on the image's own pixels, shading is supersampled",
            );
        }
        let mut reads = vec!["occlusion depth"];
        if technique.inputs.normals {
            reads.push("occlusion normals");
        }
        let because = format!("the technique is `{}`", self.request.occlusion.label);
        self.pass(PassKind::Occlusion, size, &reads, &["occlusion"], because);
        if self.request.blur_radius_px == 0 {
            self.leave_out("occlusion blur", "the scene's blur_radius_px is 0");
            return;
        }
        let reads = ["occlusion", "occlusion depth", "occlusion normals"];
        let because = format!(
            "the samples turn from pixel to pixel in a 4×4 tile; the scene asks for a blur of {} px",
            self.request.blur_radius_px
        );
        self.pass(PassKind::BlurRows, size, &reads, &["occlusion"], because);
        self.pass(
            PassKind::BlurColumns,
            size,
            &reads,
            &["occlusion"],
            "the other direction of the blur",
        );
    }

    fn lighting(&mut self, occludes: bool) {
        let lighting = &self.request.lighting;
        let mut reads = vec!["albedo", "linear depth"];
        let mut asked = Vec::new();
        if self.plan.reads_normals {
            reads.push("normals");
        }
        if occludes {
            reads.push("occlusion");
        }
        match lighting.ambient {
            Ambient::Constant(_) => asked.push("constant ambient light"),
            Ambient::Environment => asked.push("irradiance of the environment"),
        }
        let has_sun = lighting.sun.is_some();
        let sky = lighting.background == Background::Environment;
        if has_sun {
            asked.push("a directional light");
        }
        if self.plan.has(PassKind::ShadowMap) {
            reads.push("shadow depth");
        }
        if sky {
            asked.push("the environment behind the surfaces");
        }
        let because = asked.join(", ");
        if !has_sun {
            self.leave_out("direct light", "the lighting has no directional light");
        }
        if !sky {
            self.leave_out("environment background", "the background is one colour");
        }
        self.pass(
            PassKind::Lighting,
            self.request.shaded_size(),
            &reads,
            &["radiance"],
            because,
        );
    }

    fn output(&mut self) {
        let samples = self.request.supersampling;
        let mut asked = vec![String::from("sRGB encoding")];
        match self.request.lighting.tone_map {
            ToneMap::None => self.leave_out(
                "tone map",
                "the lighting asks for none: nothing is brighter than white",
            ),
            ToneMap::ReinhardExtended { white } => {
                asked.push(format!("Reinhard's tone map, white at {white}"));
            }
            ToneMap::Aces => asked.push(String::from("the ACES tone curve")),
        }
        if samples == 1 {
            self.leave_out("supersampling", "one sample a pixel");
        } else {
            asked.push(format!(
                "the average of {samples}×{samples} samples a pixel"
            ));
        }
        self.pass(
            PassKind::Output,
            self.image_size(),
            &["radiance"],
            &["image"],
            asked.join(", "),
        );
    }
}

impl fmt::Display for FramePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for pass in &self.passes {
            writeln!(
                f,
                "  + {:<19} {:>4}×{:<4}  {}",
                pass.kind.name(),
                pass.size_px.0,
                pass.size_px.1,
                pass.because
            )?;
            writeln!(
                f,
                "    {:<19}            reads {}; writes {}",
                "",
                pass.reads.join(", "),
                pass.writes.join(", ")
            )?;
        }
        for left_out in &self.left_out {
            writeln!(
                f,
                "  - {:<19}            {}",
                left_out.effect, left_out.because
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
