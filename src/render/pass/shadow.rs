//! Depth from the directional light.

use super::super::bindings::{Bindings, uniform_of};
use super::super::frame::{Formats, ShadowView};
use super::super::upload::GpuScene;
use super::super::{Gpu, shader};
use super::cleared_depth;

/// Draws every surface's depth, seen from the light, into `target`.
pub(in super::super) fn shadow_map(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    scene: &GpuScene,
    view: &ShadowView,
    target: &wgpu::TextureView,
) {
    let matrix = uniform_of(&gpu.device, "shadow view", &[view.from_world]);
    let bound = Bindings::default()
        .uniform(0, &matrix)
        .build(&gpu.device, "shadow map");
    let pipeline = pipeline(gpu, &bound.layout);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow map"),
        color_attachments: &[],
        depth_stencil_attachment: Some(cleared_depth(target, 1.0, wgpu::StoreOp::Store)),
        ..wgpu::RenderPassDescriptor::default()
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bound.group, &[]);
    for mesh in &scene.meshes {
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..mesh.index_count, 0, 0..1);
    }
}

fn pipeline(gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
    let source = include_str!("../shaders/shadow.wgsl");
    let module = shader::module(&gpu.device, "shadow map", source, &[]);
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map"),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shadow map"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_shadow"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<crate::scene::Vertex>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
                })],
            },
            // Both sides cast: a drape is one sheet.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: Formats::DEPTH_TEST,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}
