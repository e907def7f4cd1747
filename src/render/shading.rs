//! From drawn surfaces to an image: occlusion, light, output.

use glam::Vec3;
use half::f16;
use wgpu::util::DeviceExt;

use super::bindings::uniform_of;
use super::environment::EnvironmentTextures;
use super::estimate::Estimate;
use super::frame::{Formats, FrameRequest, FrameUniform, normals_part};
use super::light::{LightUniform, PointUniform};
use super::pass::{
    self, BlurInputs, Drawable, LightInputs, OcclusionInputs, OcclusionTargets, UpsampleInputs,
};
use super::plan::{FramePlan, PassKind};
use super::readback::{FloatImage, Readback};
use super::recorder::Recorder;
use super::surfaces::Surfaces;
use super::targets::target;
use super::{Gpu, RenderError};
use crate::render::{PassRecord, Picture};
use crate::scene::{Ambient, Background};

/// A shaded image, with what can be read of how it came about.
pub(super) struct Shaded {
    pub picture: Picture,
    pub occlusion: Option<FloatImage>,
    /// What is closed by direction, a pixel, where the request keeps it.
    pub cone: Option<Vec<Vec3>>,
    /// Radiance, RGBA, at the shaded resolution, where the frame keeps it.
    pub radiance: Option<wgpu::TextureView>,
    /// What ran here, in order.
    pub passes: Vec<PassRecord>,
}

/// The lights of a request, with the weights of what it asks for; where shadows lie has been
/// drawn before.
pub(super) fn lights_of(request: &FrameRequest) -> LightUniform {
    LightUniform::new(request, None)
}

/// Shades. `request` has everything that `plan` runs; `lights` weighs it.
pub(super) fn shade(
    gpu: &Gpu,
    request: &FrameRequest,
    plan: &FramePlan,
    drawn: Drawn<'_>,
    lights: LightUniform,
) -> Result<Shaded, RenderError> {
    let shading = Shading::new(gpu, request, plan, drawn, lights);
    let mut recorder = Recorder::new(gpu, plan.passes.len());
    for planned in &plan.passes {
        shading.record(&mut recorder, planned.kind);
    }
    let image = Readback::record(gpu, &mut recorder.encoder, shading.image.texture());
    let occlusion = shading
        .occlusion
        .as_ref()
        .map(|found| Readback::record(gpu, &mut recorder.encoder, found.of_pixels().texture()));
    let kept = shading.cone.as_ref().filter(|_| request.keeps_cone);
    let cone =
        kept.map(|found| Readback::record(gpu, &mut recorder.encoder, found.of_pixels().texture()));
    let passes = recorder.finish();
    Ok(Shaded {
        picture: Picture {
            width_px: request.width_px,
            height_px: request.height_px,
            rgba8: image.read(gpu)?,
        },
        occlusion: occlusion.map(|copy| copy.read_floats(gpu)).transpose()?,
        cone: cone.map(|copy| copy.read_half_vectors(gpu)).transpose()?,
        radiance: shading.radiance,
        passes,
    })
}

/// The passes of `plan` that come to an estimate of occlusion, each ready to be drawn.
pub(super) fn estimating(
    gpu: &Gpu,
    request: &FrameRequest,
    plan: &FramePlan,
    drawn: Drawn<'_>,
    lights: LightUniform,
) -> Vec<(PassKind, Vec<Drawable>)> {
    let shading = Shading::new(gpu, request, plan, drawn, lights);
    (plan.passes.iter())
        .map(|planned| (planned.kind, shading.estimating(planned.kind)))
        .filter(|(_, drawables)| !drawables.is_empty())
        .collect()
}

/// What was made before, for all images of a scene that have it in common.
#[derive(Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub surfaces: &'a Surfaces,
    /// How much of the directional light arrives.
    pub visibility: Option<&'a wgpu::TextureView>,
    pub environment: &'a EnvironmentTextures,
    /// Spheres in place of the triangles: centre and radius, world space, metres.
    pub proxies: &'a [[f32; 4]],
}

