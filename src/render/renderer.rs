//! Runs a frame's plan.

use super::bindings::uniform_of;
use super::frame::{
    FrameRequest, FrameUniform, LightUniform, SHADOW_SIZE_PX, ShadowView, normals_part,
};
use super::pass::{
    self, BlurInputs, GeometryInputs, GeometryTargets, LightingInputs, OcclusionInputs,
};
use super::plan::{FramePlan, PassKind};
use super::readback::{FloatImage, Readback};
use super::targets::Targets;
use super::timestamps::Timestamps;
use super::upload::GpuScene;
use super::{Gpu, RenderError};
use crate::scene::Geometry;
use crate::stimulus::manifest::{PassRecord, Picture};

/// Draws frames on one adapter.
pub struct Renderer {
    gpu: Gpu,
}

/// A drawn frame.
#[derive(Debug, Clone)]
pub struct RenderedFrame {
    /// The image.
    pub picture: Picture,
    /// The occlusion coefficient k_A after the blur, 1 is open; `None` where no technique ran.
    pub occlusion: Option<FloatImage>,
    /// What ran, in order, and what it took.
    pub passes: Vec<PassRecord>,
}

impl Renderer {
    /// A renderer on an open adapter.
    #[must_use]
    pub fn new(gpu: Gpu) -> Self {
        Self { gpu }
    }

    /// The adapter.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Puts a scene's surfaces on the GPU.
    ///
    /// # Errors
    /// As [`GpuScene::upload`].
    pub fn upload(&self, geometry: &Geometry) -> Result<GpuScene, RenderError> {
        GpuScene::upload(&self.gpu, geometry)
    }

    /// Draws one frame.
    ///
    /// # Errors
    /// [`RenderError::Unsuitable`] if the adapter's textures are too small for it,
    /// [`RenderError::Device`] if the driver fails.
    pub fn render(
        &self,
        scene: &GpuScene,
        request: &FrameRequest,
    ) -> Result<RenderedFrame, RenderError> {
        self.check_size(request)?;
        let memory = self
            .gpu
            .device
            .push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self
            .gpu
            .device
            .push_error_scope(wgpu::ErrorFilter::Validation);
        let frame = self.draw(scene, request);
        let errors = [
            pollster::block_on(validation.pop()),
            pollster::block_on(memory.pop()),
        ];
        match errors.into_iter().flatten().next() {
            Some(error) => Err(RenderError::Device(error.to_string())),
            None => frame,
        }
    }

    fn check_size(&self, request: &FrameRequest) -> Result<(), RenderError> {
        let largest = self.gpu.device.limits().max_texture_dimension_2d;
        let (width_px, height_px) = request.shaded_size();
        if width_px == 0 || height_px == 0 {
            return Err(RenderError::Request(String::from(
                "an image needs at least one pixel",
            )));
        }
        if width_px.max(height_px).max(SHADOW_SIZE_PX) > largest {
            return Err(RenderError::Unsuitable {
                adapter: self.gpu.adapter.name.clone(),
                message: format!(
                    "an image of {}×{} with {}×{} samples a pixel needs textures of {width_px}×{height_px}, it takes {largest}; \
                     ask for a smaller image or fewer samples",
                    request.width_px,
                    request.height_px,
                    request.supersampling,
                    request.supersampling
                ),
            });
        }
        Ok(())
    }

    fn draw(&self, scene: &GpuScene, request: &FrameRequest) -> Result<RenderedFrame, RenderError> {
        let plan = FramePlan::new(request, scene.facts);
        let frame = FrameInFlight::new(&self.gpu, scene, request, &plan);
        let timestamps = Timestamps::new(&self.gpu, plan.passes.len());
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (index, planned) in plan.passes.iter().enumerate() {
            if let Some(timestamps) = &timestamps {
                timestamps.mark(&mut encoder, index, false);
            }
            frame.record(&mut encoder, planned.kind);
            if let Some(timestamps) = &timestamps {
                timestamps.mark(&mut encoder, index, true);
            }
        }
        if let Some(timestamps) = &timestamps {
            timestamps.resolve(&mut encoder);
        }
        let image = Readback::record(&self.gpu, &mut encoder, frame.targets.image.texture());
        let occlusion = frame
            .targets
            .occlusion
            .as_ref()
            .map(|view| Readback::record(&self.gpu, &mut encoder, view.texture()));
        self.gpu.queue.submit([encoder.finish()]);
        let times = timestamps.and_then(|timestamps| timestamps.read(&self.gpu));
        Ok(RenderedFrame {
            picture: Picture {
                width_px: request.width_px,
                height_px: request.height_px,
                rgba8: image.read(&self.gpu)?,
            },
            occlusion: occlusion
                .map(|copy| copy.read_floats(&self.gpu))
                .transpose()?,
            passes: plan
                .passes
                .iter()
                .enumerate()
                .map(|(index, planned)| PassRecord {
                    pass: planned.kind.name().to_owned(),
                    gpu_ms: times.as_ref().map(|times| times[index]),
                })
                .collect(),
        })
    }
}

/// Everything the passes of one frame share.
struct FrameInFlight<'a> {
    gpu: &'a Gpu,
    scene: &'a GpuScene,
    request: &'a FrameRequest,
    normals_part: (&'static str, &'static str),
    targets: Targets,
    /// Frame numbers at the shaded size, and at the image's.
    shaded_frame: wgpu::Buffer,
    image_frame: wgpu::Buffer,
    shadow_view: Option<ShadowView>,
}

