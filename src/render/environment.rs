//! The scene's environment as textures: what is seen behind the surfaces, and what they mirror.

use glam::Vec3;
use half::f16;

use super::Gpu;
use super::plan::{FramePlan, PassKind};
use crate::scene::brdf::EnvironmentTable;
use crate::scene::environment::{Environment, RadianceMap};

/// What the skybox and the reflections of a frame read; what no pass reads is not made.
pub(super) struct EnvironmentTextures {
    /// The map as it is, for the skybox.
    pub sky: Option<wgpu::TextureView>,
    /// The map blurred: one mip level a level of roughness.
    pub blurred: Option<wgpu::TextureView>,
    /// Share of constant light reflected, by cosine (columns) and roughness (rows).
    pub table: Option<wgpu::TextureView>,
    /// Round the azimuth, up to the poles.
    pub sampler: wgpu::Sampler,
}

impl EnvironmentTextures {
    /// The textures that `plan` reads. A pass that runs without an environment (at weight
    /// nought) reads darkness.
    pub fn new(gpu: &Gpu, environment: Option<&Environment>, plan: &FramePlan) -> Self {
        let dark = [RadianceMap::from_fn(1, |_| Vec3::ZERO)];
        let reflects = plan.has(PassKind::Reflections);
        Self {
            sky: plan.has(PassKind::Skybox).then(|| {
                let maps = environment.map_or(&dark[..], |e| std::slice::from_ref(e.map()));
                upload_maps(gpu, "environment", maps)
            }),
            blurred: reflects.then(|| {
                let maps = environment.map_or(&dark[..], Environment::prefiltered);
                upload_maps(gpu, "blurred environment", maps)
            }),
            table: reflects.then(|| upload_table(gpu)),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("environment"),
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::ClampToEdge,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            }),
        }
    }
}

/// Maps, each of half the size of the one before, as the mip levels of one texture of half floats.
fn upload_maps(gpu: &Gpu, label: &str, maps: &[RadianceMap]) -> wgpu::TextureView {
    // What the adapter cannot take is halved until it can: a sky of thousands of pixels is no
    // reason to refuse a picture of it.
    let largest = gpu.device.limits().max_texture_dimension_2d as usize;
    let mut smaller = None;
    while let Some(next) = smaller
        .as_ref()
        .or(maps.first())
        .filter(|map: &&RadianceMap| map.width_px() > largest)
        .map(RadianceMap::halved)
    {
        smaller = Some(next);
    }
    let levels: Vec<(usize, usize, Vec<[u16; 4]>)> = match &smaller {
        Some(map) => std::slice::from_ref(map),
        None => maps,
    }
    .iter()
    .map(|map| (map.width_px(), map.height_px(), half_floats(map)))
    .collect();
    upload(gpu, label, wgpu::TextureFormat::Rgba16Float, &levels)
}

fn half_floats(map: &RadianceMap) -> Vec<[u16; 4]> {
    let texel = |texel: &Vec3| {
        // The largest half float, not infinity: an image of the sun's disc stays a number.
        let stored = texel.min(Vec3::splat(f16::MAX.to_f32())).extend(1.0);
        stored.to_array().map(bits)
    };
    map.texels().iter().map(texel).collect()
}

fn bits(value: f32) -> u16 {
    f16::from_f32(value).to_bits()
}

fn upload_table(gpu: &Gpu) -> wgpu::TextureView {
    let table = EnvironmentTable::new();
    let entries: Vec<[u16; 2]> = table.entries.iter().map(|entry| entry.map(bits)).collect();
    let side = EnvironmentTable::SIDE;
    upload(
        gpu,
        "reflected share",
        wgpu::TextureFormat::Rg16Float,
        &[(side, side, entries)],
    )
}

/// A texture whose mip levels are (columns, rows, texels).
fn upload<T: bytemuck::Pod>(
    gpu: &Gpu,
    label: &str,
    format: wgpu::TextureFormat,
    levels: &[(usize, usize, Vec<T>)],
) -> wgpu::TextureView {
    let size = |(width, height): (usize, usize)| wgpu::Extent3d {
        width: width as u32,
        height: height as u32,
        depth_or_array_layers: 1,
    };
    let first = levels.first().map_or((1, 1), |(w, h, _)| (*w, *h));
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: size(first),
        mip_level_count: levels.len().max(1) as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, (width, height, texels)) in levels.iter().enumerate() {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level: level as u32,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            bytemuck::cast_slice(texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some((width * size_of::<T>()) as u32),
                rows_per_image: None,
            },
            size((*width, *height)),
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
