//! The edge-aware blur of the occlusion.

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::fullscreen::{Fullscreen, Onto};

/// The WGSL struct `Blur`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct BlurUniform {
    direction: [i32; 2],
    radius_px: i32,
    plane_m: f32,
}

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

/// Blurs along `direction` (one pixel step) into `target`.
pub(in super::super) fn blur(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    inputs: &BlurInputs,
    direction: [i32; 2],
    target: &wgpu::TextureView,
) {
    let uniform = BlurUniform {
        direction,
        radius_px: inputs.radius_px as i32,
        plane_m: inputs.plane_m,
    };
    let settings = uniform_of(&gpu.device, "blur", &[uniform]);
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .texture(3, inputs.occlusion, false)
        .uniform(4, &settings)
        .build(&gpu.device, "blur");
    Fullscreen {
        label: "occlusion blur",
        source: include_str!("../shaders/blur.wgsl"),
        variants: &[inputs.normals_part],
        fragment: "fs_blur",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::TRANSPARENT),
    }
    .draw(gpu, encoder, target);
}
