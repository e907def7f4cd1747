//! Shadows of the directional light: depth seen from it, and how much of it arrives.

use std::collections::HashMap;

use super::super::Gpu;
use super::super::bindings::Bindings;
use super::super::material::{GpuMaterial, MaterialShape};
use super::super::upload::GpuScene;
use super::cleared_depth;
use super::fullscreen::{Fullscreen, Onto};
use super::mesh::{Attributes, MeshPipeline};

/// Draws every surface's depth, seen from the light that `frame` is seen by, into `target`.
pub(in super::super) fn shadow_map(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    scene: &GpuScene,
    materials: &[GpuMaterial],
    frame: &wgpu::Buffer,
    target: &wgpu::TextureView,
) {
    let frame = Bindings::default()
        .uniform(0, frame)
        .build(&gpu.device, "shadow map");
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow map"),
        color_attachments: &[],
        depth_stencil_attachment: Some(cleared_depth(target, 1.0)),
        ..wgpu::RenderPassDescriptor::default()
    });
    pass.set_bind_group(0, &frame.group, &[]);
    let solid = MeshPipeline {
        label: "shadow map",
        source: include_str!("../shaders/shadow.wgsl"),
        variants: &[],
        fragment: None,
        attributes: Attributes::Positions,
        groups: &[&frame],
        targets: &[],
        // Both sides cast: a drape is one sheet.
        cull_mode: None,
        depth_compare: wgpu::CompareFunction::Less,
    };
    let solid = solid.make(gpu);
    let mut masked: HashMap<MaterialShape, wgpu::RenderPipeline> = HashMap::new();
    for mesh in &scene.meshes {
        let material = &materials[mesh.material];
        if material.shape.masked {
            let pipeline = masked.entry(material.shape).or_insert_with(|| {
                MeshPipeline {
                    label: "shadow map",
                    source: include_str!("../shaders/shadow_masked.wgsl"),
                    variants: &material.shape.parts(),
                    fragment: Some("fs_shadow"),
                    attributes: Attributes::All,
                    groups: &[&frame, &material.bound],
                    targets: &[],
                    cull_mode: None,
                    depth_compare: wgpu::CompareFunction::Less,
                }
                .make(gpu)
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(1, &material.bound.group, &[]);
        } else {
            pass.set_pipeline(&solid);
        }
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..mesh.index_count, 0, 0..1);
    }
}

/// What the filter reads.
pub(in super::super) struct FilterInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub light: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: &'a wgpu::TextureView,
    pub normals_part: (&'static str, &'static str),
    pub shadow: &'a wgpu::TextureView,
}

/// Filters the shadow map into `target`: 1 where the light arrives whole.
pub(in super::super) fn shadow_filter(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    inputs: &FilterInputs,
    target: &wgpu::TextureView,
) {
    // For gathers, which read and do not mix.
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadow"),
        ..wgpu::SamplerDescriptor::default()
    });
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(2, inputs.normals, false)
        .uniform(4, inputs.light)
        .texture(8, inputs.shadow, false)
        .sampler(9, &sampler, wgpu::SamplerBindingType::NonFiltering)
        .build(&gpu.device, "shadow filter");
    Fullscreen {
        label: "shadow filter",
        source: include_str!("../shaders/lighting/shadow_filter.wgsl"),
        variants: &[inputs.normals_part],
        fragment: "fs_visibility",
        bound: &bound,
        onto: Onto::Cleared(wgpu::Color::WHITE),
    }
    .draw(gpu, encoder, target);
}
