use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage, RgbImage, Rgba, RgbaImage};
use proptest::prelude::*;

use super::*;

fn gradient() -> RgbImage {
    RgbImage::from_fn(16, 9, |x, y| Rgb([x as u8 * 16, y as u8 * 28, 77]))
}

fn encode(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn described() -> LoadedImage {
    LoadedImage {
        label: String::from("a"),
        file: PathBuf::from("a"),
        path: PathBuf::from("a"),
        colour_space: None,
        exposure_ev: None,
        tone_map: None,
        metadata: BTreeMap::new(),
    }
}

fn convert(bytes: &[u8]) -> Result<Loaded, String> {
    described().convert(bytes, None)
}

fn rgb8(picture: &Picture) -> Vec<u8> {
    let pixels = picture.rgba8.chunks_exact(4);
    pixels.flat_map(|p| [p[0], p[1], p[2]]).collect()
}

/// Puts a chunk behind the header of a PNG.
fn with_chunk(png: &[u8], name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut chunk = name.to_vec();
    chunk.extend(data);
    let checksum = crc32fast::hash(&chunk);
    let mut bytes = png[..33].to_vec();
    bytes.extend((data.len() as u32).to_be_bytes());
    bytes.extend(chunk);
    bytes.extend(checksum.to_be_bytes());
    bytes.extend(&png[33..]);
    bytes
}

#[test]
fn an_eight_bit_png_is_shown_as_it_is() {
    let loaded = convert(&encode(gradient(), ImageFormat::Png)).unwrap();
    assert_eq!(rgb8(&loaded.picture), gradient().into_raw());
    let source = &loaded.source;
    assert_eq!(
        (source.format.as_str(), source.bits_per_channel),
        ("PNG", 8)
    );
    assert_eq!(source.colour_space, "srgb");
    assert!(!source.colour_space_declared && loaded.warnings.is_empty());
}

#[test]
fn a_sixteen_bit_png_comes_back_to_its_levels() {
    let wide = DynamicImage::from(gradient()).into_rgb16();
    let loaded = convert(&encode(wide, ImageFormat::Png)).unwrap();
    assert_eq!(rgb8(&loaded.picture), gradient().into_raw());
    assert_eq!(loaded.source.bits_per_channel, 16);
}

#[test]
fn greys_and_opaque_alpha_are_taken() {
    let grey = DynamicImage::from(gradient()).into_luma8();
    let loaded = convert(&encode(grey.clone(), ImageFormat::Png)).unwrap();
    let expected: Vec<u8> = grey.iter().flat_map(|&level| [level; 3]).collect();
    assert_eq!(rgb8(&loaded.picture), expected);
    let opaque = DynamicImage::from(gradient()).into_rgba8();
    let loaded = convert(&encode(opaque, ImageFormat::Png)).unwrap();
    assert_eq!(rgb8(&loaded.picture), gradient().into_raw());
}

#[test]
fn a_jpeg_is_taken_with_a_warning() {
    let loaded = convert(&encode(gradient(), ImageFormat::Jpeg)).unwrap();
    assert_eq!(loaded.source.format, "JPEG");
    assert!(loaded.warnings[0].contains("compression"));
}

#[test]
fn an_exr_is_exposed_and_its_clipping_reported() {
    let light = Rgb32FImage::from_fn(10, 1, |x, _| Rgb([if x == 0 { 9.0 } else { 0.18 }; 3]));
    let bytes = encode(light, ImageFormat::OpenExr);
    let loaded = convert(&bytes).unwrap();
    assert_eq!(loaded.picture.rgba8[4..8], [118, 118, 118, 255]);
    assert_eq!(loaded.source.colour_space, "linear");
    assert_eq!(loaded.source.bits_per_channel, 32);
    assert!((loaded.source.clipped_share - 0.1).abs() < 1e-12);
    assert!(
        loaded.warnings[0].contains("10.0 %"),
        "{:?}",
        loaded.warnings
    );
    let toned = LoadedImage {
        exposure_ev: Some(1.0),
        tone_map: Some(ToneMap::ReinhardExtended { white: 18.0 }),
        ..described()
    };
    let toned = toned.convert(&bytes, None).unwrap();
    assert!(toned.warnings.is_empty());
    assert_eq!(
        toned.source.tone_map.unwrap(),
        "reinhard-extended, white 18"
    );
}

#[test]
fn colour_spaces_are_known_by_their_tags() {
    let png = encode(gradient(), ImageFormat::Png);
    let u32s =
        |values: &[u32]| -> Vec<u8> { values.iter().flat_map(|v| v.to_be_bytes()).collect() };
    let tagged = |name: &[u8; 4], data: &[u8]| convert(&with_chunk(&png, name, data));
    let space = |loaded: Result<Loaded, String>| loaded.unwrap().source.colour_space;
    assert_eq!(space(tagged(b"sRGB", &[0])), "srgb");
    assert_eq!(space(tagged(b"gAMA", &u32s(&[45_455]))), "srgb");
    assert_eq!(space(tagged(b"gAMA", &u32s(&[100_000]))), "linear");
    assert_eq!(space(tagged(b"cICP", &[1, 13, 0, 1])), "srgb");
    let srgb = [
        31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000,
    ];
    assert_eq!(space(tagged(b"cHRM", &u32s(&srgb))), "srgb");

    let p3 = [
        31_270, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6_000,
    ];
    for (name, data, part) in [
        (b"gAMA", u32s(&[55_556]), "0.556"),
        (b"cHRM", u32s(&p3), "primaries"),
        (b"cICP", vec![9, 16, 0, 1], "[9, 16, 0, 1]"),
    ] {
        let message = tagged(name, &data).unwrap_err();
        assert!(
            message.contains(part) && message.contains("colour_space"),
            "{message}"
        );
    }
    // The set's word stands against the file's.
    let declared = LoadedImage {
        colour_space: Some(ColourSpace::Srgb),
        ..described()
    };
    let loaded = declared
        .convert(&with_chunk(&png, b"cHRM", &u32s(&p3)), None)
        .unwrap();
    assert_eq!(rgb8(&loaded.picture), gradient().into_raw());
    assert!(loaded.source.colour_space_declared);
}

#[test]
fn exposure_is_for_linear_values() {
    let exposed = LoadedImage {
        exposure_ev: Some(1.0),
        ..described()
    };
    let message = exposed
        .convert(&encode(gradient(), ImageFormat::Png), None)
        .unwrap_err();
    assert!(message.contains("exposure_ev"), "{message}");
}

#[test]
fn what_cannot_be_shown_is_refused_in_words() {
    let glass = RgbaImage::from_pixel(4, 3, Rgba([9, 9, 9, 128]));
    let bmp = [b"BM".as_slice(), &[0; 60]].concat();
    for (bytes, part) in [
        (encode(glass, ImageFormat::Png), "transparent"),
        (bmp, "PNG, JPEG or OpenEXR"),
        (b"hello".to_vec(), "no image"),
        (Vec::new(), "empty"),
    ] {
        let message = convert(&bytes).unwrap_err();
        assert!(message.contains(part), "{message}");
    }
    let other_size = described().convert(&encode(gradient(), ImageFormat::Png), Some((16, 10)));
    let message = other_size.unwrap_err();
    assert!(
        message.contains("16×9") && message.contains("16×10"),
        "{message}"
    );
}

/// A header that claims 60000 × 60000 pixels is refused before anything is allocated for them.
#[test]
fn a_bomb_is_refused() {
    let mut png = encode(gradient(), ImageFormat::Png);
    png[16..20].copy_from_slice(&60_000_u32.to_be_bytes());
    png[20..24].copy_from_slice(&60_000_u32.to_be_bytes());
    let checksum = crc32fast::hash(&png[12..29]);
    png[29..33].copy_from_slice(&checksum.to_be_bytes());
    let started = std::time::Instant::now();
    assert!(convert(&png).is_err());
    assert!(started.elapsed().as_secs() < 2);
}

#[test]
fn every_truncation_is_refused() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::OpenExr] {
        let image = DynamicImage::from(gradient());
        let whole = match format {
            ImageFormat::OpenExr => encode(image.into_rgb32f(), format),
            _ => encode(image, format),
        };
        // A PNG's last chunk, 12 bytes, is empty: all pixels are there before it.
        let last = if format == ImageFormat::Png {
            whole.len() - 12
        } else {
            whole.len()
        };
        for length in 0..last {
            assert!(
                convert(&whole[..length]).is_err(),
                "{format:?} cut at {length}"
            );
        }
    }
}

fn damaged(bytes: &[u8], flips: &[(prop::sample::Index, u8)]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (index, mask) in flips {
        let at = index.index(bytes.len());
        bytes[at] ^= mask;
    }
    bytes
}

proptest! {
    /// Damage ends in a message or in a picture, and never in a panic.
    #[test]
    fn flipped_bytes_never_panic(
        flips in prop::collection::vec((any::<prop::sample::Index>(), 1_u8..), 1..6),
    ) {
        let image = DynamicImage::from(gradient());
        for bytes in [
            encode(image.clone(), ImageFormat::Png),
            encode(image.clone(), ImageFormat::Jpeg),
            encode(image.into_rgb32f(), ImageFormat::OpenExr),
        ] {
            match convert(&damaged(&bytes, &flips)) {
                Ok(loaded) => {
                    let pixels = u64::from(loaded.picture.width_px) * u64::from(loaded.picture.height_px);
                    prop_assert_eq!(loaded.picture.rgba8.len() as u64, 4 * pixels);
                }
                Err(message) => prop_assert!(!message.is_empty()),
            }
        }
    }
}
