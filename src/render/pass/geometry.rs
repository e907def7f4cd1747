//! Surfaces to targets.

use std::collections::HashMap;

use super::super::bindings::Bindings;
use super::super::frame::Formats;
use super::super::material::{GpuMaterial, MaterialShape};
use super::super::upload::GpuScene;
use super::super::{Gpu, RenderError, readback, shader};
use super::mesh::{Attributes, MeshPipeline};
use super::{cleared, cleared_depth};

/// What the geometry pass writes to.
pub(in super::super) struct GeometryTargets<'a> {
    pub albedo: &'a wgpu::TextureView,
    pub depth_m: &'a wgpu::TextureView,
    /// Absent where nothing reads normals.
    pub normals: Option<&'a wgpu::TextureView>,
    /// Absent where nothing reads what surfaces send out, or their baked occlusion.
    pub emission: Option<&'a wgpu::TextureView>,
    /// The hardware's depth test.
    pub depth_test: &'a wgpu::TextureView,
}

impl GeometryTargets<'_> {
    /// The colour attachments that are there, in the order of the shader's outputs. No surface
    /// is as far as can be.
    fn attachments(&self, far_m: f32) -> Vec<Option<wgpu::RenderPassColorAttachment<'_>>> {
        let nothing = f64::from(far_m);
        let no_surface = wgpu::Color {
            r: nothing,
            g: nothing,
            b: nothing,
            a: nothing,
        };
        [
            Some(cleared(self.albedo, wgpu::Color::BLACK)),
            Some(cleared(self.depth_m, no_surface)),
            self.normals
                .map(|view| cleared(view, wgpu::Color::TRANSPARENT)),
            self.emission.map(|view| cleared(view, wgpu::Color::BLACK)),
        ]
        .into_iter()
        .filter(Option::is_some)
        .collect()
    }

    /// The shader's entry point that writes them.
    fn fragment(&self) -> &'static str {
        match (self.normals, self.emission) {
            (None, None) => "fs_flat",
            (None, Some(_)) => "fs_flat_emitting",
            (Some(_), None) => "fs_full",
            (Some(_), Some(_)) => "fs_full_emitting",
        }
    }
}

/// The frame's numbers, shader parts and materials for the geometry pass.
pub(in super::super) struct GeometryInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub normals_part: (&'static str, &'static str),
    pub materials: &'a [GpuMaterial],
    pub far_m: f32,
}

/// Draws the surfaces that are shaded.
pub(in super::super) fn geometry(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    scene: &GpuScene,
    inputs: &GeometryInputs,
    targets: &GeometryTargets,
) {
    let frame = Bindings::default()
        .uniform(0, inputs.frame)
        .build(&gpu.device, "geometry");
    let attachments = targets.attachments(inputs.far_m);
    let formats: Vec<_> = attachments
        .iter()
        .flatten()
        .map(|attachment| Some(attachment.view.texture().format().into()))
        .collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("geometry"),
        color_attachments: &attachments,
        depth_stencil_attachment: Some(cleared_depth(targets.depth_test, 0.0)),
        ..wgpu::RenderPassDescriptor::default()
    });
    pass.set_bind_group(0, &frame.group, &[]);
    let mut pipelines: HashMap<MaterialShape, wgpu::RenderPipeline> = HashMap::new();
    for mesh in &scene.meshes {
        let material = &inputs.materials[mesh.material];
        let pipeline = pipelines.entry(material.shape).or_insert_with(|| {
            let variants: Vec<_> = [inputs.normals_part]
                .into_iter()
                .chain(material.shape.parts())
                .collect();
            MeshPipeline {
                label: "geometry",
                source: include_str!("../shaders/geometry.wgsl"),
                variants: &variants,
                fragment: Some(targets.fragment()),
                attributes: Attributes::All,
                groups: &[&frame, &material.bound],
                targets: &formats,
                cull_mode: (!material.shape.double_sided).then_some(wgpu::Face::Back),
                // Reversed depth: nearer is greater.
                depth_compare: wgpu::CompareFunction::Greater,
            }
            .make(gpu)
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(1, &material.bound.group, &[]);
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..mesh.index_count, 0, 0..1);
    }
}

/// Whether any texel of a drawn depth test shows no surface: an occlusion query of a triangle
/// over the whole target, at the far end.
///
/// # Errors
/// [`RenderError::Device`] if the driver fails.
pub(in super::super) fn is_uncovered(
    gpu: &Gpu,
    depth_test: &wgpu::TextureView,
) -> Result<bool, RenderError> {
    let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
        label: Some("uncovered"),
        ty: wgpu::QueryType::Occlusion,
        count: 1,
    });
    let buffer = |usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("uncovered"),
            size: 8,
            usage,
            mapped_at_creation: false,
        })
    };
    let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
    let readable = buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
    let pipeline = far_end_pipeline(gpu);
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("uncovered"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth_test,
                depth_ops: None,
                stencil_ops: None,
            }),
            occlusion_query_set: Some(&queries),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&pipeline);
        pass.begin_occlusion_query(0);
        pass.draw(0..3, 0..1);
        pass.end_occlusion_query();
    }
    encoder.resolve_query_set(&queries, 0..1, &resolved, 0);
    encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, 8);
    gpu.queue.submit([encoder.finish()]);
    Ok(readback::map(gpu, &readable)?.iter().any(|&byte| byte != 0))
}

fn far_end_pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
    let module = shader::module(&gpu.device, "uncovered", "//!use fullscreen", &[]);
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("uncovered"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_fullscreen"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: Formats::DEPTH_TEST,
                depth_write_enabled: Some(false),
                // The far end of reversed depth is 0: any surface is greater.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}