impl<'a> FrameInFlight<'a> {
    fn new(gpu: &'a Gpu, scene: &'a GpuScene, request: &'a FrameRequest, plan: &FramePlan) -> Self {
        let frame = |size| uniform_of(&gpu.device, "frame", &[FrameUniform::new(request, size)]);
        let shadow_view = match (&request.lighting.sun, scene.bounds_m) {
            (Some(sun), Some(bounds_m)) if plan.has(PassKind::ShadowMap) => {
                Some(ShadowView::new(sun.towards, bounds_m))
            }
            _ => None,
        };
        Self {
            gpu,
            scene,
            request,
            normals_part: normals_part(plan, request.precision),
            targets: Targets::new(gpu, request, plan),
            shaded_frame: frame(request.shaded_size()),
            image_frame: frame((request.width_px, request.height_px)),
            shadow_view,
        }
    }

    /// Depth and normals that occlusion reads.
    fn occlusion_inputs(&self) -> Option<(&wgpu::TextureView, &wgpu::TextureView)> {
        match &self.targets.occlusion_surfaces {
            Some((depth_m, normals, _)) => Some((depth_m, normals)),
            None => Some((&self.targets.depth_m, self.targets.normals.as_ref()?)),
        }
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, kind: PassKind) {
        // Every target below is there whenever the plan has the pass that uses it.
        match kind {
            PassKind::ShadowMap => self.shadow_map(encoder),
            PassKind::Geometry => self.geometry(encoder),
            PassKind::OcclusionGeometry => self.occlusion_geometry(encoder),
            PassKind::Occlusion => self.occlusion(encoder),
            PassKind::BlurRows => {
                self.blur(
                    encoder,
                    [1, 0],
                    &self.targets.occlusion,
                    &self.targets.half_blurred,
                );
            }
            PassKind::BlurColumns => {
                self.blur(
                    encoder,
                    [0, 1],
                    &self.targets.half_blurred,
                    &self.targets.occlusion,
                );
            }
            PassKind::Lighting => self.lighting(encoder),
            PassKind::Output => pass::output(
                self.gpu,
                encoder,
                &self.request.lighting,
                self.request.supersampling,
                &self.targets.radiance,
                &self.targets.image,
            ),
        }
    }

    fn shadow_map(&self, encoder: &mut wgpu::CommandEncoder) {
        if let (Some(view), Some(target)) = (&self.shadow_view, &self.targets.shadow) {
            pass::shadow_map(self.gpu, encoder, self.scene, view, target);
        }
    }

    fn geometry_inputs<'b>(&self, frame: &'b wgpu::Buffer) -> GeometryInputs<'b> {
        GeometryInputs {
            frame,
            normals_part: match self.normals_part {
                // The geometry shader composes whole; without a normals target its flat entry
                // point runs, which uses none of this part.
                _ if self.targets.normals.is_none() => {
                    ("normals", include_str!("shaders/normals_full.wgsl"))
                }
                part => part,
            },
            far_m: self.request.camera.far_m,
        }
    }

    fn geometry(&self, encoder: &mut wgpu::CommandEncoder) {
        let targets = GeometryTargets {
            albedo: Some(&self.targets.albedo),
            depth_m: &self.targets.depth_m,
            normals: self.targets.normals.as_ref(),
            depth_test: &self.targets.depth_test,
        };
        let inputs = self.geometry_inputs(&self.shaded_frame);
        pass::geometry(self.gpu, encoder, self.scene, &inputs, &targets);
    }

    fn occlusion_geometry(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some((depth_m, normals, depth_test)) = &self.targets.occlusion_surfaces else {
            return;
        };
        let targets = GeometryTargets {
            albedo: None,
            depth_m,
            normals: Some(normals),
            depth_test,
        };
        let inputs = self.geometry_inputs(&self.image_frame);
        pass::occlusion_geometry(self.gpu, encoder, self.scene, &inputs, &targets);
    }

    fn occlusion(&self, encoder: &mut wgpu::CommandEncoder) {
        let (Some((depth_m, normals)), Some(target)) =
            (self.occlusion_inputs(), &self.targets.occlusion)
        else {
            return;
        };
        let inputs = OcclusionInputs {
            frame: &self.image_frame,
            depth_m,
            normals,
            normals_part: self.normals_part,
            seed: self.request.seed,
        };
        pass::occlusion(self.gpu, encoder, &self.request.occlusion, &inputs, target);
    }

    fn blur(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        direction: [i32; 2],
        from: &Option<wgpu::TextureView>,
        to: &Option<wgpu::TextureView>,
    ) {
        let (Some((depth_m, normals)), Some(from), Some(to)) = (self.occlusion_inputs(), from, to)
        else {
            return;
        };
        let inputs = BlurInputs {
            frame: &self.image_frame,
            depth_m,
            normals,
            normals_part: self.normals_part,
            occlusion: from,
            radius_px: self.request.blur_radius_px,
            plane_m: self.request.blur_plane_m,
        };
        pass::blur(self.gpu, encoder, &inputs, direction, to);
    }

    fn lighting(&self, encoder: &mut wgpu::CommandEncoder) {
        let occlusion = match (&self.targets.occlusion, self.occlusion_inputs()) {
            (Some(occlusion), Some((depth_m, _))) => Some((occlusion, depth_m)),
            _ => None,
        };
        let inputs = LightingInputs {
            frame: &self.shaded_frame,
            albedo: &self.targets.albedo,
            depth_m: &self.targets.depth_m,
            normals: self.targets.normals.as_ref(),
            normals_part: self.normals_part,
            occlusion,
            shadow: self.targets.shadow.as_ref(),
            light: LightUniform::new(&self.request.lighting, self.shadow_view),
        };
        pass::lighting(
            self.gpu,
            encoder,
            &self.request.lighting,
            &inputs,
            &self.targets.radiance,
        );
    }
}
