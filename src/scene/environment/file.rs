//! Environment maps from files: Radiance `.hdr` and OpenEXR, equirectangular.

use std::io::Cursor;
use std::path::Path;

use glam::Vec3;
use image::codecs::hdr::HdrDecoder;
use image::codecs::openexr::OpenExrDecoder;
use image::{DynamicImage, ImageDecoder, Limits};

use super::RadianceMap;
use crate::digest;

/// Largest side of a map.
const LARGEST_SIDE_PX: u32 = 16_384;

/// Most memory a decoder may ask for: a map of 16384 × 8192 in four floats.
const LARGEST_BYTES: u64 = 2 << 30;

/// An environment map that cannot be used. The message is complete but for the file's name.
#[derive(Debug, thiserror::Error)]
pub enum EnvironmentFileError {
    /// It cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
    /// It is neither Radiance nor OpenEXR.
    #[error("is neither a Radiance .hdr nor an OpenEXR file (by its first bytes)")]
    UnknownFormat,
    /// The decoder gave up on it.
    #[error("is damaged or of a kind that cannot be read: {0}")]
    Malformed(#[from] image::ImageError),
    /// It is not twice as wide as it is high, so not the whole sphere.
    #[error(
        "has {width_px}×{height_px} pixels; an equirectangular map of the whole sphere is twice as wide as it is high"
    )]
    NotEquirectangular {
        /// Columns.
        width_px: u32,
        /// Rows.
        height_px: u32,
    },
    /// It is larger than any use here has for it.
    #[error(
        "has {width_px}×{height_px} pixels; at most {LARGEST_SIDE_PX} on a side are read, make it smaller"
    )]
    TooLarge {
        /// Columns.
        width_px: u32,
        /// Rows.
        height_px: u32,
    },
    /// A texel is not a number: nothing can be said of the light there.
    #[error(
        "has {count} pixels that are infinite or not a number, the first in column {column}, row {row}; \
         paint over them in an image editor, or export it again with less exposure"
    )]
    NotFinite {
        /// How many.
        count: usize,
        /// Column of the first, from 0.
        column: usize,
        /// Row of the first, from 0.
        row: usize,
    },
}

/// A map that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedMap {
    /// The map.
    pub map: RadianceMap,
    /// SHA-256 of the file's bytes, hexadecimal.
    pub sha256: String,
}

/// Reads a map. Negative components, which resampling filters leave in some files, become 0, with
/// a warning in the log that says how many; a pixel that is not finite is an error.
///
/// # Errors
/// [`EnvironmentFileError`], without the file's name: the caller knows which config asked for it.
pub fn load(path: &Path) -> Result<LoadedMap, EnvironmentFileError> {
    let bytes = std::fs::read(path)?;
    let (map, negative) = decode(&bytes)?;
    if negative > 0 {
        tracing::warn!(
            "{}: {negative} pixels have a negative component, read as 0",
            path.display()
        );
    }
    Ok(LoadedMap {
        map,
        sha256: digest::sha256_hex(&bytes),
    })
}

/// The map in a file's bytes, and how many of its pixels had a negative component.
fn decode(bytes: &[u8]) -> Result<(RadianceMap, usize), EnvironmentFileError> {
    let image = if bytes.starts_with(b"#?") {
        // Not strict: "#?RGBE" is as common a first line as "#?RADIANCE".
        rgb_of(HdrDecoder::new_nonstrict(Cursor::new(bytes))?)?
    } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        rgb_of(OpenExrDecoder::new(Cursor::new(bytes))?)?
    } else {
        return Err(EnvironmentFileError::UnknownFormat);
    };
    let width_px = image.width() as usize;
    let mut negative = 0;
    let mut not_finite: Option<(usize, usize)> = None;
    let mut texels = Vec::with_capacity(image.as_raw().len() / 3);
    for (index, pixel) in image.pixels().enumerate() {
        let texel = Vec3::from(pixel.0);
        if !texel.is_finite() {
            let (count, first) = not_finite.unwrap_or((0, index));
            not_finite = Some((count + 1, first));
        }
        negative += usize::from(texel.min_element() < 0.0);
        texels.push(texel.max(Vec3::ZERO));
    }
    if let Some((count, first)) = not_finite {
        return Err(EnvironmentFileError::NotFinite {
            count,
            column: first % width_px,
            row: first / width_px,
        });
    }
    let (width_px, height_px) = image.dimensions();
    let map = RadianceMap::new(width_px as usize, height_px as usize, texels).ok_or(
        EnvironmentFileError::NotEquirectangular {
            width_px,
            height_px,
        },
    )?;
    Ok((map, negative))
}

