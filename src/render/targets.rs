//! The textures of a frame: those its plan writes, and no others.

use half::f16;
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::Gpu;
use super::frame::{Formats, Precision};
use super::readback::FloatImage;

/// A texture that passes draw to and read.
pub(super) fn target(
    gpu: &Gpu,
    label: &str,
    (width, height): (u32, u32),
    format: wgpu::TextureFormat,
) -> wgpu::TextureView {
    gpu.device
        .create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
        .create_view(&wgpu::TextureViewDescriptor::default())
}

/// An occlusion target that was computed outside of the renderer, stored as one drawn here.
pub(super) fn handed_occlusion(
    gpu: &Gpu,
    image: &FloatImage,
    precision: Precision,
) -> wgpu::TextureView {
    let values = image.values.iter();
    let bytes: Vec<u8> = match precision {
        Precision::Full => values
            .flat_map(|&value| f16::from_f32(value).to_le_bytes())
            .collect(),
        Precision::Thesis => values
            .map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
            .collect(),
    };
    let descriptor = wgpu::TextureDescriptor {
        label: Some("occlusion, handed in"),
        size: wgpu::Extent3d {
            width: image.width_px,
            height: image.height_px,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: Formats::of(precision).occlusion,
        usage: wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    gpu.device
        .create_texture_with_data(
            &gpu.queue,
            &descriptor,
            TextureDataOrder::LayerMajor,
            &bytes,
        )
        .create_view(&wgpu::TextureViewDescriptor::default())
}