/// What the passes after the surfaces share.
struct Shading<'a> {
    gpu: &'a Gpu,
    request: &'a FrameRequest,
    plan: &'a FramePlan,
    drawn: Drawn<'a>,
    normals_part: (&'static str, &'static str),
    /// Frame numbers at the shaded size, at the image's, and at the occlusion's.
    shaded_frame: wgpu::Buffer,
    image_frame: wgpu::Buffer,
    occlusion_frame: wgpu::Buffer,
    light: wgpu::Buffer,
    points: Option<wgpu::Buffer>,
    occlusion: Option<Estimate>,
    /// What the ambient light changes by, where the technique says it by direction.
    directional: Option<Estimate>,
    /// What is closed by direction, where the frame has the bent cone.
    cone: Option<Estimate>,
    /// The WGSL of light between surfaces, where it is asked for.
    inter_reflection: Option<String>,
    radiance: Option<wgpu::TextureView>,
    image: wgpu::TextureView,
}

impl<'a> Shading<'a> {
    fn new(
        gpu: &'a Gpu,
        request: &'a FrameRequest,
        plan: &'a FramePlan,
        drawn: Drawn<'a>,
        lights: LightUniform,
    ) -> Self {
        let frame = |size| uniform_of(&gpu.device, "frame", &[FrameUniform::new(request, size)]);
        let image_size = (request.width_px, request.height_px);
        let points: Vec<PointUniform> = request.lighting.points.iter().map(Into::into).collect();
        let estimate = |label, format| Estimate::new(gpu, request, plan, label, format);
        Self {
            gpu,
            request,
            plan,
            drawn,
            normals_part: normals_part(plan, request.precision),
            shaded_frame: frame(request.shaded_size()),
            image_frame: frame(image_size),
            occlusion_frame: uniform_of(
                &gpu.device,
                "frame",
                &[FrameUniform::of_occlusion(request)],
            ),
            light: uniform_of(&gpu.device, "light", &[lights]),
            points: plan.has(PassKind::PointLights).then(|| {
                gpu.device
                    .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some("point lights"),
                        contents: bytemuck::cast_slice(&points),
                        usage: wgpu::BufferUsages::STORAGE,
                    })
            }),
            occlusion: match request.handed_image() {
                Some(image) => Some(Estimate::handed_in(gpu, image, request.precision)),
                None => estimate("occlusion", request.occlusion_format()),
            },
            directional: (request.has_directional())
                .then(|| estimate("directional light", Formats::RADIANCE))
                .flatten(),
            cone: (request.has_cone())
                .then(|| estimate("bent cone", Formats::CONE))
                .flatten(),
            inter_reflection: request
                .occlusion
                .inter_reflection()
                .map(|(model, openness)| model.wgsl_given(openness)),
            radiance: plan
                .has(PassKind::Ambient)
                .then(|| target(gpu, "radiance", request.shaded_size(), Formats::RADIANCE)),
            image: target(gpu, "image", image_size, Formats::OUTPUT),
        }
    }

    fn record(&self, recorder: &mut Recorder<'_>, kind: PassKind) {
        match kind {
            // Drawn before, for all images that share them.
            PassKind::Geometry | PassKind::ShadowMap | PassKind::ShadowFilter => {}
            PassKind::Occlusion
            | PassKind::BlurRows
            | PassKind::BlurColumns
            | PassKind::Upsample => {
                let drawables = self.estimating(kind);
                recorder.pass(kind, |encoder| {
                    for drawable in &drawables {
                        drawable.draw(encoder);
                    }
                });
            }
            PassKind::Shade => recorder.pass(kind, |encoder| {
                let (lighting, samples) = (&self.request.lighting, self.request.supersampling);
                let inputs = self.light_inputs();
                pass::shade(self.gpu, encoder, lighting, samples, &inputs, &self.image);
            }),
            PassKind::Output => recorder.pass(kind, |encoder| {
                let (lighting, samples) = (&self.request.lighting, self.request.supersampling);
                // The plan has an ambient pass, and so radiance, wherever it has an output.
                if let Some(radiance) = &self.radiance {
                    pass::output(self.gpu, encoder, lighting, samples, radiance, &self.image);
                }
            }),
            light => recorder.pass(kind, |encoder| {
                if let Some(radiance) = &self.radiance {
                    pass::light(self.gpu, encoder, light, &self.light_inputs(), radiance);
                }
            }),
        }
    }

    /// What a pass draws of those that come to an estimate of occlusion.
    fn estimating(&self, kind: PassKind) -> Vec<Drawable> {
        match kind {
            PassKind::Occlusion => self.occlusion().into_iter().collect(),
            PassKind::BlurRows => self.blur([1, 0]),
            PassKind::BlurColumns => self.blur([0, 1]),
            PassKind::Upsample => self.upsample(),
            _ => Vec::new(),
        }
    }

    fn occlusion(&self) -> Option<Drawable> {
        // Occlusion is planned with normals, always.
        let (normals, occlusion) = (
            self.drawn.surfaces.normals.as_ref()?,
            self.occlusion.as_ref()?,
        );
        let inputs = OcclusionInputs {
            frame: &self.occlusion_frame,
            depth_m: &self.drawn.surfaces.depth_m,
            normals,
            normals_part: self.normals_part,
            bounded_part: self.request.bounded_part(),
            albedo: &self.drawn.surfaces.albedo,
            light: &self.light,
            visibility: self.drawn.visibility,
            proxies: self.drawn.proxies,
            seed: self.request.seed,
        };
        let targets = OcclusionTargets {
            occlusion: &occlusion.estimated,
            directional: self.directional.as_ref().map(|found| &found.estimated),
            cone: self.cone.as_ref().map(|found| &found.estimated),
        };
        pass::occlusion(self.gpu, &self.request.occlusion, &inputs, &targets)
    }

    /// What the technique estimated.
    fn estimates(&self) -> impl Iterator<Item = &Estimate> {
        (self.occlusion.iter())
            .chain(&self.directional)
            .chain(&self.cone)
    }

    fn blur(&self, direction: [i32; 2]) -> Vec<Drawable> {
        let Some(normals) = &self.drawn.surfaces.normals else {
            return Vec::new();
        };
        let blur = |estimate: &Estimate| {
            let half_blurred = estimate.half_blurred.as_ref()?;
            let (from, to) = match direction {
                [_, 0] => (&estimate.estimated, half_blurred),
                _ => (half_blurred, &estimate.estimated),
            };
            let inputs = BlurInputs {
                frame: &self.occlusion_frame,
                depth_m: &self.drawn.surfaces.depth_m,
                normals,
                normals_part: self.normals_part,
                occlusion: from,
                radius_px: self.request.blur_radius_px,
                plane_m: self.request.blur_plane_m,
            };
            Some(pass::blur(self.gpu, &inputs, direction, to))
        };
        self.estimates().filter_map(blur).collect()
    }

    fn upsample(&self) -> Vec<Drawable> {
        let Some(normals) = &self.drawn.surfaces.normals else {
            return Vec::new();
        };
        let upsample = |estimate: &Estimate| {
            let target = estimate.upsampled.as_ref()?;
            let inputs = UpsampleInputs {
                frame: &self.image_frame,
                depth_m: &self.drawn.surfaces.depth_m,
                normals,
                normals_part: self.normals_part,
                occlusion: &estimate.estimated,
            };
            Some(pass::upsample(self.gpu, &inputs, target))
        };
        self.estimates().filter_map(upsample).collect()
    }

    fn light_inputs(&self) -> LightInputs<'_> {
        let lighting = &self.request.lighting;
        let background = match lighting.background {
            Background::Colour(colour) => colour.to_array(),
            Background::Environment => [0.0; 3],
        };
        LightInputs {
            frame: &self.shaded_frame,
            light: &self.light,
            depth_m: &self.drawn.surfaces.depth_m,
            albedo: &self.drawn.surfaces.albedo,
            normals: self.drawn.surfaces.normals.as_ref(),
            normals_part: self.normals_part,
            emission: self.drawn.surfaces.emission.as_ref(),
            is_baked: self.plan.reads_emission
                && (self.request.baked_occlusion || self.request.all_effects),
            occlusion: self.occlusion.as_ref().map(Estimate::of_pixels),
            directional: self.directional.as_ref().map(Estimate::of_pixels),
            cone: (self.cone.as_ref())
                .filter(|_| self.request.lights_through_cone())
                .map(Estimate::of_pixels),
            visibility: self.drawn.visibility,
            environment: self.drawn.environment,
            points: self.points.as_ref(),
            has_irradiance: lighting.ambient == Ambient::Environment || self.request.all_effects,
            inter_reflection: self.inter_reflection.as_deref(),
            // As the target stores it, so that clearing has nothing to round.
            background: background.map(|channel| f16::from_f32(channel).to_f32()),
        }
    }
}
