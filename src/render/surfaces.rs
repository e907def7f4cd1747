//! What images of one scene from one view share: its surfaces, and where the directional
//! light falls on them. Neither depends on the technique.

use super::bindings::uniform_of;
use super::frame::{Formats, FrameRequest, FrameUniform, Precision, SHADOW_SIZE_PX, normals_part};
use super::light::LightUniform;
use super::material::MaterialUse;
use super::pass::{self, FilterInputs, GeometryInputs, GeometryTargets};
use super::plan::{FramePlan, PassKind};
use super::recorder::Recorder;
use super::shadow_view::ShadowView;
use super::targets::target;
use super::{Gpu, GpuScene, RenderError};
use crate::render::PassRecord;
use crate::scene::Camera;

/// What drawn surfaces depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceKey {
    camera: Camera,
    shaded_px: (u32, u32),
    precision: Precision,
    usage: MaterialUse,
}

impl SurfaceKey {
    pub(super) fn new(request: &FrameRequest, plan: &FramePlan) -> Self {
        Self {
            camera: request.camera,
            shaded_px: request.shaded_size(),
            precision: request.precision,
            usage: MaterialUse {
                normals: plan.reads_normals,
                emission: plan.reads_emission,
                baked: plan.reads_emission && request.baked_occlusion,
            },
        }
    }
}

/// Drawn surfaces.
pub(super) struct Surfaces {
    pub key: SurfaceKey,
    pub albedo: wgpu::TextureView,
    pub depth_m: wgpu::TextureView,
    pub normals: Option<wgpu::TextureView>,
    pub emission: Option<wgpu::TextureView>,
    depth_test: wgpu::TextureView,
    uncovered: Option<bool>,
    pub records: Vec<PassRecord>,
}

impl Surfaces {
    /// Draws a scene's surfaces.
    pub(super) fn draw(
        gpu: &Gpu,
        scene: &GpuScene,
        request: &FrameRequest,
        plan: &FramePlan,
    ) -> Self {
        let key = SurfaceKey::new(request, plan);
        let size = request.shaded_size();
        let formats = Formats::of(request.precision);
        let mut surfaces = Self {
            key,
            albedo: target(gpu, "albedo", size, Formats::ALBEDO),
            depth_m: target(gpu, "linear depth", size, Formats::DEPTH),
            normals: plan
                .reads_normals
                .then(|| target(gpu, "normals", size, formats.normals)),
            emission: plan
                .reads_emission
                .then(|| target(gpu, "emission", size, Formats::EMISSION)),
            depth_test: target(gpu, "depth test", size, Formats::DEPTH_TEST),
            uncovered: None,
            records: Vec::new(),
        };
        let frame = uniform_of(&gpu.device, "frame", &[FrameUniform::new(request, size)]);
        let materials = scene.bind_materials(gpu, key.usage);
        let inputs = GeometryInputs {
            frame: &frame,
            // The shader composes whole; without a normals target its flat entry points
            // run, which use nothing of this part.
            normals_part: if plan.reads_normals {
                normals_part(plan, request.precision)
            } else {
                ("normals", include_str!("shaders/normals_full.wgsl"))
            },
            materials: &materials,
            far_m: request.camera.far_m,
        };
        let targets = GeometryTargets {
            albedo: &surfaces.albedo,
            depth_m: &surfaces.depth_m,
            normals: surfaces.normals.as_ref(),
            emission: surfaces.emission.as_ref(),
            depth_test: &surfaces.depth_test,
        };
        let mut recorder = Recorder::new(gpu, 1);
        recorder.pass(PassKind::Geometry, |encoder| {
            pass::geometry(gpu, encoder, scene, &inputs, &targets);
        });
        surfaces.records = recorder.finish();
        surfaces
    }

    /// Whether any texel shows no surface.
    ///
    /// # Errors
    /// [`RenderError::Device`] if the driver fails.
    pub(super) fn is_uncovered(&mut self, gpu: &Gpu) -> Result<bool, RenderError> {
        match self.uncovered {
            Some(known) => Ok(known),
            None => Ok(*self
                .uncovered
                .insert(pass::is_uncovered(gpu, &self.depth_test)?)),
        }
    }
}

/// Where the directional light falls.
pub(super) struct SunVisibility {
    key: (SurfaceKey, [f32; 3]),
    pub view: wgpu::TextureView,
    pub records: Vec<PassRecord>,
}

impl SunVisibility {
    /// Whether this is what a frame needs.
    pub(super) fn serves(&self, request: &FrameRequest, surfaces: &Surfaces) -> bool {
        self.key == Self::key(request, surfaces)
    }

    fn key(request: &FrameRequest, surfaces: &Surfaces) -> (SurfaceKey, [f32; 3]) {
        let towards = request
            .lighting
            .sun
            .as_ref()
            .map_or([0.0; 3], |sun| sun.towards.into());
        (surfaces.key, towards)
    }

    /// Draws the shadow map and filters it over the surfaces; `None` where there is no
    /// sun, no surface or no normal.
    pub(super) fn draw(
        gpu: &Gpu,
        scene: &GpuScene,
        request: &FrameRequest,
        plan: &FramePlan,
        surfaces: &Surfaces,
    ) -> Option<Self> {
        let sun = request.lighting.sun.as_ref()?;
        let normals = surfaces.normals.as_ref()?;
        // Without surfaces everything is lit; the box only has to be one.
        let bounds_m = scene
            .bounds_m
            .unwrap_or((glam::Vec3::NEG_ONE, glam::Vec3::ONE));
        let shadow_view = ShadowView::new(sun.towards, bounds_m, &request.camera, request.aspect());
        let size = request.shaded_size();
        let frame = FrameUniform::new(request, size);
        let from_light = frame.seen_from_light(shadow_view.from_world);
        let from_light = uniform_of(&gpu.device, "shadow view", &[from_light]);
        let frame = uniform_of(&gpu.device, "frame", &[frame]);
        let light = LightUniform::new(request, Some(shadow_view));
        let light = uniform_of(&gpu.device, "light", &[light]);
        let side = (SHADOW_SIZE_PX, SHADOW_SIZE_PX);
        let shadow = target(gpu, "shadow", side, Formats::DEPTH_TEST);
        let view = target(gpu, "sun visibility", size, Formats::VISIBILITY);
        let materials = scene.bind_materials(
            gpu,
            MaterialUse {
                normals: false,
                emission: false,
                baked: false,
            },
        );
        let inputs = FilterInputs {
            frame: &frame,
            light: &light,
            depth_m: &surfaces.depth_m,
            normals,
            normals_part: normals_part(plan, request.precision),
            shadow: &shadow,
        };
        let mut recorder = Recorder::new(gpu, 2);
        recorder.pass(PassKind::ShadowMap, |encoder| {
            pass::shadow_map(gpu, encoder, scene, &materials, &from_light, &shadow);
        });
        recorder.pass(PassKind::ShadowFilter, |encoder| {
            pass::shadow_filter(gpu, encoder, &inputs, &view);
        });
        Some(Self {
            key: Self::key(request, surfaces),
            view,
            records: recorder.finish(),
        })
    }
}
