//! The technique's own pass.

use wgpu::util::DeviceExt;

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::super::technique::{self, Settings};
use super::fullscreen::{Fullscreen, Onto};

/// What every technique is given.
pub(in super::super) struct OcclusionInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: &'a wgpu::TextureView,
    pub normals_part: (&'static str, &'static str),
    pub seed: u64,
}

/// Runs the technique of `settings` into `target`; nothing for one without a shader.
pub(in super::super) fn occlusion(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    settings: &Settings,
    inputs: &OcclusionInputs,
    target: &wgpu::TextureView,
) {
    let Some(source) = settings.technique.shader else {
        return;
    };
    let params = uniform_of(&gpu.device, "occlusion parameters", &settings.uniform());
    let noise = uniform_of(
        &gpu.device,
        "noise tile",
        &technique::noise_tile(inputs.seed),
    );
    let mut points = (settings.technique.kernel)(settings, inputs.seed);
    if points.is_empty() {
        // A buffer cannot be empty; a technique without points reads none.
        points.push([0.0; 4]);
    }
    let kernel = gpu
        .device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("occlusion kernel"),
            contents: bytemuck::cast_slice(&points),
            usage: wgpu::BufferUsages::STORAGE,
        });
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .uniform(3, &params)
        .storage(4, &kernel)
        .uniform(5, &noise)
        .build(&gpu.device, settings.technique.name);
    let variants: Vec<_> = technique::SHARED_WGSL
        .iter()
        .copied()
        .chain([inputs.normals_part])
        .collect();
    Fullscreen {
        label: settings.technique.name,
        source,
        variants: &variants,
        fragment: "fs_occlusion",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::TRANSPARENT),
    }
    .draw(gpu, encoder, target);
}
