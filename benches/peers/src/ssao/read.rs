//! What Bevy drew, as numbers.

use glam::Vec3;

use crate::Failure;
use crate::passes::OcclusionPasses;

/// One value a pixel, rows from the top.
pub struct Drawn {
    /// The occlusion before and after denoising.
    pub occlusion: [Vec<f32>; 2],
    /// Linear depth, metres; infinite where there is no surface.
    pub depth_m: Vec<f32>,
    /// Unit world-space normals.
    pub normals: Vec<Vec3>,
}

/// Reads it. Bevy's projection is that of a far plane at infinity, depth reversed.
pub fn read(
    passes: &OcclusionPasses,
    (width_px, height_px): (u32, u32),
    near_m: f32,
) -> Result<Drawn, Failure> {
    const PLANES: usize = 6;
    let pixels = width_px as usize * height_px as usize;
    let size = (4 * PLANES * pixels) as u64;
    let found = passes.buffer(
        size,
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
    );
    let device = &passes.device;
    let module = device.create_shader_module(wgpu::include_wgsl!("read.wgsl"));
    let [output, others] = [false, true].map(|with_textures| output_layout(device, with_textures));
    // The layout of the first group is Bevy's own where it is Bevy's bind group, else empty.
    let (denoising, denoising_layout) = passes.before_denoising();
    let mut encoder = passes.encoder();
    for (entry_point, first_layout, layout) in [
        ("read_before_denoising", Some(denoising_layout), &output),
        ("read_others", None, &others),
    ] {
        let pipeline = pipeline(device, &module, entry_point, [first_layout, Some(layout)]);
        let group = output_group(passes, layout, &found, first_layout.is_none());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        if first_layout.is_some() {
            pass.set_bind_group(0, denoising, &[]);
        }
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups(width_px.div_ceil(8), height_px.div_ceil(8), 1);
    }
    let bytes = passes.submit_and_read(encoder, &found, size)?;
    let (numbers, _) = bytes.as_chunks::<4>();
    let numbers: Vec<f32> = numbers
        .iter()
        .map(|number| f32::from_le_bytes(*number))
        .collect();
    let plane = |index: usize| &numbers[index * pixels..(index + 1) * pixels];
    let normal =
        |pixel: usize| Vec3::from([3, 4, 5].map(|index| plane(index)[pixel])).normalize_or_zero();
    Ok(Drawn {
        occlusion: [0, 1].map(|index| plane(index).to_vec()),
        depth_m: plane(2).iter().map(|depth| near_m / depth).collect(),
        normals: (0..pixels).map(normal).collect(),
    })
}

fn output_layout(device: &wgpu::Device, with_textures: bool) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let unfiltered = wgpu::TextureSampleType::Float { filterable: false };
    let mut entries = vec![entry(
        0,
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
    )];
    if with_textures {
        entries.push(entry(1, texture(unfiltered)));
        entries.push(entry(2, texture(wgpu::TextureSampleType::Depth)));
        entries.push(entry(3, texture(unfiltered)));
    }
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("beside Bevy"),
        entries: &entries,
    })
}

fn output_group(
    passes: &OcclusionPasses,
    layout: &wgpu::BindGroupLayout,
    found: &wgpu::Buffer,
    with_textures: bool,
) -> wgpu::BindGroup {
    let mut entries = vec![wgpu::BindGroupEntry {
        binding: 0,
        resource: found.as_entire_binding(),
    }];
    if with_textures {
        for (binding, view) in (1..).zip(passes.textures()) {
            entries.push(wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::TextureView(view),
            });
        }
    }
    passes.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("beside Bevy"),
        layout,
        entries: &entries,
    })
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    entry_point: &str,
    layouts: [Option<&wgpu::BindGroupLayout>; 2],
) -> wgpu::ComputePipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(entry_point),
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: Some(&layout),
        module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}
