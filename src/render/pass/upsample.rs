//! Occlusion of half resolution to the image's.

use super::super::Gpu;
use super::super::bindings::Bindings;
use super::fullscreen::{Drawable, Fullscreen, Onto};

/// What upsampling reads.
pub(in super::super) struct UpsampleInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: &'a wgpu::TextureView,
    pub normals_part: (&'static str, &'static str),
    /// At half the image's resolution.
    pub occlusion: &'a wgpu::TextureView,
}

/// What brings occlusion to every pixel of `target`, by the surface it belongs to, ready to be drawn.
pub(in super::super) fn upsample(
    gpu: &Gpu,
    inputs: &UpsampleInputs,
    target: &wgpu::TextureView,
) -> Drawable {
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .texture(4, inputs.occlusion, false)
        .build(&gpu.device, "occlusion upsampling");
    Fullscreen {
        label: "occlusion upsampling",
        source: include_str!("../shaders/upsample.wgsl"),
        variants: &[inputs.normals_part],
        fragment: "fs_upsample",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::TRANSPARENT),
    }
    .prepare(gpu, &[target])
}
