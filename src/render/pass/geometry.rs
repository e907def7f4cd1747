//! Surfaces to targets.

use super::super::bindings::{Bindings, Bound};
use super::super::frame::Formats;
use super::super::upload::GpuScene;
use super::super::{Gpu, shader};
use super::{cleared, cleared_depth};

/// What a geometry pass writes to.
pub(in super::super) struct GeometryTargets<'a> {
    /// Absent at the occlusion's own resolution.
    pub albedo: Option<&'a wgpu::TextureView>,
    pub depth_m: &'a wgpu::TextureView,
    /// Absent where nothing reads normals.
    pub normals: Option<&'a wgpu::TextureView>,
    /// The hardware's depth test.
    pub depth_test: &'a wgpu::TextureView,
}

/// The frame's numbers and shader parts for a geometry pass.
pub(in super::super) struct GeometryInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub normals_part: (&'static str, &'static str),
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
    let fragment = if targets.normals.is_some() {
        "fs_full"
    } else {
        "fs_flat"
    };
    draw(gpu, encoder, scene, inputs, targets, fragment);
}

/// Draws the depth and normals that occlusion reads.
pub(in super::super) fn occlusion_geometry(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    scene: &GpuScene,
    inputs: &GeometryInputs,
    targets: &GeometryTargets,
) {
    draw(gpu, encoder, scene, inputs, targets, "fs_occlusion_inputs");
}

fn draw(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    scene: &GpuScene,
    inputs: &GeometryInputs,
    targets: &GeometryTargets,
    fragment: &str,
) {
    let bound = Bindings::default()
        .uniform(0, inputs.frame)
        .build(&gpu.device, "geometry");
    let nothing = f64::from(inputs.far_m);
    let no_surface = wgpu::Color {
        r: nothing,
        g: nothing,
        b: nothing,
        a: nothing,
    };
    let attachments: Vec<_> = [
        targets.albedo.map(|view| cleared(view, wgpu::Color::BLACK)),
        Some(cleared(targets.depth_m, no_surface)),
        targets
            .normals
            .map(|view| cleared(view, wgpu::Color::TRANSPARENT)),
    ]
    .into_iter()
    .filter(Option::is_some)
    .collect();
    let formats: Vec<_> = attachments
        .iter()
        .flatten()
        .map(|attachment| Some(attachment.view.texture().format().into()))
        .collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("geometry"),
        color_attachments: &attachments,
        depth_stencil_attachment: Some(cleared_depth(
            targets.depth_test,
            0.0,
            wgpu::StoreOp::Discard,
        )),
        ..wgpu::RenderPassDescriptor::default()
    });
    // A scene without surfaces is its cleared targets. Bind group layouts are equal by content,
    // so the first material's serves all of them.
    let Some(material_layout) = scene.materials.first().map(|bound| &bound.layout) else {
        return;
    };
    let make = |cull| {
        pipeline(
            gpu,
            inputs,
            &bound,
            material_layout,
            fragment,
            &formats,
            cull,
        )
    };
    let (one_sided, double_sided) = (make(Some(wgpu::Face::Back)), make(None));
    pass.set_bind_group(0, &bound.group, &[]);
    for mesh in &scene.meshes {
        pass.set_pipeline(if mesh.double_sided {
            &double_sided
        } else {
            &one_sided
        });
        pass.set_bind_group(1, &scene.materials[mesh.material].group, &[]);
        pass.set_vertex_buffer(0, mesh.vertices.slice(..));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..mesh.index_count, 0, 0..1);
    }
}

fn pipeline(
    gpu: &Gpu,
    inputs: &GeometryInputs,
    bound: &Bound,
    material_layout: &wgpu::BindGroupLayout,
    fragment: &str,
    targets: &[Option<wgpu::ColorTargetState>],
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    let source = include_str!("../shaders/geometry.wgsl");
    let module = shader::module(&gpu.device, "geometry", source, &[inputs.normals_part]);
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("geometry"),
            bind_group_layouts: &[Some(&bound.layout), Some(material_layout)],
            immediate_size: 0,
        });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("geometry"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs_geometry"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<crate::scene::Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![
                    0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2, 4 => Float32x4
                ],
            })],
        },
        primitive: wgpu::PrimitiveState { cull_mode, ..wgpu::PrimitiveState::default() },
        // Reversed depth: nearer is greater.
        depth_stencil: Some(wgpu::DepthStencilState {
            format: Formats::DEPTH_TEST,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
