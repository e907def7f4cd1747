//! A bind group and its layout, declared together: what a pass is given is what its
//! pipeline expects.

use wgpu::util::DeviceExt;

/// Resources of one bind group, by binding number.
#[derive(Default)]
pub(super) struct Bindings<'a> {
    layout: Vec<wgpu::BindGroupLayoutEntry>,
    entries: Vec<wgpu::BindGroupEntry<'a>>,
}

impl<'a> Bindings<'a> {
    pub(super) fn uniform(self, binding: u32, buffer: &'a wgpu::Buffer) -> Self {
        self.buffer(binding, buffer, wgpu::BufferBindingType::Uniform)
    }

    pub(super) fn storage(self, binding: u32, buffer: &'a wgpu::Buffer) -> Self {
        self.buffer(
            binding,
            buffer,
            wgpu::BufferBindingType::Storage { read_only: true },
        )
    }

    fn buffer(self, binding: u32, buffer: &'a wgpu::Buffer, ty: wgpu::BufferBindingType) -> Self {
        let kind = wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        self.add(binding, kind, buffer.as_entire_binding())
    }

    /// A texture that is read texel by texel, or, if `filtered`, by a sampler.
    pub(super) fn texture(self, binding: u32, view: &'a wgpu::TextureView, filtered: bool) -> Self {
        let format = view.texture().format();
        let kind = wgpu::BindingType::Texture {
            sample_type: match format {
                wgpu::TextureFormat::Rg32Uint => wgpu::TextureSampleType::Uint,
                format if format.is_depth_stencil_format() => wgpu::TextureSampleType::Depth,
                _ => wgpu::TextureSampleType::Float {
                    filterable: filtered,
                },
            },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        self.add(binding, kind, wgpu::BindingResource::TextureView(view))
    }

    /// A texture that is read texel by texel, where there is one.
    pub(super) fn texture_if_any(self, binding: u32, view: Option<&'a wgpu::TextureView>) -> Self {
        match view {
            Some(view) => self.texture(binding, view, false),
            None => self,
        }
    }

    pub(super) fn sampler(
        self,
        binding: u32,
        sampler: &'a wgpu::Sampler,
        kind: wgpu::SamplerBindingType,
    ) -> Self {
        let resource = wgpu::BindingResource::Sampler(sampler);
        self.add(binding, wgpu::BindingType::Sampler(kind), resource)
    }

    fn add(
        mut self,
        binding: u32,
        ty: wgpu::BindingType,
        resource: wgpu::BindingResource<'a>,
    ) -> Self {
        self.layout.push(wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        });
        self.entries
            .push(wgpu::BindGroupEntry { binding, resource });
        self
    }

    pub(super) fn build(self, device: &wgpu::Device, label: &str) -> Bound {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &self.layout,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout: &layout,
            entries: &self.entries,
        });
        Bound { layout, group }
    }
}

/// A bind group with its layout.
pub(super) struct Bound {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
}

/// A uniform buffer that holds `value`.
pub(super) fn uniform_of<T: bytemuck::NoUninit>(
    device: &wgpu::Device,
    label: &str,
    value: &[T],
) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents: bytemuck::cast_slice(value),
        usage: wgpu::BufferUsages::UNIFORM,
    })
}
