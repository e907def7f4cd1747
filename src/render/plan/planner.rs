//! The order of the passes, with what each reads and writes.

use super::super::frame::{FrameRequest, SHADOW_SIZE_PX};
use super::rules::Asked;
use super::{FramePlan, GeometryFacts, LeftOut, PassKind, PlannedPass};
use crate::scene::{Ambient, ToneMap};

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

pub(super) struct Planner<'a> {
    pub(super) request: &'a FrameRequest,
    pub(super) geometry: &'a GeometryFacts,
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

    fn geometry(&mut self) {
        let normals = self.reads_normals();
        let mut because = String::from("surfaces are shaded");
        let mut writes = vec!["albedo", "linear depth"];
        if let Some(readers) = self.runs("normals target", normals) {
            self.plan.reads_normals = true;
            writes.push("normals");
            because += &format!("; their normals are read by {readers}");
        }
        if let Err(reason) = self.maps_normals(self.plan.reads_normals) {
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
        let Some(mut because) = self.runs("occlusion", asked) else {
            return;
        };
        let size = self.request.occlusion_size();
        let mut reads = self.technique_reads();
        if self.request.occlusion.technique.inputs.proxies {
            match self.fits_proxies() {
                Ok(proxies) => {
                    reads.push("proxies");
                    because += &format!("; it reads {proxies}");
                }
                Err(reason) => self.leave_out("proxies", reason),
            }
        }
        let mut writes = vec!["occlusion"];
        if self.request.has_directional() {
            writes.push("directional light");
        }
        match self.keeps_cone() {
            Some(Ok(reason)) => {
                writes.push("bent cone");
                because += &format!("; {reason}");
            }
            Some(Err(reason)) => self.leave_out("bent cone", reason),
            None => {}
        }
        self.pass(PassKind::Occlusion, size, &reads, &writes, because);
        let mut reads = writes.clone();
        reads.extend(["linear depth", "normals"]);
        let asked = self.blurs();
        if let Some(because) = self.runs("occlusion blur", asked) {
            self.pass(PassKind::BlurRows, size, &reads, &writes, because);
            let because = "the other direction of the blur";
            self.pass(PassKind::BlurColumns, size, &reads, &writes, because);
        }
        if self.request.halves_occlusion() {
            let because = "the technique is asked for at half resolution";
            let size = self.image_size();
            self.pass(PassKind::Upsample, size, &reads, &writes, because);
        } else {
            self.leave_out(
                "occlusion upsampling",
                "there is an estimate for every pixel",
            );
        }
    }

    /// What of the frame the technique reads.
    fn technique_reads(&self) -> Vec<&'static str> {
        let inputs = self.request.occlusion.technique.inputs;
        let mut reads = vec!["linear depth"];
        if inputs.normals {
            reads.push("normals");
        }
        if self.request.occlusion.technique.is_handed_in() {
            reads.push("triangles");
        }
        if inputs.light {
            reads.push("albedo");
            if self.plan.has(PassKind::ShadowFilter) {
                reads.push("sun visibility");
            }
        }
        reads
    }

    /// What a pass of light from all round reads; `occlusion` is the target that it is dimmed by.
    fn ambient_reads(&self, occlusion: &'static str) -> Vec<&'static str> {
        let mut reads = vec!["albedo", "linear depth"];
        if self.plan.reads_normals {
            reads.push("normals");
        }
        if self.plan.has(PassKind::Occlusion) {
            reads.push(occlusion);
        }
        if self.bakes().is_ok() {
            reads.push("emission");
        }
        reads
    }

    /// What the ambient light is, and what between surfaces is added to it.
    fn ambient_because(&mut self, light: &str) -> String {
        match self.reflects_between() {
            Ok(model) => format!("{light}; {model}"),
            Err(reason) => {
                self.leave_out("light between surfaces", reason);
                light.to_owned()
            }
        }
    }

    /// The target that dims the ambient term.
    fn dimming(&self) -> &'static str {
        if self.request.has_directional() {
            "directional light"
        } else {
            "occlusion"
        }
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
        let light = format!("constant ambient light, {}", self.samples());
        let because = self.ambient_because(&light);
        let reads = self.ambient_reads(self.dimming());
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
        let because = self.ambient_because(match self.request.lighting.ambient {
            Ambient::Constant(_) => "constant ambient light",
            Ambient::Environment => "irradiance of the environment",
        });
        let mut ambient_reads = self.ambient_reads(self.dimming());
        if self.request.lights_through_cone() {
            ambient_reads.push("bent cone");
        }
        let reflection_reads = self.ambient_reads("occlusion");
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
                reflection_reads,
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
