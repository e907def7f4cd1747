//! What is asked of the renderer for one image, and the numbers its shaders are given.

use std::sync::Arc;

use glam::{Mat4, Vec3};

use super::RenderError;
use super::plan::FramePlan;
use super::readback::FloatImage;
use super::technique::{self, Settings, TECHNIQUES};
use crate::scene::{Ambient, Camera, Lighting, ModelLights, PointLight, SceneConfig, Sun};

/// How finely normals and occlusion are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// 16-bit octahedral normals, half-float occlusion.
    #[default]
    Full,
    /// The thesis' tables 1 and 2: 8-bit normals, 8-bit occlusion. (Its depth, a float from 0
    /// to 1 of the far plane, has the same relative precision as metres in a float.)
    Thesis,
}

/// One image to draw.
#[derive(Debug, Clone)]
pub struct FrameRequest {
    /// Columns of the image.
    pub width_px: u32,
    /// Rows of the image.
    pub height_px: u32,
    /// Shaded samples along one side of a pixel. Occlusion is always at the image's own
    /// resolution: its number of samples a pixel means what it says.
    pub supersampling: u32,
    /// Where from.
    pub camera: Camera,
    /// How it is lit.
    pub lighting: Lighting,
    /// What occludes the ambient light.
    pub occlusion: Settings,
    /// The occlusion itself, at the image's size, for a technique that is computed outside of
    /// the renderer.
    pub handed_occlusion: Option<Arc<FloatImage>>,
    /// Half width of the occlusion blur, pixels; 0 for none.
    pub blur_radius_px: u32,
    /// Distance from a plane at which a blur tap counts 1/e, metres.
    pub blur_plane_m: f32,
    /// How finely buffers are stored.
    pub precision: Precision,
    /// Seed of kernels and noise.
    pub seed: u64,
    /// Whether occlusion that the model's author baked into textures counts too.
    pub baked_occlusion: bool,
    /// Whether occlusion is stored as the technique gives it, in 32-bit floats, instead of
    /// brought to 0 to 1, which would hide what is no number: for checks.
    pub unbounded_occlusion: bool,
    /// Whether the bent cone is kept for reading, whatever light there is: for measurements. `ssdo` gives
    /// it in place of its light by direction.
    pub keeps_cone: bool,
    /// Whether every effect runs, at weight nought where the scene does not call for it.
    /// The image is the same, byte for byte; the time is not.
    pub all_effects: bool,
}

impl FrameRequest {
    /// An image of a scene under one of its lighting variants.
    #[must_use]
    pub fn new(
        scene: &SceneConfig,
        lighting: &Lighting,
        occlusion: Settings,
        (width_px, height_px): (u32, u32),
        seed: u64,
    ) -> Self {
        Self {
            width_px,
            height_px,
            supersampling: scene.supersampling,
            camera: scene.camera,
            lighting: lighting.clone(),
            occlusion,
            handed_occlusion: None,
            blur_radius_px: scene.occlusion.blur_radius_px,
            blur_plane_m: scene.occlusion.blur_plane_m,
            precision: Precision::Full,
            seed,
            baked_occlusion: scene.occlusion.baked,
            unbounded_occlusion: false,
            keeps_cone: false,
            all_effects: false,
        }
    }

    /// The request with the model's own lights among its lights, if its lighting asks for
    /// them.
    #[must_use]
    pub(super) fn with_model_lights(&self, lights: &ModelLights) -> Self {
        Self {
            lighting: self.lighting.with_model_lights(lights),
            ..self.clone()
        }
    }

    /// The request with whatever `all_effects` runs beside what is asked for: each of it
    /// there, and dark or without weight.
    pub(super) fn filled_in(&self) -> Self {
        let mut filled = self.clone();
        if !self.all_effects {
            return filled;
        }
        let shaded = || {
            TECHNIQUES
                .iter()
                .find(|technique| technique.shader.is_some())
        };
        if let (false, Some(technique)) = (self.occlusion.technique.occludes(), shaded()) {
            filled.occlusion = Settings::defaults(technique, technique.name);
        }
        let lighting = &mut filled.lighting;
        lighting.sun.get_or_insert(Sun {
            towards: Vec3::Y,
            irradiance: Vec3::ZERO,
            casts_shadows: true,
        });
        if lighting.points.is_empty() {
            lighting.points.push(PointLight {
                position_m: Vec3::ZERO,
                intensity: Vec3::ZERO,
                cone: None,
            });
        }
        filled
    }

    /// The occlusion that was handed in, for a technique that takes it so.
    pub(super) fn handed_image(&self) -> Option<&FloatImage> {
        let image = self.handed_occlusion.as_deref()?;
        self.occlusion.technique.is_handed_in().then_some(image)
    }

    /// Refuses a technique whose occlusion is to be handed in and was not, or not whole.
    ///
    /// # Errors
    /// [`RenderError::Request`].
    pub(super) fn check_handed_image(&self) -> Result<(), RenderError> {
        let wrong = |what: &str| {
            let label = &self.occlusion.label;
            let message = format!(
                "the occlusion of `{label}` is computed outside of the renderer and handed in; {what}"
            );
            Err(RenderError::Request(message))
        };
        match self.handed_image() {
            None if self.occlusion.technique.is_handed_in() => wrong("none was"),
            Some(image) if (image.width_px, image.height_px) != (self.width_px, self.height_px) => {
                wrong("the one that was is of another size than the image")
            }
            _ => Ok(()),
        }
    }

