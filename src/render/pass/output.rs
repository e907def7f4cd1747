//! To the image's bytes: from radiance, or at once from surfaces in plain ambient light.

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::LightInputs;
use super::fullscreen::{Fullscreen, Onto};
use crate::scene::{Lighting, ToneMap};

/// The WGSL struct `Display`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DisplayUniform {
    exposure: f32,
    white: f32,
    samples: i32,
    unused: f32,
}

impl DisplayUniform {
    fn new(lighting: &Lighting, supersampling: u32) -> Self {
        Self {
            exposure: lighting.exposure_ev.exp2(),
            white: match lighting.tone_map {
                ToneMap::ReinhardExtended { white } => white,
                ToneMap::None | ToneMap::Aces => 1.0,
            },
            samples: supersampling as i32,
            unused: 0.0,
        }
    }
}

fn tone_map_part(lighting: &Lighting) -> (&'static str, &'static str) {
    let curve = match lighting.tone_map {
        ToneMap::None => include_str!("../shaders/tone_map/none.wgsl"),
        ToneMap::Aces => include_str!("../shaders/tone_map/aces.wgsl"),
        ToneMap::ReinhardExtended { .. } => {
            include_str!("../shaders/tone_map/reinhard_extended.wgsl")
        }
    };
    ("tone_map", curve)
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
    let display = DisplayUniform::new(lighting, supersampling);
    let settings = uniform_of(&gpu.device, "output", &[display]);
    let bound = Bindings::default()
        .texture(1, radiance, false)
        .uniform(11, &settings)
        .build(&gpu.device, "output");
    Fullscreen {
        label: "output",
        source: include_str!("../shaders/output.wgsl"),
        variants: &[tone_map_part(lighting)],
        fragment: "fs_output",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::BLACK),
    }
    .draw(gpu, encoder, target);
}

/// Shades surfaces in ambient light and encodes them into `target`, without a radiance target.
pub(in super::super) fn shade(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    lighting: &Lighting,
    supersampling: u32,
    inputs: &LightInputs,
    target: &wgpu::TextureView,
) {
    let display = DisplayUniform::new(lighting, supersampling);
    let settings = uniform_of(&gpu.device, "shade", &[display]);
    let bound = inputs.bind_ambient(gpu, &settings);
    let variants: Vec<_> = inputs
        .parts()
        .into_iter()
        .chain([tone_map_part(lighting)])
        .collect();
    Fullscreen {
        label: "shade",
        source: include_str!("../shaders/shade.wgsl"),
        variants: &variants,
        fragment: "fs_shade",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::BLACK),
    }
    .draw(gpu, encoder, target);
}
