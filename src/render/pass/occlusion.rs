//! The technique's own pass.

use wgpu::util::DeviceExt;

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::super::technique::{self, Settings};
use super::fullscreen::{Drawable, Fullscreen, Onto};
use super::light::sun_visibility_part;

/// What techniques are given, each what it declares.
pub(in super::super) struct OcclusionInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: &'a wgpu::TextureView,
    pub normals_part: (&'static str, &'static str),
    pub bounded_part: (&'static str, &'static str),
    pub albedo: &'a wgpu::TextureView,
    pub light: &'a wgpu::Buffer,
    /// How much of the directional light arrives.
    pub visibility: Option<&'a wgpu::TextureView>,
    /// Spheres in place of the triangles: centre and radius, world space, metres.
    pub proxies: &'a [[f32; 4]],
    pub seed: u64,
}

/// What a technique writes.
pub(in super::super) struct OcclusionTargets<'a> {
    pub occlusion: &'a wgpu::TextureView,
    /// What the ambient light changes by, for a technique that reads light.
    pub directional: Option<&'a wgpu::TextureView>,
    /// What is closed by direction, for a frame that has the bent cone, and then in place of the above.
    pub cone: Option<&'a wgpu::TextureView>,
}

/// The technique of `settings`, ready to be drawn; `None` for one without a shader.
pub(in super::super) fn occlusion(
    gpu: &Gpu,
    settings: &Settings,
    inputs: &OcclusionInputs,
    targets: &OcclusionTargets,
) -> Option<Drawable> {
    let technique = settings.technique;
    let source = technique.shader?;
    let params = settings.wgsl();
    let noise = uniform_of(
        &gpu.device,
        "noise tile",
        &technique::noise_tile(inputs.seed),
    );
    let points = (technique.kernel)(settings, inputs.seed);
    let kernel = vectors(gpu, "occlusion kernel", &points);
    let proxies = vectors(gpu, "proxies", inputs.proxies);
    // Nearest, clamped to the edge.
    let nearest = (gpu.device).create_sampler(&wgpu::SamplerDescriptor::default());
    let mut bindings = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .storage(21, &kernel)
        .uniform(22, &noise)
        .sampler(24, &nearest, wgpu::SamplerBindingType::NonFiltering);
    if technique.inputs.light {
        bindings = bindings
            .texture(3, inputs.albedo, false)
            .uniform(4, inputs.light)
            .texture_if_any(8, inputs.visibility);
    }
    if technique.inputs.proxies {
        bindings = bindings.storage(23, &proxies);
    }
    let bound = bindings.build(&gpu.device, technique.name);
    let variants: Vec<_> = technique::SHARED_WGSL
        .iter()
        .copied()
        .chain([("params", params.as_str()), inputs.bounded_part])
        .chain([inputs.normals_part, sun_visibility_part(inputs.visibility)])
        .collect();
    let fragment = match targets.cone {
        Some(_) => "fs_opening",
        None => "fs_occlusion",
    };
    let targets: Vec<_> = [
        Some(targets.occlusion),
        targets.directional.or(targets.cone),
    ]
    .into_iter()
    .flatten()
    .collect();
    let shader = Fullscreen {
        label: technique.name,
        source,
        variants: &variants,
        fragment,
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::TRANSPARENT),
    };
    Some(shader.prepare(gpu, &targets))
}

/// A storage buffer of vectors. It cannot be empty: without any there is one of nought.
fn vectors(gpu: &Gpu, label: &str, vectors: &[[f32; 4]]) -> wgpu::Buffer {
    let contents = if vectors.is_empty() {
        &[[0.0; 4]]
    } else {
        vectors
    };
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents: bytemuck::cast_slice(contents),
            usage: wgpu::BufferUsages::STORAGE,
        })
}
