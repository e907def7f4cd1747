//! The passes: each one file that makes its pipeline, binds its inputs and draws.

mod blur;
mod geometry;
mod lighting;
mod occlusion;
mod output;
mod shadow;

pub(super) use blur::{BlurInputs, blur};
pub(super) use geometry::{GeometryInputs, GeometryTargets, geometry, occlusion_geometry};
pub(super) use lighting::{LightingInputs, lighting};
pub(super) use occlusion::{OcclusionInputs, occlusion};
pub(super) use output::output;
pub(super) use shadow::shadow_map;

use super::bindings::Bound;
use super::{Gpu, shader};

/// A pass that covers its whole target with one shader.
struct Fullscreen<'a> {
    label: &'a str,
    source: &'a str,
    variants: &'a [(&'a str, &'a str)],
    fragment: &'a str,
    bound: &'a Bound,
}

impl Fullscreen<'_> {
    fn draw(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) {
        let module = shader::module(&gpu.device, self.label, self.source, self.variants);
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(self.label),
                bind_group_layouts: &[Some(&self.bound.layout)],
                immediate_size: 0,
            });
        let pipeline = gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(self.label),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vs_fullscreen"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(self.fragment),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(target.texture().format().into())],
                }),
                multiview_mask: None,
                cache: None,
            });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(cleared(target, wgpu::Color::TRANSPARENT))],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &self.bound.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn cleared(view: &wgpu::TextureView, colour: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(colour),
            store: wgpu::StoreOp::Store,
        },
    }
}

fn cleared_depth(
    view: &wgpu::TextureView,
    depth: f32,
    store: wgpu::StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(depth),
            store,
        }),
        stencil_ops: None,
    }
}
