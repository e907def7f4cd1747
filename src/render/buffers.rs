//! What a frame is made of, as pictures to look at.

use glam::{Vec2, Vec3};
use half::f16;

use super::frame::{FrameRequest, Precision};
use super::readback::{FloatImage, Readback};
use super::{RenderError, View};
use crate::render::Picture;
use crate::scene::srgb;

/// One of the buffers that a frame is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Buffer {
    /// The surfaces' colour.
    Albedo,
    /// World-space normals, −1 to 1 as 0 to 255.
    Normals,
    /// Linear depth on a logarithmic scale: the nearest surface white, the farthest nearly
    /// black, no surface black.
    Depth,
    /// The occlusion coefficient: open is white.
    Occlusion,
    /// Radiance, exposed and clipped, without a tone map.
    Light,
    /// The image.
    Final,
}

impl Buffer {
    /// Every buffer, from the first drawn to the last.
    pub const ALL: [Self; 6] = [
        Self::Albedo,
        Self::Normals,
        Self::Depth,
        Self::Occlusion,
        Self::Light,
        Self::Final,
    ];

    /// Name for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Albedo => "albedo",
            Self::Normals => "normals",
            Self::Depth => "depth",
            Self::Occlusion => "occlusion",
            Self::Light => "light",
            Self::Final => "final",
        }
    }
}

impl View<'_> {
    /// Draws an image and shows what it is made of, each buffer at the image's size: of
    /// several samples a pixel, the one that occlusion belongs to. Every effect runs, so
    /// that every buffer is there; the image is the same.
    ///
    /// # Errors
    /// As [`View::render`].
    pub fn buffers(
        &mut self,
        request: &FrameRequest,
    ) -> Result<Vec<(Buffer, Picture)>, RenderError> {
        let request = FrameRequest {
            all_effects: true,
            ..request.clone()
        };
        let shaded = self.guarded(&request)?;
        let missing = || RenderError::Device(String::from("a buffer of the frame is missing"));
        let surfaces = self.drawn_surfaces().ok_or_else(missing)?;
        let normals = surfaces.normals.as_ref().ok_or_else(missing)?;
        let radiance = shaded.radiance.as_ref().ok_or_else(missing)?;
        let gpu = self.gpu();
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let [albedo, normals, depth, radiance] =
            [&surfaces.albedo, normals, &surfaces.depth_m, radiance]
                .map(|view| Readback::record(gpu, &mut encoder, view.texture()));
        gpu.queue.submit([encoder.finish()]);
        let (albedo, normals) = (albedo.read(gpu)?, normals.read(gpu)?);
        let (depth, radiance) = (depth.read_floats(gpu)?, radiance.read(gpu)?);
        let occlusion = shaded.occlusion.ok_or_else(missing)?;
        let far_m = request.camera.far_m;
        let normal = |texel: usize| {
            let direction = stored_normal(&normals, texel, request.precision);
            (depth.values[texel] < far_m).then_some(direction)
        };
        let exposure = request.lighting.exposure_ev.exp2();
        let depth_scale = DepthScale::of(&depth, far_m);
        Ok(vec![
            (
                Buffer::Albedo,
                sampled(&request, |t| color(&albedo, t, 1.0)),
            ),
            (
                Buffer::Normals,
                sampled(&request, |t| {
                    normal(t).map_or([0; 3], |n| (n * 0.5 + 0.5).to_array().map(byte))
                }),
            ),
            (
                Buffer::Depth,
                sampled(&request, |t| [byte(depth_scale.grey(depth.values[t])); 3]),
            ),
            (Buffer::Occlusion, grey_picture(&occlusion)),
            (
                Buffer::Light,
                sampled(&request, |t| color(&radiance, t, exposure)),
            ),
            (Buffer::Final, shaded.picture),
        ])
    }
}

/// A texel of four half floats, linear, times `scale`, as sRGB.
fn color(halves: &[u8], texel: usize, scale: f32) -> [u8; 3] {
    let channel = |c: usize| {
        let at = 8 * texel + 2 * c;
        f16::from_le_bytes([halves[at], halves[at + 1]]).to_f32() * scale
    };
    [0, 1, 2].map(|c| byte(srgb::encode(channel(c).clamp(0.0, 1.0))))
}

/// A picture of the sample of each pixel that its occlusion belongs to.
fn sampled(request: &FrameRequest, pixel: impl Fn(usize) -> [u8; 3]) -> Picture {
    let samples = request.supersampling;
    let (width, _) = request.shaded_size();
    let texel = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|p| p * samples + samples / 2);
        (y * width + x) as usize
    };
    let rgba8 = (0..request.height_px)
        .flat_map(|y| (0..request.width_px).map(move |x| (x, y)))
        .flat_map(|(x, y)| {
            let [r, g, b] = pixel(texel(x, y));
            [r, g, b, 255]
        })
        .collect();
    Picture {
        width_px: request.width_px,
        height_px: request.height_px,
        rgba8,
    }
}

fn grey_picture(image: &FloatImage) -> Picture {
    Picture {
        width_px: image.width_px,
        height_px: image.height_px,
        rgba8: image
            .values
            .iter()
            .flat_map(|&value| [byte(value), byte(value), byte(value), 255])
            .collect(),
    }
}

/// Depth on a logarithmic scale from the nearest surface to the farthest.
struct DepthScale {
    nearest_ln: f32,
    range_ln: f32,
    far_m: f32,
}

impl DepthScale {
    fn of(depth: &FloatImage, far_m: f32) -> Self {
        let surfaces = || depth.values.iter().copied().filter(|&d| d < far_m);
        let nearest_ln = surfaces().fold(far_m, f32::min).ln();
        let farthest_ln = surfaces().fold(0.0, f32::max).max(f32::MIN_POSITIVE).ln();
        Self {
            nearest_ln,
            range_ln: (farthest_ln - nearest_ln).max(1e-6),
            far_m,
        }
    }

    fn grey(&self, depth_m: f32) -> f32 {
        if depth_m >= self.far_m {
            return 0.0;
        }
        1.0 - 0.9 * (depth_m.ln() - self.nearest_ln) / self.range_ln
    }
}

/// The world-space shading normal of a texel, as the surfaces store it.
pub(super) fn stored_normal(bytes: &[u8], texel: usize, precision: Precision) -> Vec3 {
    match precision {
        Precision::Thesis => {
            let stored = &bytes[4 * texel..4 * texel + 3];
            let [x, y, z] = [0, 1, 2].map(|c| f32::from(stored[c]) / 127.5 - 1.0);
            Vec3::new(x, y, z).normalize_or_zero()
        }
        Precision::Full => {
            let stored = &bytes[8 * texel..8 * texel + 4];
            let [x, y] = [0, 2]
                .map(|at| f32::from(i16::from_le_bytes([stored[at], stored[at + 1]])) / 32767.0);
            octahedral_decode(Vec2::new(x, y))
        }
    }
}

/// The CPU's twin of `octahedral_decode` in WGSL (Meyer et al. 2010).
pub(super) fn octahedral_decode(encoded: Vec2) -> Vec3 {
    let z = 1.0 - encoded.x.abs() - encoded.y.abs();
    let xy = if z >= 0.0 {
        encoded
    } else {
        (Vec2::ONE - Vec2::new(encoded.y, encoded.x).abs()) * encoded.map(f32::signum)
    };
    xy.extend(z).normalize_or_zero()
}

fn byte(value: f32) -> u8 {
    (value * 255.0).round() as u8
}
