//! A pass that covers its whole target with one shader.

use super::super::bindings::Bound;
use super::super::{Gpu, shader};

/// What becomes of what the target held.
#[derive(Debug, Clone, Copy)]
pub(super) enum Onto {
    /// It goes: the target is this colour wherever the shader writes nothing.
    Cleared(wgpu::Color),
    /// The shader's colour is added to it.
    Added,
}

/// One shader over a whole target.
pub(super) struct Fullscreen<'a> {
    pub label: &'a str,
    pub source: &'a str,
    pub variants: &'a [(&'a str, &'a str)],
    pub fragment: &'a str,
    pub bound: &'a Bound,
    pub onto: Onto,
}

/// A shader with everything it needs, ready to be recorded any number of times.
pub(in super::super) struct Drawable {
    label: String,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    targets: Vec<wgpu::TextureView>,
    load: wgpu::LoadOp<wgpu::Color>,
}

impl Drawable {
    /// Records it.
    pub(in super::super) fn draw(&self, encoder: &mut wgpu::CommandEncoder) {
        let attachments: Vec<_> = (self.targets.iter())
            .map(|view| {
                Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: self.load,
                        store: wgpu::StoreOp::Store,
                    },
                })
            })
            .collect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.label),
            color_attachments: &attachments,
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl Fullscreen<'_> {
    pub(super) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
    ) {
        self.prepare(gpu, &[target]).draw(encoder);
    }

    /// Compiles it for targets that it writes at once.
    pub(super) fn prepare(&self, gpu: &Gpu, targets: &[&wgpu::TextureView]) -> Drawable {
        let formats: Vec<_> = targets.iter().map(|view| view.texture().format()).collect();
        Drawable {
            label: self.label.to_owned(),
            pipeline: self.pipeline(gpu, &formats),
            group: self.bound.group.clone(),
            targets: targets.iter().map(|&view| view.clone()).collect(),
            load: match self.onto {
                Onto::Cleared(colour) => wgpu::LoadOp::Clear(colour),
                Onto::Added => wgpu::LoadOp::Load,
            },
        }
    }

    fn pipeline(&self, gpu: &Gpu, formats: &[wgpu::TextureFormat]) -> wgpu::RenderPipeline {
        let module = shader::module(&gpu.device, self.label, self.source, self.variants);
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(self.label),
                bind_group_layouts: &[Some(&self.bound.layout)],
                immediate_size: 0,
            });
        let sum = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Add,
        };
        let targets: Vec<_> = formats
            .iter()
            .map(|&format| {
                Some(wgpu::ColorTargetState {
                    format,
                    blend: match self.onto {
                        Onto::Cleared(_) => None,
                        Onto::Added => Some(wgpu::BlendState {
                            color: sum,
                            alpha: sum,
                        }),
                    },
                    write_mask: wgpu::ColorWrites::ALL,
                })
            })
            .collect();
        gpu.device
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
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