    /// Format of the occlusion target.
    pub(super) fn occlusion_format(&self) -> wgpu::TextureFormat {
        match self.unbounded_occlusion {
            true => wgpu::TextureFormat::R32Float,
            false => Formats::of(self.precision).occlusion,
        }
    }

    /// Whether the environment's light comes in through the bent cone. Constant light is the same
    /// through any.
    pub(super) fn lights_through_cone(&self) -> bool {
        let has_environment = self.lighting.ambient == Ambient::Environment || self.all_effects;
        has_environment && self.occlusion.is(technique::BENT_CONE, "on")
    }

    /// Whether there is a target for the bent cone.
    pub(super) fn has_cone(&self) -> bool {
        self.occlusion.technique.gives_cone && (self.keeps_cone || self.lights_through_cone())
    }

    /// Whether there is a target for ambient light by direction.
    pub(super) fn has_directional(&self) -> bool {
        self.occlusion.technique.inputs.light && !self.has_cone()
    }

    /// The WGSL part `bounded`.
    pub(super) fn bounded_part(&self) -> (&'static str, &'static str) {
        let text = match self.unbounded_occlusion {
            true => "fn bounded(value: f32) -> f32 { return value; }",
            false => "fn bounded(value: f32) -> f32 { return clamp(value, 0.0, 1.0); }",
        };
        ("bounded", text)
    }

    pub(super) fn aspect(&self) -> f32 {
        self.width_px as f32 / self.height_px as f32
    }

    /// Whether occlusion is estimated once for 2 × 2 pixels.
    pub(super) fn halves_occlusion(&self) -> bool {
        self.occlusion.is(technique::RESOLUTION, "half")
    }

    /// Size of the occlusion target, pixels. An odd column or row has no estimate of its own.
    pub(super) fn occlusion_size(&self) -> (u32, u32) {
        let divisor = if self.halves_occlusion() { 2 } else { 1 };
        (
            (self.width_px / divisor).max(1),
            (self.height_px / divisor).max(1),
        )
    }

    /// Size of the targets that are shaded, pixels.
    pub(super) fn shaded_size(&self) -> (u32, u32) {
        (
            self.width_px * self.supersampling,
            self.height_px * self.supersampling,
        )
    }
}

/// The WGSL struct `Frame`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FrameUniform {
    view: Mat4,
    view_projection: Mat4,
    inverse_view: Mat4,
    eye_m: Vec3,
    near_m: f32,
    half_extent: [f32; 2],
    far_m: f32,
    exposure: f32,
    size_px: [f32; 2],
    image_px: [f32; 2],
    samples: i32,
    padding: [i32; 3],
}

impl FrameUniform {
    pub(super) fn new(request: &FrameRequest, (width_px, height_px): (u32, u32)) -> Self {
        let camera = &request.camera;
        let aspect = request.aspect();
        let view = camera.view();
        Self {
            view,
            view_projection: camera.projection(aspect) * view,
            inverse_view: view.inverse(),
            eye_m: camera.position_m,
            near_m: camera.near_m,
            half_extent: camera.half_extent_at_1m(aspect).into(),
            far_m: camera.far_m,
            exposure: request.lighting.exposure_ev.exp2(),
            size_px: [width_px as f32, height_px as f32],
            image_px: [request.width_px as f32, request.height_px as f32],
            samples: request.supersampling as i32,
            padding: [0; 3],
        }
    }

    /// The same for the passes that estimate occlusion, whose pixels may be larger. Their size is
    /// a fraction where the image's is odd, so that points stay where they are.
    pub(super) fn of_occlusion(request: &FrameRequest) -> Self {
        let side = if request.halves_occlusion() { 2 } else { 1 };
        let size = [request.width_px, request.height_px].map(|px| px as f32 / side as f32);
        Self {
            size_px: size,
            image_px: size,
            samples: (side * request.supersampling) as i32,
            ..Self::new(request, (request.width_px, request.height_px))
        }
    }

    /// The same scene seen by its directional light.
    pub(super) fn seen_from_light(mut self, light_from_world: Mat4) -> Self {
        self.view_projection = light_from_world;
        self.size_px = [SHADOW_SIZE_PX as f32; 2];
        // Light comes in parallel: nothing is behind its eye.
        self.near_m = 0.0;
        self
    }
}

/// Side of the shadow map.
pub(super) const SHADOW_SIZE_PX: u32 = 4096;

/// Formats of the frame's targets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Formats {
    pub normals: wgpu::TextureFormat,
    pub occlusion: wgpu::TextureFormat,
}

impl Formats {
    pub(super) const ALBEDO: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
    pub(super) const DEPTH_TEST: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
    pub(super) const RADIANCE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(super) const CONE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(super) const EMISSION: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(super) const VISIBILITY: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;
    pub(super) const OUTPUT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    pub(super) fn of(precision: Precision) -> Self {
        match precision {
            Precision::Full => Self {
                normals: wgpu::TextureFormat::Rg32Uint,
                occlusion: wgpu::TextureFormat::R16Float,
            },
            Precision::Thesis => Self {
                normals: wgpu::TextureFormat::Rgba8Unorm,
                occlusion: wgpu::TextureFormat::R8Unorm,
            },
        }
    }
}

/// The WGSL part `normals` for a frame.
pub(super) fn normals_part(plan: &FramePlan, precision: Precision) -> (&'static str, &'static str) {
    let text = match (plan.reads_normals, precision) {
        (false, _) => include_str!("shaders/lighting/normals_none.wgsl"),
        (true, Precision::Full) => include_str!("shaders/normals_full.wgsl"),
        (true, Precision::Thesis) => include_str!("shaders/normals_thesis.wgsl"),
    };
    ("normals", text)
}
