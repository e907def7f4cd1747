//! From the GPU's textures to numbers.

use glam::Vec3;

use super::{Gpu, RenderError};

/// One number a pixel, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct FloatImage {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// `width_px · height_px` values.
    pub values: Vec<f32>,
}

/// Linear depth, metres; the camera's far distance where there is no surface.
pub type LinearDepth = FloatImage;

impl FloatImage {
    /// The value of a pixel.
    ///
    /// # Panics
    /// If the pixel lies outside.
    #[must_use]
    pub fn at(&self, x: u32, y: u32) -> f32 {
        assert!(
            x < self.width_px && y < self.height_px,
            "pixel ({x}, {y}) lies outside"
        );
        self.values[(y * self.width_px + x) as usize]
    }
}

/// A copy of a texture that the CPU will be able to read once the work is submitted.
pub(super) struct Readback {
    buffer: wgpu::Buffer,
    size_px: (u32, u32),
    bytes_per_pixel: u32,
    bytes_per_row: u32,
}

impl Readback {
    /// Records the copy of a whole texture of an uncompressed format.
    pub(super) fn record(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        texture: &wgpu::Texture,
    ) -> Self {
        let size_px = (texture.width(), texture.height());
        let bytes_per_pixel = texture.format().block_copy_size(None).unwrap_or(4);
        let bytes_per_row =
            (size_px.0 * bytes_per_pixel).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(bytes_per_row) * u64::from(size_px.1),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(bytes_per_row),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        Self {
            buffer,
            size_px,
            bytes_per_pixel,
            bytes_per_row,
        }
    }

    /// The texture's bytes, rows from the top without padding.
    pub(super) fn read(&self, gpu: &Gpu) -> Result<Vec<u8>, RenderError> {
        let padded = map(gpu, &self.buffer)?;
        let row = (self.size_px.0 * self.bytes_per_pixel) as usize;
        Ok(padded
            .chunks_exact(self.bytes_per_row as usize)
            .flat_map(|padded_row| &padded_row[..row])
            .copied()
            .collect())
    }

    /// The texture as numbers: 32-bit floats, half floats or bytes of 0 to 1.
    pub(super) fn read_floats(&self, gpu: &Gpu) -> Result<FloatImage, RenderError> {
        let bytes = self.read(gpu)?;
        let values = match self.bytes_per_pixel {
            4 => bytemuck::pod_collect_to_vec(&bytes),
            2 => bytes
                .chunks_exact(2)
                .map(|pair| half::f16::from_le_bytes([pair[0], pair[1]]).to_f32())
                .collect(),
            _ => bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect(),
        };
        Ok(FloatImage {
            width_px: self.size_px.0,
            height_px: self.size_px.1,
            values,
        })
    }

    /// A texture of four half floats as vectors of its first three.
    pub(super) fn read_half_vectors(&self, gpu: &Gpu) -> Result<Vec<Vec3>, RenderError> {
        let bytes = self.read(gpu)?;
        let half = |texel: &[u8], at: usize| half::f16::from_le_bytes([texel[at], texel[at + 1]]);
        Ok(bytes
            .chunks_exact(8)
            .map(|texel| Vec3::from([0, 2, 4].map(|at| half(texel, at).to_f32())))
            .collect())
    }
}

/// Waits for the GPU and copies a mappable buffer out.
pub(super) fn map(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, RenderError> {
    let lost = |error: &dyn std::fmt::Display| RenderError::Device(error.to_string());
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver outlives the wait below; if it is gone nobody waits.
        let _ = sender.send(result);
    });
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| lost(&error))?;
    receiver
        .recv()
        .map_err(|error| lost(&error))?
        .map_err(|error| lost(&error))?;
    let bytes = buffer
        .get_mapped_range(..)
        .map_err(|error| lost(&error))?
        .to_vec();
    buffer.unmap();
    Ok(bytes)
}
