//! The visible surfaces as plain data: the points that occlusion is estimated at, one a pixel.

use glam::{Vec2, Vec3};
use half::f16;

use super::buffers::{octahedral_decode, stored_normal};
use super::frame::{FrameRequest, Precision};
use super::readback::Readback;
use super::{RenderError, View};
use crate::scene::VisibleSurfaces;

impl View<'_> {
    /// The surface at each pixel of the image, at the sample that occlusion belongs to: the
    /// points of every screen-space technique. The request's technique must read normals.
    ///
    /// # Errors
    /// As [`View::render`]; [`RenderError::Request`] for a technique that reads no normals.
    pub fn visible_surfaces(
        &mut self,
        request: &FrameRequest,
    ) -> Result<VisibleSurfaces, RenderError> {
        let gpu = self.gpu();
        let surfaces = self.surfaces_of(request)?;
        let Some(normals) = &surfaces.normals else {
            let message = "the technique reads no normals, so that none were drawn";
            return Err(RenderError::Request(String::from(message)));
        };
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let depth = Readback::record(gpu, &mut encoder, surfaces.depth_m.texture());
        let normals = Readback::record(gpu, &mut encoder, normals.texture());
        gpu.queue.submit([encoder.finish()]);
        let (depth, normals) = (depth.read_floats(gpu)?, normals.read(gpu)?);
        let texels = request.occlusion_texels();
        let precision = request.precision;
        Ok(VisibleSurfaces {
            camera: request.camera,
            width_px: request.width_px,
            height_px: request.height_px,
            sample: request.occlusion_sample(),
            depth_m: texels.iter().map(|&texel| depth.values[texel]).collect(),
            normals: (texels.iter())
                .map(|&texel| stored_normal(&normals, texel, precision))
                .collect(),
            geometric_normals: (texels.iter())
                .map(|&texel| stored_geometric_normal(&normals, texel, precision))
                .collect(),
        })
    }

    /// The albedo of those surfaces as it is drawn and stored: linear red, green and blue, 0 to 1,
    /// of each pixel's sample that occlusion belongs to. What it is where there is no surface means
    /// nothing.
    ///
    /// # Errors
    /// As [`View::render`].
    pub fn visible_albedo(&mut self, request: &FrameRequest) -> Result<Vec<[f32; 3]>, RenderError> {
        let gpu = self.gpu();
        let surfaces = self.surfaces_of(request)?;
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let albedo = Readback::record(gpu, &mut encoder, surfaces.albedo.texture());
        gpu.queue.submit([encoder.finish()]);
        let halves = albedo.read(gpu)?;
        let texels = request.occlusion_texels();
        Ok(texels
            .iter()
            .map(|&texel| [0, 1, 2].map(|channel| half_at(&halves, 4 * texel + channel)))
            .collect())
    }
}

impl FrameRequest {
    /// The texel of the surfaces that each pixel's occlusion belongs to, as `occlusion_texel`
    /// in WGSL has it.
    fn occlusion_texels(&self) -> Vec<usize> {
        let samples = self.supersampling as usize;
        let width = self.width_px as usize;
        let at = |pixel: usize| pixel * samples + samples / 2;
        (0..width * self.height_px as usize)
            .map(|pixel| at(pixel / width) * width * samples + at(pixel % width))
            .collect()
    }

    /// Where that texel's centre lies in the pixel, from its corner, as `occlusion_sample` in
    /// WGSL has it.
    fn occlusion_sample(&self) -> f32 {
        ((self.supersampling / 2) as f32 + 0.5) / self.supersampling as f32
    }
}

/// The half float of that number.
fn half_at(bytes: &[u8], number: usize) -> f32 {
    f16::from_le_bytes([bytes[2 * number], bytes[2 * number + 1]]).to_f32()
}

/// The world-space normal of a texel's triangle: to a few degrees, or, in the thesis' precision,
/// the shading normal.
fn stored_geometric_normal(bytes: &[u8], texel: usize, precision: Precision) -> Vec3 {
    match precision {
        Precision::Thesis => stored_normal(bytes, texel, precision),
        Precision::Full => {
            let stored = &bytes[8 * texel + 6..8 * texel + 8];
            let [x, y] = [0, 1].map(|at| f32::from(stored[at]) / 127.5 - 1.0);
            octahedral_decode(Vec2::new(x, y))
        }
    }
}
