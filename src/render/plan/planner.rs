//! The rules: what each pass is called for by.

use super::super::frame::{FrameRequest, SHADOW_SIZE_PX};
use super::super::technique::Noise;
use super::{FramePlan, GeometryFacts, LeftOut, PassKind, PlannedPass};
use crate::scene::{Ambient, Background, ToneMap};

/// Called for, and by what; or not called for, and why not.
type Asked = Result<String, String>;

/// Plans a frame.
pub(super) fn plan(request: &FrameRequest, geometry: &GeometryFacts) -> FramePlan {
    let mut planner = Planner {
        request,
        geometry,
        plan: FramePlan {
            passes: Vec::new(),
            left_out: Vec::new(),
            reads_normals: false,
            reads_emission: false,
        },
    };
    planner.geometry();
    planner.shadows();
    planner.occlusion();
    if planner.is_plain() {
        planner.shade();
    } else {
        planner.lights();
        planner.output();
    }
    planner.plan
}

struct Planner<'a> {
    request: &'a FrameRequest,
    geometry: &'a GeometryFacts,
    plan: FramePlan,
}

impl Planner<'_> {
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

    /// What an effect runs because of, if it runs; it is noted as left out if it does not.
    fn runs(&mut self, effect: &'static str, asked: Asked) -> Option<String> {
        match asked {
            Ok(because) => Some(because),
            Err(reason) if self.request.all_effects => {
                Some(format!("all effects are asked for, though {reason}"))
            }
            Err(reason) => {
                self.leave_out(effect, reason);
                None
            }
        }
    }

    fn image_size(&self) -> (u32, u32) {
        (self.request.width_px, self.request.height_px)
    }

    fn occludes(&self) -> Asked {
        let settings = &self.request.occlusion;
        match settings.technique.shader {
            Some(_) => Ok(format!("the technique is `{}`", settings.label)),
            None => Err(format!("the technique is `{}`", settings.label)),
        }
    }

    fn blurs(&self) -> Asked {
        self.occludes()?;
        if self.request.occlusion.technique.noise == Noise::None {
            return Err(String::from("the technique's estimate has no noise"));
        }
        match self.request.blur_radius_px {
            0 => Err(String::from("the scene's blur_radius_px is 0")),
            radius => Ok(format!(
                "the samples turn from pixel to pixel in a 4×4 tile; the scene asks for a blur of {radius} px"
            )),
        }
    }

    fn sun(&self) -> Asked {
        match self.request.lighting.sun {
            Some(_) => Ok(String::from("the lighting has a directional light")),
            None => Err(String::from("the lighting has no directional light")),
        }
    }

    fn casts_shadows(&self) -> Asked {
        self.sun()?;
        let casts = self
            .request
            .lighting
            .sun
            .as_ref()
            .is_some_and(|sun| sun.casts_shadows);
        match (casts, self.geometry.triangles) {
            (false, _) => Err(String::from("the directional light casts no shadows")),
            (true, 0) => Err(String::from("there is no surface to cast a shadow")),
            (true, _) => Ok(String::from("the directional light casts shadows")),
        }
    }

    fn points(&self) -> Asked {
        match self.request.lighting.points.len() {
            0 => Err(String::from("the lighting has no point light")),
            1 => Ok(String::from("the lighting has a point light")),
            count => Ok(format!("the lighting has {count} point lights")),
        }
    }

    fn reflects(&self) -> Asked {
        if self.request.lighting.reflections {
            Ok(String::from(
                "the lighting asks for reflections of the environment",
            ))
        } else {
            Err(String::from("the lighting asks for none"))
        }
    }

    fn sky(&self) -> Asked {
        if self.request.lighting.background != Background::Environment {
            return Err(String::from("the background is one colour"));
        }
        match self.geometry.uncovered {
            Some(true) => Ok(String::from("some pixels show no surface")),
            Some(false) => Err(String::from("surfaces cover every pixel")),
            None => Ok(String::from(
                "the background is the environment (left out if the depth shows that surfaces cover every pixel)",
            )),
        }
    }

    fn emits(&self) -> Asked {
        if self.geometry.emits {
            Ok(String::from("a material sends out light"))
        } else {
            Err(String::from("no material sends out light"))
        }
    }

    fn bakes(&self) -> Asked {
        match (
            self.request.baked_occlusion,
            self.geometry.has_baked_occlusion,
        ) {
            (true, true) => Ok(String::from(
                "the scene asks for the model's baked occlusion",
            )),
            (true, false) => Err(String::from("no material has any")),
            (false, _) => Err(String::from(
                "the scene does not ask for it: it would count beside the computed one",
            )),
        }
    }

    /// Whether the frame is ambient light before a colour and nothing else, none of it
    /// brighter than white: then no radiance needs keeping.
    fn is_plain(&self) -> bool {
        let lighting = &self.request.lighting;
        !self.request.all_effects
            && matches!(lighting.ambient, Ambient::Constant(_))
            && lighting.tone_map == ToneMap::None
            && [
                self.sun(),
                self.points(),
                self.reflects(),
                self.emits(),
                self.sky(),
            ]
            .iter()
            .all(Result::is_err)
    }

    fn geometry(&mut self) {
        let needs_normals: Vec<&str> = [
            (self.occludes().is_ok(), "the occlusion"),
            (
                self.request.lighting.ambient == Ambient::Environment,
                "the environment's light",
            ),
            (self.reflects().is_ok(), "reflections"),
            (self.sun().is_ok(), "the directional light"),
            (self.points().is_ok(), "the point lights"),
        ]
        .into_iter()
        .filter_map(|(needed, by)| needed.then_some(by))
        .collect();
        let normals = if needs_normals.is_empty() {
            Err(String::from(
                "constant ambient light alone depends on no normal",
            ))
        } else {
            Ok(needs_normals.join(", "))
        };
        let mut because = String::from("surfaces are shaded");
        let mut writes = vec!["albedo", "linear depth"];
        if let Some(readers) = self.runs("normals target", normals) {
            self.plan.reads_normals = true;
            writes.push("normals");
            because += &format!("; their normals are read by {readers}");
        }
        let mapped = match (self.geometry.has_normal_maps, self.plan.reads_normals) {
            (false, _) => Err("no material has a normal map"),
            (true, false) => Err("nothing reads normals"),
            (true, true) => Ok(()),
        };
        if let Err(reason) = mapped {
            self.leave_out("normal mapping", format!("{reason}: no tangent is read"));
        }
        let emission = self
            .emits()
            .or_else(|reason| self.bakes().map_err(|_| reason));
        if self.runs("emission target", emission).is_some() {
            self.plan.reads_emission = true;
            writes.push("emission");
        }
        if let Err(reason) = self.bakes() {
            self.leave_out("baked occlusion", reason);
        }
        let reads = ["triangles", "textures"];
        self.pass(
            PassKind::Geometry,
            self.request.shaded_size(),
            &reads,
            &writes,
            because,
        );
    }

    fn shadows(&mut self) {
        let asked = self.casts_shadows();
        let Some(because) = self.runs("shadow map", asked) else {
            return;
        };
        let size = (SHADOW_SIZE_PX, SHADOW_SIZE_PX);
        self.pass(
            PassKind::ShadowMap,
            size,
            &["triangles"],
            &["shadow depth"],
            because,
        );
        self.pass(
            PassKind::ShadowFilter,
            self.request.shaded_size(),
            &["shadow depth", "linear depth", "normals"],
            &["sun visibility"],
            "shadow edges are filtered once for all images under this light",
        );
    }

    fn occlusion(&mut self) {
        let asked = self.occludes();
        let Some(because) = self.runs("occlusion", asked) else {
            return;
        };
        let size = self.image_size();
        let mut reads = vec!["linear depth"];
        if self.request.occlusion.technique.inputs.normals {
            reads.push("normals");
        }
        self.pass(PassKind::Occlusion, size, &reads, &["occlusion"], because);
        let asked = self.blurs();
        let Some(because) = self.runs("occlusion blur", asked) else {
            return;
        };
        let reads = ["occlusion", "linear depth", "normals"];
        self.pass(PassKind::BlurRows, size, &reads, &["occlusion"], because);
        let because = "the other direction of the blur";
        self.pass(PassKind::BlurColumns, size, &reads, &["occlusion"], because);
    }

    /// What a pass of the ambient term reads.
    fn ambient_reads(&self) -> Vec<&'static str> {
        let mut reads = vec!["albedo", "linear depth"];
        if self.plan.reads_normals {
            reads.push("normals");
        }
        if self.plan.has(PassKind::Occlusion) {
            reads.push("occlusion");
        }
        if self.bakes().is_ok() {
            reads.push("emission");
        }
        reads
    }

    fn shade(&mut self) {
        for (effect, asked) in [
            ("direct light", self.sun()),
            ("point lights", self.points()),
            ("reflections", self.reflects()),
            ("skybox", self.sky()),
        ] {
            if let Err(reason) = asked {
                self.leave_out(effect, reason);
            }
        }
        self.leave_out(
            "radiance target",
            "one term of light goes to the image at once",
        );
        self.leave_out(
            "tone map",
            "the lighting asks for none: nothing is brighter than white",
        );
        let because = format!("constant ambient light, {}", self.samples());
        let reads = self.ambient_reads();
        self.pass(
            PassKind::Shade,
            self.image_size(),
            &reads,
            &["image"],
            because,
        );
    }

    fn lights(&mut self) {
        let size = self.request.shaded_size();
        let because = match self.request.lighting.ambient {
            Ambient::Constant(_) => "constant ambient light",
            Ambient::Environment => "irradiance of the environment",
        };
        let ambient_reads = self.ambient_reads();
        self.pass(
            PassKind::Ambient,
            size,
            &ambient_reads,
            &["radiance"],
            because,
        );
        let mut sun_reads = vec!["albedo", "linear depth", "normals"];
        let point_reads = sun_reads.clone();
        if self.plan.has(PassKind::ShadowFilter) {
            sun_reads.push("sun visibility");
        }
        for (kind, effect, asked, reads) in [
            (
                PassKind::Reflections,
                "reflections",
                self.reflects(),
                ambient_reads,
            ),
            (
                PassKind::Emission,
                "emission",
                self.emits(),
                vec!["linear depth", "emission"],
            ),
            (PassKind::Sun, "direct light", self.sun(), sun_reads),
            (
                PassKind::PointLights,
                "point lights",
                self.points(),
                point_reads,
            ),
            (PassKind::Skybox, "skybox", self.sky(), vec!["linear depth"]),
        ] {
            if let Some(because) = self.runs(effect, asked) {
                self.pass(kind, size, &reads, &["radiance"], because);
            }
        }
    }

    fn samples(&mut self) -> String {
        match self.request.supersampling {
            1 => {
                self.leave_out("supersampling", "the scene asks for one sample a pixel");
                String::from("one sample a pixel")
            }
            samples => format!("the average of {samples}×{samples} samples a pixel"),
        }
    }

    fn output(&mut self) {
        let tone_map = match self.request.lighting.tone_map {
            ToneMap::None => {
                self.leave_out("tone map", "the lighting asks for none");
                String::new()
            }
            ToneMap::ReinhardExtended { white } => {
                format!("Reinhard's tone map with white at {white}, ")
            }
            ToneMap::Aces => String::from("the ACES tone curve, "),
        };
        let because = format!("{tone_map}{}, sRGB encoding", self.samples());
        self.pass(
            PassKind::Output,
            self.image_size(),
            &["radiance"],
            &["image"],
            because,
        );
    }
}
