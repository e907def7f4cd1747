//! A contact sheet: every pair of a set on one picture, a row a condition.

use std::path::Path;

use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

use super::manifest::{ImageRecord, Manifest, Picture, StimulusError};

/// Width of one thumbnail, pixels.
const THUMBNAIL_PX: u32 = 480;
/// Space round the thumbnails, pixels.
const GAP_PX: u32 = 8;
/// The mid-grey of the study, so that no pair is seen on a brighter ground than another.
const GROUND: Rgb<u8> = Rgb([128; 3]);

/// Draws the sheet of a set that lies in `folder`: rows in the set's order, first technique on
/// the left.
///
/// # Errors
/// [`StimulusError`] of the first image that cannot be used.
pub fn contact_sheet(manifest: &Manifest, folder: &Path) -> Result<Picture, StimulusError> {
    let mut rows = Vec::new();
    for pair in &manifest.pairs {
        rows.push([
            thumbnail(&pair.first, folder)?,
            thumbnail(&pair.second, folder)?,
        ]);
    }
    let height_px = rows.iter().map(|row| row_height(row) + GAP_PX).sum::<u32>() + GAP_PX;
    let width_px = 2 * THUMBNAIL_PX + 3 * GAP_PX;
    let mut sheet = RgbImage::from_pixel(width_px, height_px, GROUND);
    let mut y = GAP_PX;
    for row in &rows {
        for (thumbnail, x) in row.iter().zip([GAP_PX, 2 * GAP_PX + THUMBNAIL_PX]) {
            imageops::replace(&mut sheet, thumbnail, i64::from(x), i64::from(y));
        }
        y += row_height(row) + GAP_PX;
    }
    let rgba8 = sheet
        .pixels()
        .flat_map(|p| [p[0], p[1], p[2], 255])
        .collect();
    Ok(Picture {
        width_px,
        height_px,
        rgba8,
    })
}

fn row_height(row: &[RgbImage; 2]) -> u32 {
    row[0].height().max(row[1].height())
}

fn thumbnail(record: &ImageRecord, folder: &Path) -> Result<RgbImage, StimulusError> {
    Ok(resized(
        &record.load(folder)?,
        THUMBNAIL_PX,
        FilterType::CatmullRom,
    ))
}

/// A picture made smaller, `width_px` columns wide, in its own proportions.
#[must_use]
pub fn shrink(picture: &Picture, width_px: u32, filter: FilterType) -> Picture {
    let small = resized(picture, width_px, filter);
    Picture {
        width_px: small.width(),
        height_px: small.height(),
        rgba8: small
            .pixels()
            .flat_map(|p| [p[0], p[1], p[2], 255])
            .collect(),
    }
}

fn resized(picture: &Picture, width_px: u32, filter: FilterType) -> RgbImage {
    let image = RgbImage::from_fn(picture.width_px, picture.height_px, |x, y| {
        let at = 4 * (y as usize * picture.width_px as usize + x as usize);
        Rgb([
            picture.rgba8[at],
            picture.rgba8[at + 1],
            picture.rgba8[at + 2],
        ])
    });
    let height_px = (u64::from(picture.height_px) * u64::from(width_px)
        / u64::from(picture.width_px.max(1)))
    .clamp(1, 8192) as u32;
    imageops::resize(&image, width_px, height_px, filter)
}
