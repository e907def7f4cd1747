//! What a file holds to what the screen shows: opaque 8-bit sRGB, the same bytes everywhere.

use glam::Vec3;
use image::DynamicImage;

use super::super::manifest::Picture;
use crate::scene::{ToneMap, srgb};

/// A picture, and how much of it was out of range.
#[derive(Debug)]
pub struct Shown {
    pub picture: Picture,
    /// Share of pixels with a clipped channel, 0 to 1.
    pub clipped_share: f64,
}

/// Values that are sRGB already. 8 bits stay as they are; 16 bits go to the nearest of 256
/// levels, without dithering, so that the same file always gives the same bytes.
pub fn displayed(image: DynamicImage) -> Result<Shown, String> {
    check_opaque(&image)?;
    let size_px = (image.width(), image.height());
    let eight_bits = match image {
        DynamicImage::ImageLuma8(_)
        | DynamicImage::ImageLumaA8(_)
        | DynamicImage::ImageRgb8(_)
        | DynamicImage::ImageRgba8(_) => image.into_rgb8().into_raw(),
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => {
            let wide = image.into_rgb16().into_raw();
            wide.into_iter().map(nearest_of_256).collect()
        }
        _ => {
            let level = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
            return floats(image, |rgb| (rgb, rgb.to_array().map(level)));
        }
    };
    Ok(Shown {
        picture: opaque(size_px, eight_bits.chunks_exact(3)),
        clipped_share: 0.0,
    })
}

/// Linear light: exposed, tone-mapped, clipped to what can be displayed, encoded.
pub fn linear(image: DynamicImage, exposure_ev: f32, tone_map: ToneMap) -> Result<Shown, String> {
    check_opaque(&image)?;
    let exposure = exposure_ev.exp2();
    floats(image, |rgb| {
        let toned = tone_map.apply(rgb * exposure);
        (toned, toned.to_array().map(srgb::encode_u8))
    })
}

/// `show` gives the value before it was clipped, and the three levels.
fn floats(image: DynamicImage, show: impl Fn(Vec3) -> (Vec3, [u8; 3])) -> Result<Shown, String> {
    let image = image.into_rgb32f();
    let (width, height) = image.dimensions();
    let mut clipped = 0_u64;
    let mut levels = Vec::with_capacity(3 * width as usize * height as usize);
    for (x, y, pixel) in image.enumerate_pixels() {
        let (value, shown) = show(Vec3::from(pixel.0));
        if !Vec3::from(pixel.0).is_finite() || !value.is_finite() {
            return Err(format!(
                "the pixel at column {x}, row {y} is {:?}, which is no colour; render it again without NaN and infinity",
                pixel.0
            ));
        }
        // An encoded level lies within half a step of what it stands for.
        let is_out = value.min_element() < -0.5 / 255.0 || value.max_element() > 1.0 + 0.5 / 255.0;
        clipped += u64::from(is_out);
        levels.extend(shown);
    }
    Ok(Shown {
        picture: opaque((width, height), levels.chunks_exact(3)),
        clipped_share: clipped as f64 / (f64::from(width) * f64::from(height)),
    })
}

/// v · 255 / 65535 to the nearest whole number; 65535 is 255 · 257.
fn nearest_of_256(value: u16) -> u8 {
    ((u32::from(value) + 128) / 257) as u8
}

fn opaque<'a>(
    (width_px, height_px): (u32, u32),
    pixels: impl Iterator<Item = &'a [u8]>,
) -> Picture {
    Picture {
        width_px,
        height_px,
        rgba8: pixels.flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
    }
}

fn check_opaque(image: &DynamicImage) -> Result<(), String> {
    let see_through = match image {
        DynamicImage::ImageLumaA8(image) => position(image, 2, u8::MAX),
        DynamicImage::ImageRgba8(image) => position(image, 4, u8::MAX),
        DynamicImage::ImageLumaA16(image) => position(image, 2, u16::MAX),
        DynamicImage::ImageRgba16(image) => position(image, 4, u16::MAX),
        DynamicImage::ImageRgba32F(image) => position(image, 4, 1.0),
        _ => None,
    };
    let Some(index) = see_through else {
        return Ok(());
    };
    let width = image.width().max(1) as usize;
    Err(format!(
        "the pixel at column {}, row {} is transparent, and nothing says what is behind it; save the image without an alpha channel",
        index % width,
        index / width
    ))
}

/// Index of the first pixel whose alpha, the last channel, is not `opaque`.
fn position<T: PartialEq>(samples: &[T], channels: usize, opaque: T) -> Option<usize> {
    samples
        .chunks_exact(channels)
        .position(|pixel| pixel[channels - 1] != opaque)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Rgb, Rgb32FImage, Rgba32FImage};

    #[test]
    fn sixteen_bits_go_to_the_nearest_level() {
        for value in 0..=u16::MAX {
            let exact = f64::from(value) * 255.0 / 65_535.0;
            assert!((f64::from(nearest_of_256(value)) - exact).abs() <= 0.5);
        }
        let levels: Vec<u16> = (0..=255).map(|level| level * 257).collect();
        let wide = ImageBuffer::<Rgb<u16>, _>::from_fn(256, 1, |x, _| Rgb([levels[x as usize]; 3]));
        let shown = displayed(DynamicImage::ImageRgb16(wide)).unwrap();
        let found: Vec<u8> = shown.picture.rgba8.chunks(4).map(|p| p[0]).collect();
        assert_eq!(found, (0..=255).collect::<Vec<u8>>());
    }

    /// 18 % light is level 118; one stop up is 36 %, level 162; 5 is clipped, and reported.
    #[test]
    fn linear_light_is_exposed_encoded_and_clipped() {
        let pixels = [0.18, 0.36, 5.0, 0.0_f32];
        let image = || Rgb32FImage::from_fn(4, 1, |x, _| Rgb([pixels[x as usize]; 3])).into();
        let levels =
            |shown: Shown| -> Vec<u8> { shown.picture.rgba8.chunks(4).map(|p| p[1]).collect() };
        let plain = linear(image(), 0.0, ToneMap::None).unwrap();
        assert!((plain.clipped_share - 0.25).abs() < 1e-12);
        assert_eq!(levels(plain), [118, 162, 255, 0]);
        let up = linear(image(), 1.0, ToneMap::None).unwrap();
        assert_eq!(levels(up)[0], 162);
        let toned = linear(image(), 0.0, ToneMap::ReinhardExtended { white: 5.0 }).unwrap();
        assert!(toned.clipped_share == 0.0);
        assert_eq!(levels(toned)[2..], [255, 0]);
    }

    #[test]
    fn what_is_no_colour_is_refused_with_its_place() {
        for bad in [f32::NAN, f32::INFINITY] {
            let image = Rgb32FImage::from_fn(3, 2, |x, y| {
                Rgb([if (x, y) == (2, 1) { bad } else { 0.5 }; 3])
            });
            let message = linear(image.into(), 0.0, ToneMap::Aces).unwrap_err();
            assert!(message.contains("column 2, row 1"), "{message}");
        }
    }

    #[test]
    fn transparency_is_refused_with_its_place() {
        let image = Rgba32FImage::from_fn(3, 2, |x, y| {
            image::Rgba([0.5, 0.5, 0.5, if (x, y) == (1, 1) { 0.0 } else { 1.0 }])
        });
        let message = linear(image.into(), 0.0, ToneMap::None).unwrap_err();
        assert!(message.contains("column 1, row 1"), "{message}");
    }
}
