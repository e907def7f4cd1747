//! The edge-aware blur of the occlusion.

use super::super::Gpu;
use super::super::bindings::Bindings;
use super::fullscreen::{Drawable, Fullscreen, Onto};

/// What the blur reads.
pub(in super::super) struct BlurInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: &'a wgpu::TextureView,
    pub normals_part: (&'static str, &'static str),
    pub occlusion: &'a wgpu::TextureView,
    pub radius_px: u32,
    pub plane_m: f32,
}

/// The blur along `direction` (one pixel step) into `target`, ready to be drawn.
pub(in super::super) fn blur(
    gpu: &Gpu,
    inputs: &BlurInputs,
    direction: [i32; 2],
    target: &wgpu::TextureView,
) -> Drawable {
    // Constants, so that its loop unrolls.
    let settings = format!(
        "const direction = vec2i({}, {});\nconst radius_px = {};\nconst plane_m = {:?}f;\n",
        direction[0], direction[1], inputs.radius_px, inputs.plane_m
    );
    // Nearest, clamped to the edge.
    let nearest = (gpu.device).create_sampler(&wgpu::SamplerDescriptor::default());
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .texture(3, inputs.occlusion, false)
        .sampler(4, &nearest, wgpu::SamplerBindingType::NonFiltering)
        .build(&gpu.device, "blur");
    Fullscreen {
        label: "occlusion blur",
        source: include_str!("../shaders/blur.wgsl"),
        variants: &[inputs.normals_part, ("blur_settings", &settings)],
        fragment: "fs_blur",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::TRANSPARENT),
    }
    .prepare(gpu, &[target])
}
