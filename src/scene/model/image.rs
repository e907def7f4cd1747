//! Pictures in a model file, decoded within limits.

use std::io::Cursor;

use ::image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};

use super::error::Fault;
use super::limits::Budget;

/// A decoded picture.
pub(super) struct Picture {
    pub width_px: u32,
    pub height_px: u32,
    /// `4 · width_px · height_px` bytes, rows from the top.
    pub rgba8: Vec<u8>,
}

/// Decodes PNG or JPEG, told apart by their first bytes (names lie more often than
/// headers). Grey becomes three equal channels, 16 bits become 8.
pub(super) fn decode(encoded: &[u8], place: &str, budget: &mut Budget) -> Result<Picture, Fault> {
    let format = ::image::guess_format(encoded).ok();
    let Some(format @ (ImageFormat::Png | ImageFormat::Jpeg)) = format else {
        let message = "is neither PNG nor JPEG; convert it to one of them";
        return Err(Fault::new(place, message));
    };
    let broken = |error: ImageError| {
        Fault::new(
            place,
            format!("cannot be decoded: {error}; export it again"),
        )
    };
    let mut decoder = ImageReader::with_format(Cursor::new(encoded), format)
        .into_decoder()
        .map_err(broken)?;
    let (width_px, height_px) = decoder.dimensions();
    let most_px = budget.limits().texture_side_px;
    if width_px.max(height_px) > most_px || width_px.min(height_px) == 0 {
        let message = format!(
            "is {width_px} × {height_px} pixels; allowed are 1 to {most_px} a side: make it smaller"
        );
        return Err(Fault::new(place, message));
    }
    budget.texture_bytes(place, 4 * u64::from(width_px) * u64::from(height_px))?;
    let mut limits = ::image::Limits::no_limits();
    limits.max_image_width = Some(most_px);
    limits.max_image_height = Some(most_px);
    // The decoded 16-bit RGBA picture, and as much again for the decoder's own buffers.
    limits.max_alloc = Some(16 * u64::from(width_px) * u64::from(height_px) + (64 << 20));
    decoder.set_limits(limits).map_err(broken)?;
    let picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    Ok(Picture {
        width_px,
        height_px,
        rgba8: picture.into_rgba8().into_raw(),
    })
}
