//! Geometry on the GPU: vertex and index buffers, textures with their mips.

use glam::Vec3;
use wgpu::util::DeviceExt;

use super::material::{GpuMaterial, MaterialUse};
use super::mips::mip_chain;
use super::plan::GeometryFacts;
use super::{Gpu, RenderError};
use crate::scene::{Geometry, Material, SurfacePoints, Texture, TextureEncoding, Wrap};

/// A scene's surfaces, ready to draw.
pub struct GpuScene {
    pub(super) meshes: Vec<GpuMesh>,
    /// The materials, to be bound as a frame reads them.
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<wgpu::TextureView>,
    pub(super) wraps: Vec<[Wrap; 2]>,
    /// What the planner asks for.
    pub facts: GeometryFacts,
    /// Where the surfaces are, for techniques that put spheres in their place.
    pub(super) surface: SurfacePoints,
    /// Corners of the box round everything, metres; `None` for an empty scene.
    pub bounds_m: Option<(Vec3, Vec3)>,
}

pub(super) struct GpuMesh {
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    pub material: usize,
}

impl GpuScene {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`RenderError::Request`] if a mesh or material points at something that is not there,
    /// [`RenderError::Unsuitable`] if a texture or mesh is larger than the adapter takes.
    pub fn upload(gpu: &Gpu, geometry: &Geometry) -> Result<Self, RenderError> {
        check(gpu, geometry)?;
        let meshes = geometry
            .meshes
            .iter()
            .filter(|mesh| !mesh.indices.is_empty())
            .map(|mesh| GpuMesh {
                vertices: buffer(
                    gpu,
                    &mesh.name,
                    bytemuck::cast_slice(&mesh.vertices),
                    wgpu::BufferUsages::VERTEX,
                ),
                indices: buffer(
                    gpu,
                    &mesh.name,
                    bytemuck::cast_slice(&mesh.indices),
                    wgpu::BufferUsages::INDEX,
                ),
                index_count: mesh.indices.len() as u32,
                material: mesh.material,
            })
            .collect();
        let textures = geometry.textures.iter();
        Ok(Self {
            meshes,
            materials: geometry.materials.clone(),
            wraps: textures.clone().map(|texture| texture.wrap).collect(),
            textures: textures
                .map(|texture| upload_texture(gpu, texture))
                .collect(),
            facts: GeometryFacts::of(geometry),
            surface: SurfacePoints::of(geometry),
            bounds_m: geometry.bounds_m(),
        })
    }

    /// Every material as frames of this use read it.
    pub(super) fn bind_materials(&self, gpu: &Gpu, usage: MaterialUse) -> Vec<GpuMaterial> {
        let samplers = Samplers::new(gpu);
        self.materials
            .iter()
            .map(|material| GpuMaterial::new(gpu, material, self, &samplers, usage))
            .collect()
    }
}

/// A sampler for every way that textures go on beyond their edges.
pub(super) struct Samplers([wgpu::Sampler; 9]);

impl Samplers {
    fn new(gpu: &Gpu) -> Self {
        const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror];
        let mode = |index: usize| match WRAPS[index] {
            Wrap::Repeat => wgpu::AddressMode::Repeat,
            Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
            Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        };
        Self(std::array::from_fn(|index| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("materials"),
                address_mode_u: mode(index / 3),
                address_mode_v: mode(index % 3),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            })
        }))
    }

    /// The sampler of a texture that goes on like this.
    pub(super) fn of(&self, [across, along]: [Wrap; 2]) -> &wgpu::Sampler {
        let index = |wrap| match wrap {
            Wrap::Repeat => 0,
            Wrap::Clamp => 1,
            Wrap::Mirror => 2,
        };
        &self.0[3 * index(across) + index(along)]
    }
}

fn check(gpu: &Gpu, geometry: &Geometry) -> Result<(), RenderError> {
    let limits = gpu.device.limits();
    let broken = |message: String| Err(RenderError::Request(message));
    let too_large = |message: String| {
        Err(RenderError::Unsuitable {
            adapter: gpu.adapter.name.clone(),
            message,
        })
    };
    for mesh in &geometry.meshes {
        if mesh.material >= geometry.materials.len() {
            return broken(format!(
                "mesh `{}` has material {}, there are {}",
                mesh.name,
                mesh.material,
                geometry.materials.len()
            ));
        }
        let vertices = mesh.vertices.len();
        if mesh.indices.iter().any(|&index| index as usize >= vertices) {
            return broken(format!(
                "mesh `{}` has an index beyond its {vertices} vertices",
                mesh.name
            ));
        }
        let bytes =
            (vertices * size_of::<crate::scene::Vertex>()).max(mesh.indices.len() * 4) as u64;
        if bytes > limits.max_buffer_size || mesh.indices.len() > u32::MAX as usize {
            return too_large(format!(
                "mesh `{}` needs a buffer of {bytes} bytes, it takes {}",
                mesh.name, limits.max_buffer_size
            ));
        }
    }
    for material in &geometry.materials {
        if material
            .textures()
            .any(|slot| slot.texture >= geometry.textures.len())
        {
            return broken(format!(
                "material `{}` has a texture that is not there",
                material.name
            ));
        }
    }
    for texture in &geometry.textures {
        let side = texture.width_px.max(texture.height_px);
        if side == 0
            || texture.rgba8.len() != 4 * texture.width_px as usize * texture.height_px as usize
        {
            return broken(format!(
                "texture `{}` does not have the pixels it says",
                texture.name
            ));
        }
        if side > limits.max_texture_dimension_2d {
            return too_large(format!(
                "texture `{}` is {side} px wide or high, it takes {}",
                texture.name, limits.max_texture_dimension_2d
            ));
        }
    }
    Ok(())
}

fn buffer(gpu: &Gpu, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage,
        })
}

fn upload_texture(gpu: &Gpu, texture: &Texture) -> wgpu::TextureView {
    let levels = mip_chain(texture);
    let data = levels.concat();
    let descriptor = wgpu::TextureDescriptor {
        label: Some(&texture.name),
        size: wgpu::Extent3d {
            width: texture.width_px,
            height: texture.height_px,
            depth_or_array_layers: 1,
        },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: match texture.encoding {
            TextureEncoding::Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            TextureEncoding::Linear => wgpu::TextureFormat::Rgba8Unorm,
        },
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    gpu.device
        .create_texture_with_data(
            &gpu.queue,
            &descriptor,
            wgpu::util::TextureDataOrder::LayerMajor,
            &data,
        )
        .create_view(&wgpu::TextureViewDescriptor::default())
}