/// Decodes after looking at the size that the header claims.
fn rgb_of(mut decoder: impl ImageDecoder) -> Result<image::Rgb32FImage, EnvironmentFileError> {
    let (width_px, height_px) = decoder.dimensions();
    if width_px.max(height_px) > LARGEST_SIDE_PX {
        return Err(EnvironmentFileError::TooLarge {
            width_px,
            height_px,
        });
    }
    if height_px == 0 || width_px != 2 * height_px {
        return Err(EnvironmentFileError::NotEquirectangular {
            width_px,
            height_px,
        });
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(LARGEST_BYTES);
    decoder.set_limits(limits)?;
    Ok(DynamicImage::from_decoder(decoder)?.into_rgb32f())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ExtendedColorType, ImageEncoder, Rgb, Rgb32FImage};
    use proptest::prelude::*;

    fn picture(width_px: u32, height_px: u32) -> Rgb32FImage {
        Rgb32FImage::from_fn(width_px, height_px, |x, y| {
            Rgb([x as f32 * 0.5, y as f32 * 8.0, 1.0])
        })
    }

    fn as_exr(picture: &Rgb32FImage) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image::codecs::openexr::OpenExrEncoder::new(&mut bytes)
            .write_image(
                bytemuck::cast_slice(picture.as_raw()),
                picture.width(),
                picture.height(),
                ExtendedColorType::Rgb32F,
            )
            .unwrap();
        bytes.into_inner()
    }

    fn as_hdr(picture: &Rgb32FImage) -> Vec<u8> {
        let mut bytes = Vec::new();
        let pixels: Vec<Rgb<f32>> = picture.pixels().copied().collect();
        image::codecs::hdr::HdrEncoder::new(&mut bytes)
            .encode(&pixels, picture.width() as usize, picture.height() as usize)
            .unwrap();
        bytes
    }

    #[test]
    fn both_formats_give_their_radiance() {
        let picture = picture(32, 16);
        // RGBE keeps 8 bits of the largest component; OpenEXR is written in floats.
        for (bytes, tolerance) in [(as_hdr(&picture), 1.0 / 128.0), (as_exr(&picture), 0.0)] {
            let (map, negative) = decode(&bytes).unwrap();
            assert_eq!((map.width_px(), map.height_px(), negative), (32, 16, 0));
            for (texel, pixel) in map.texels().iter().zip(picture.pixels()) {
                let off = (*texel - Vec3::from(pixel.0)).abs().max_element();
                let largest = Vec3::from(pixel.0).max_element();
                assert!(off <= tolerance * largest, "{texel} {pixel:?}");
            }
        }
    }

    #[test]
    fn the_other_first_line_of_radiance_files_is_known() {
        let bytes = as_hdr(&picture(16, 8));
        let text = [b"#?RGBE".as_slice(), &bytes[b"#?RADIANCE".len()..]].concat();
        assert!(decode(&text).is_ok());
    }

    #[test]
    fn what_is_not_the_whole_sphere_is_refused() {
        let message = decode(&as_hdr(&picture(16, 16))).unwrap_err().to_string();
        assert!(
            message.contains("16×16") && message.contains("twice as wide"),
            "{message}"
        );
        assert!(matches!(
            decode(b"\x89PNG\r\n"),
            Err(EnvironmentFileError::UnknownFormat)
        ));
    }

    #[test]
    fn impossible_radiance_is_named_or_mended() {
        let mut broken = picture(8, 4);
        broken.put_pixel(3, 2, Rgb([f32::NAN, 0.0, 0.0]));
        broken.put_pixel(5, 3, Rgb([f32::INFINITY, 0.0, 0.0]));
        let message = decode(&as_exr(&broken)).unwrap_err().to_string();
        assert!(
            message.contains("2 pixels") && message.contains("column 3, row 2"),
            "{message}"
        );
        let mut ringing = picture(8, 4);
        ringing.put_pixel(3, 2, Rgb([-0.25, 1.0, 2.0]));
        let (map, negative) = decode(&as_exr(&ringing)).unwrap();
        assert_eq!(negative, 1);
        assert_eq!(map.texels()[2 * 8 + 3], Vec3::new(0.0, 1.0, 2.0));
    }

    #[test]
    fn a_claimed_size_is_not_believed() {
        let claim = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000000 +X 2000000000\n";
        assert!(decode(claim).is_err());
        let claim = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n\x01";
        assert!(decode(claim).is_err());
    }

    proptest! {
        /// Cut anywhere, with any byte changed: a map or an error.
        #[test]
        fn damaged_files_never_panic(
            cut in 0.0_f64..1.0,
            at in 0.0_f64..1.0,
            byte: u8,
            exr: bool,
        ) {
            let whole = if exr { as_exr(&picture(16, 8)) } else { as_hdr(&picture(16, 8)) };
            let place = |part: f64| (part * whole.len() as f64) as usize;
            let _ = decode(&whole[..place(cut)]);
            let mut flipped = whole.clone();
            flipped[place(at)] = byte;
            let _ = decode(&flipped);
            let _ = decode(&flipped[..place(cut)]);
        }
    }
}
