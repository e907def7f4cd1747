//! Geometry on the GPU: vertex and index buffers, materials, textures with their mips.

use glam::Vec3;
use wgpu::util::DeviceExt;

use super::bindings::{Bindings, Bound, uniform_of};
use super::plan::GeometryFacts;
use super::{Gpu, RenderError};
use crate::scene::{Geometry, Material, Texture, TextureEncoding, TextureUse, Wrap};

/// A scene's surfaces, ready to draw.
pub struct GpuScene {
    pub(super) meshes: Vec<GpuMesh>,
    pub(super) materials: Vec<Bound>,
    /// Counts the planner asks for.
    pub facts: GeometryFacts,
    /// Corners of the box round everything, metres; `None` for an empty scene.
    pub bounds_m: Option<(Vec3, Vec3)>,
}

pub(super) struct GpuMesh {
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    pub material: usize,
    pub double_sided: bool,
}

impl GpuScene {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`RenderError::Request`] if a mesh or material points at something that is not there,
    /// [`RenderError::Unsuitable`] if a texture or mesh is larger than the adapter takes.
    pub fn upload(gpu: &Gpu, geometry: &Geometry) -> Result<Self, RenderError> {
        check(gpu, geometry)?;
        let textures: Vec<wgpu::TextureView> = geometry
            .textures
            .iter()
            .map(|texture| upload_texture(gpu, texture))
            .collect();
        let white = upload_texture(gpu, &solid("white", [255; 4]));
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("materials"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            anisotropy_clamp: 4,
            ..wgpu::SamplerDescriptor::default()
        });
        let pick = |slot: Option<TextureUse>| slot.map_or(&white, |slot| &textures[slot.texture]);
        let materials = geometry
            .materials
            .iter()
            .map(|material| {
                let factors = uniform_of(&gpu.device, &material.name, &factors(material));
                Bindings::default()
                    .uniform(0, &factors)
                    .sampler(1, &sampler, wgpu::SamplerBindingType::Filtering)
                    .texture(2, pick(material.albedo_texture), true)
                    .texture(3, pick(material.normal_texture), true)
                    .texture(4, pick(material.roughness_texture), true)
                    .build(&gpu.device, &material.name)
            })
            .collect();
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
                double_sided: geometry.materials[mesh.material].double_sided,
            })
            .collect();
        Ok(Self {
            meshes,
            materials,
            facts: GeometryFacts::of(geometry),
            bounds_m: geometry.bounds_m(),
        })
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

/// The WGSL struct `MaterialFactors`.
fn factors(material: &Material) -> [f32; 8] {
    let [r, g, b] = material.albedo;
    [
        r,
        g,
        b,
        1.0,
        material.roughness,
        material.metallic,
        material.specular,
        f32::from(u8::from(material.normal_texture.is_some())),
    ]
}

fn solid(name: &str, rgba: [u8; 4]) -> Texture {
    Texture {
        name: name.to_owned(),
        width_px: 1,
        height_px: 1,
        rgba8: rgba.to_vec(),
        encoding: TextureEncoding::Linear,
        wrap: [Wrap::Repeat; 2],
    }
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

/// The texture and its halvings down to one pixel; colours are averaged as light, not as
/// sRGB numbers.
fn mip_chain(texture: &Texture) -> Vec<Vec<u8>> {
    let decode: Vec<f32> = (0..=255_u8)
        .map(|byte| match texture.encoding {
            TextureEncoding::Linear => f32::from(byte) / 255.0,
            TextureEncoding::Srgb => srgb_decode(f32::from(byte) / 255.0),
        })
        .collect();
    let encode = |value: f32| match texture.encoding {
        TextureEncoding::Linear => (value * 255.0).round() as u8,
        TextureEncoding::Srgb => (srgb_encode(value) * 255.0).round() as u8,
    };
    let (mut width, mut height) = (texture.width_px as usize, texture.height_px as usize);
    let mut level: Vec<[f32; 4]> = texture
        .rgba8
        .chunks_exact(4)
        .map(|p| {
            let [r, g, b] = [p[0], p[1], p[2]].map(|byte| decode[byte as usize]);
            [r, g, b, f32::from(p[3]) / 255.0]
        })
        .collect();
    let mut levels = vec![texture.rgba8.clone()];
    while width > 1 || height > 1 {
        let (next_width, next_height) = ((width / 2).max(1), (height / 2).max(1));
        level = halve(&level, (width, height), (next_width, next_height));
        (width, height) = (next_width, next_height);
        levels.push(
            level
                .iter()
                .flat_map(|p| {
                    [
                        encode(p[0]),
                        encode(p[1]),
                        encode(p[2]),
                        (p[3] * 255.0).round() as u8,
                    ]
                })
                .collect(),
        );
    }
    levels
}

fn halve(
    level: &[[f32; 4]],
    (width, height): (usize, usize),
    (next_width, next_height): (usize, usize),
) -> Vec<[f32; 4]> {
    let at = |x: usize, y: usize| level[y.min(height - 1) * width + x.min(width - 1)];
    let mut halved = Vec::with_capacity(next_width * next_height);
    for y in 0..next_height {
        for x in 0..next_width {
            let texels = [
                at(2 * x, 2 * y),
                at(2 * x + 1, 2 * y),
                at(2 * x, 2 * y + 1),
                at(2 * x + 1, 2 * y + 1),
            ];
            halved.push(std::array::from_fn(|c| {
                texels.iter().map(|t| t[c]).sum::<f32>() / 4.0
            }));
        }
    }
    halved
}

/// IEC 61966-2-1, both ways.
fn srgb_decode(value: f32) -> f32 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

fn srgb_encode(value: f32) -> f32 {
    if value <= 0.003_130_8 {
        value * 12.92
    } else {
        1.055 * value.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mips_average_light_not_numbers() {
        let texture = Texture {
            name: String::from("checks"),
            width_px: 2,
            height_px: 2,
            rgba8: [[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]].concat(),
            encoding: TextureEncoding::Srgb,
            wrap: [Wrap::Repeat; 2],
        };
        let levels = mip_chain(&texture);
        assert_eq!(levels.len(), 2);
        // Half the light of white is sRGB 188 (0.7354 · 255 = 187.5).
        assert!(
            (i16::from(levels[1][0]) - 188).abs() <= 1,
            "{}",
            levels[1][0]
        );
        let linear = mip_chain(&Texture {
            encoding: TextureEncoding::Linear,
            ..texture
        });
        assert!((i16::from(linear[1][0]) - 128).abs() <= 1);
    }

    #[test]
    fn odd_sizes_end_at_one_pixel() {
        let texture = Texture {
            name: String::from("odd"),
            width_px: 5,
            height_px: 3,
            rgba8: vec![200; 60],
            encoding: TextureEncoding::Linear,
            wrap: [Wrap::Repeat; 2],
        };
        let sizes: Vec<usize> = mip_chain(&texture).iter().map(Vec::len).collect();
        assert_eq!(sizes, [60, 8, 4]);
        assert!(
            mip_chain(&texture)
                .iter()
                .flatten()
                .all(|&byte| byte == 200)
        );
    }

    #[test]
    fn srgb_goes_both_ways() {
        for step in 0..=255_u8 {
            let value = f32::from(step) / 255.0;
            assert!((srgb_encode(srgb_decode(value)) - value).abs() < 1e-5);
        }
    }
}
