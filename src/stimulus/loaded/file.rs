//! The formats images come in. Everything here treats the file as hostile: sizes are checked
//! before anything is allocated for them.

use std::io::Cursor;
use std::path::Path;

use image::codecs::{jpeg::JpegDecoder, openexr::OpenExrDecoder, png::PngDecoder};
use image::metadata::Orientation;
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageFormat, Limits};

use super::super::manifest::StimulusError;
use super::tags::{self, Tag};

/// Widest and highest image, pixels; as in sets.
const LARGEST_PX: u32 = 8192;
/// Most memory one image may take while it is decoded, bytes: 8192 × 8192 pixels of four floats.
const LARGEST_BYTES: u64 = 1 << 30;

/// A format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Png,
    Jpeg,
    OpenExr,
}

impl Format {
    /// As it is written in manifests.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::OpenExr => "OpenEXR",
        }
    }
}

/// A decoded file, its numbers as they stood in it.
#[derive(Debug)]
pub struct Decoded {
    pub format: Format,
    pub bits_per_channel: u32,
    pub tag: Tag,
    pub image: DynamicImage,
}

/// The bytes of a file, if it is not beyond any image.
pub fn read(path: &Path) -> Result<Vec<u8>, StimulusError> {
    let unreadable = |source| StimulusError::Unreadable {
        path: path.to_owned(),
        source,
    };
    let length = std::fs::metadata(path).map_err(unreadable)?.len();
    if length > LARGEST_BYTES {
        return Err(StimulusError::Image {
            path: path.to_owned(),
            message: format!(
                "the file has {} MB; the largest image that is read has {} MB",
                length >> 20,
                LARGEST_BYTES >> 20
            ),
        });
    }
    std::fs::read(path).map_err(unreadable)
}

/// Decodes a file; `size_px` is the size it must have, if there is one.
pub fn decode(bytes: &[u8], size_px: Option<(u32, u32)>) -> Result<Decoded, String> {
    let cursor = || Cursor::new(bytes);
    match image::guess_format(bytes) {
        Ok(ImageFormat::Png) => {
            let limits = limits();
            let decoder = PngDecoder::with_limits(cursor(), limits).map_err(|e| damaged(&e))?;
            if decoder.is_apng().map_err(|e| damaged(&e))? {
                return Err(String::from("an animated PNG; save one frame of it"));
            }
            finish(decoder, Format::Png, size_px, |icc| {
                tags::of_png(bytes, icc)
            })
        }
        Ok(ImageFormat::Jpeg) => {
            // Decoders fill up a file that breaks off with grey and say nothing.
            if !bytes.trim_ascii_end().ends_with(&[0xff, 0xd9]) {
                return Err(String::from(
                    "the JPEG does not end with its end marker: it is cut short, or something was appended to it; copy or save it again",
                ));
            }
            let decoder = JpegDecoder::new(cursor()).map_err(|e| damaged(&e))?;
            finish(decoder, Format::Jpeg, size_px, tags::of_profile)
        }
        Ok(ImageFormat::OpenExr) => {
            let decoder = OpenExrDecoder::new(cursor()).map_err(|e| damaged(&e))?;
            finish(decoder, Format::OpenExr, size_px, |_| tags::of_exr(bytes))
        }
        Ok(other) => Err(format!(
            "found {other:?}; images can be PNG, JPEG or OpenEXR"
        )),
        Err(_) if bytes.is_empty() => Err(String::from("the file is empty")),
        Err(_) => Err(String::from(
            "this is no image; images can be PNG, JPEG or OpenEXR",
        )),
    }
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(LARGEST_PX);
    limits.max_image_height = Some(LARGEST_PX);
    limits.max_alloc = Some(LARGEST_BYTES);
    limits
}

fn finish<D: ImageDecoder>(
    mut decoder: D,
    format: Format,
    size_px: Option<(u32, u32)>,
    tag: impl FnOnce(Option<&[u8]>) -> Tag,
) -> Result<Decoded, String> {
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 || width.max(height) > LARGEST_PX {
        return Err(format!(
            "the image is {width}×{height} pixels; allowed are 1 to {LARGEST_PX} each way"
        ));
    }
    if let Some((wanted_width, wanted_height)) = size_px
        && (width, height) != (wanted_width, wanted_height)
    {
        return Err(format!(
            "the image is {width}×{height} pixels, the set's width_px and height_px say {wanted_width}×{wanted_height}"
        ));
    }
    decoder.set_limits(limits()).map_err(|e| damaged(&e))?;
    let colour = decoder.original_color_type();
    if matches!(colour, ExtendedColorType::Cmyk8 | ExtendedColorType::Cmyk16) {
        return Err(String::from("a CMYK image, made for print; save it as RGB"));
    }
    if decoder.orientation().map_err(|e| damaged(&e))? != Orientation::NoTransforms {
        return Err(String::from(
            "the file asks to be turned when it is shown (Exif orientation); save it turned",
        ));
    }
    let profile = decoder.icc_profile().map_err(|e| damaged(&e))?;
    Ok(Decoded {
        format,
        bits_per_channel: u32::from(colour.bits_per_pixel()) / u32::from(colour.channel_count()),
        tag: tag(profile.as_deref()),
        image: DynamicImage::from_decoder(decoder).map_err(|e| damaged(&e))?,
    })
}

fn damaged(error: &image::ImageError) -> String {
    format!("damaged or of an unusual kind: {error}; save it again")
}
