//! From radiance to the image's bytes.

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::Fullscreen;
use crate::scene::{Lighting, ToneMap};

/// The WGSL struct `Output`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct OutputUniform {
    exposure: f32,
    white: f32,
    samples: i32,
    unused: f32,
}

/// Tone-maps, averages and encodes `radiance` into `target`.
pub(in super::super) fn output(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    lighting: &Lighting,
    supersampling: u32,
    radiance: &wgpu::TextureView,
    target: &wgpu::TextureView,
) {
    let (curve, white) = match lighting.tone_map {
        ToneMap::None => (include_str!("../shaders/tone_map/none.wgsl"), 1.0),
        ToneMap::Aces => (include_str!("../shaders/tone_map/aces.wgsl"), 1.0),
        ToneMap::ReinhardExtended { white } => (
            include_str!("../shaders/tone_map/reinhard_extended.wgsl"),
            white,
        ),
    };
    let uniform = OutputUniform {
        exposure: lighting.exposure_ev.exp2(),
        white,
        samples: supersampling as i32,
        unused: 0.0,
    };
    let settings = uniform_of(&gpu.device, "output", &[uniform]);
    let bound = Bindings::default()
        .uniform(0, &settings)
        .texture(1, radiance, false)
        .build(&gpu.device, "output");
    Fullscreen {
        label: "output",
        source: include_str!("../shaders/output.wgsl"),
        variants: &[("tone_map", curve)],
        fragment: "fs_output",
        bound: &bound,
    }
    .draw(gpu, encoder, target);
}
