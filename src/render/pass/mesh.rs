//! Pipelines that draw the scene's triangles.

use super::super::bindings::Bound;
use super::super::frame::Formats;
use super::super::{Gpu, shader};

/// What of a mesh's vertices a pipeline reads.
#[derive(Debug, Clone, Copy)]
pub(super) enum Attributes {
    /// Positions alone.
    Positions,
    /// All of [`crate::scene::Vertex`].
    All,
}

/// A pipeline for triangles.
pub(super) struct MeshPipeline<'a> {
    pub label: &'a str,
    pub source: &'a str,
    pub variants: &'a [(&'a str, &'a str)],
    /// Absent where only depth is written.
    pub fragment: Option<&'a str>,
    pub attributes: Attributes,
    /// The frame's bind group, then the material's, if it is read.
    pub groups: &'a [&'a Bound],
    pub targets: &'a [Option<wgpu::ColorTargetState>],
    pub cull_mode: Option<wgpu::Face>,
    pub depth_compare: wgpu::CompareFunction,
}

impl MeshPipeline<'_> {
    pub(super) fn make(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let module = shader::module(&gpu.device, self.label, self.source, self.variants);
        let layouts: Vec<_> = self
            .groups
            .iter()
            .map(|bound| Some(&bound.layout))
            .collect();
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(self.label),
                bind_group_layouts: &layouts,
                immediate_size: 0,
            });
        let attributes: &[wgpu::VertexAttribute] = match self.attributes {
            Attributes::Positions => &wgpu::vertex_attr_array![0 => Float32x3],
            Attributes::All => &wgpu::vertex_attr_array![
                0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2, 4 => Float32x4
            ],
        };
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(self.label),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vs_geometry"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[Some(wgpu::VertexBufferLayout {
                        array_stride: size_of::<crate::scene::Vertex>() as u64,
                        step_mode: wgpu::VertexStepMode::Vertex,
                        attributes,
                    })],
                },
                primitive: wgpu::PrimitiveState {
                    cull_mode: self.cull_mode,
                    ..wgpu::PrimitiveState::default()
                },
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: Formats::DEPTH_TEST,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(self.depth_compare),
                    stencil: wgpu::StencilState::default(),
                    bias: wgpu::DepthBiasState::default(),
                }),
                multisample: wgpu::MultisampleState::default(),
                fragment: self.fragment.map(|entry_point| wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: self.targets,
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
