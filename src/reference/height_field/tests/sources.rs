//! Heights and albedos from files: what is there, and what is refused with its place.

use std::path::Path;

use exr::prelude::{Image, SpecificChannels, WritableImage};
use image::{GrayImage, ImageBuffer, Luma, Rgb, RgbImage};

use super::*;

fn heights(path: &Path) -> Result<HeightMap, MapError> {
    HeightSource::named(&path.display().to_string(), 64)?.heights(1)
}

#[test]
fn levels_are_heights_from_the_lowest_to_the_highest() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = folder.path().join("bytes.png");
    GrayImage::from_fn(4, 2, |x, y| Luma([(60 + 10 * (x + 4 * y)) as u8]))
        .save(&bytes)
        .unwrap();
    let map = heights(&bytes).unwrap();
    assert_eq!((map.width, map.height), (4, 2));
    assert_eq!((map.heights[0], map.heights[7]), (0.0, 1.0));
    assert!((map.heights[1] - 1.0 / 7.0).abs() < 1e-6);
    // Steps that 8 bits do not have.
    let words = folder.path().join("words.png");
    let image: ImageBuffer<Luma<u16>, Vec<u16>> =
        ImageBuffer::from_fn(3, 3, |x, y| Luma([1000 + (x + 3 * y) as u16]));
    image.save(&words).unwrap();
    let map = heights(&words).unwrap();
    assert!((map.heights[4] - 0.5).abs() < 1e-4, "{:?}", map.heights);
    let even = folder.path().join("even.png");
    GrayImage::from_pixel(5, 5, Luma([77])).save(&even).unwrap();
    assert!(heights(&even).unwrap().is_even());
}

fn exr_of(path: &Path, value: impl Fn(usize, usize) -> f32 + Sync) {
    let channels = SpecificChannels::build()
        .with_channel("Y")
        .with_pixel_fn(|at| (value(at.x(), at.y()),));
    Image::from_channels((5, 4), channels)
        .write()
        .to_file(path)
        .unwrap();
}

#[test]
fn a_grey_exr_is_read_and_what_is_no_number_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let good = folder.path().join("good.exr");
    exr_of(&good, |x, y| 3.0 + (x + 5 * y) as f32);
    let map = heights(&good).unwrap();
    assert_eq!((map.width, map.height, map.heights[19]), (5, 4, 1.0));
    let bad = folder.path().join("bad.exr");
    exr_of(&bad, |x, y| if (x, y) == (3, 2) { f32::NAN } else { 0.5 });
    let message = heights(&bad).unwrap_err().to_string();
    assert!(
        message.contains("column 3, row 2 is NaN") && message.contains("bad.exr"),
        "{message}"
    );
}

#[test]
fn albedos_fit_their_heights_and_no_surface_sends_back_more_than_it_gets() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("colour.png");
    RgbImage::from_fn(4, 4, |x, _| Rgb([255, 188, 10 * x as u8]))
        .save(&path)
        .unwrap();
    let [red, green, blue] = albedo_map(&path, (4, 4)).unwrap();
    // sRGB 188 is half the light; 255 all of it.
    assert!(red[0] == 1.0 && (green[5] - 0.503).abs() < 2e-3 && blue[0] == 0.0);
    let message = albedo_map(&path, (8, 4)).unwrap_err().to_string();
    assert!(
        message.contains("4×4") && message.contains("8×4"),
        "{message}"
    );
    let bright = folder.path().join("bright.exr");
    exr_of(&bright, |x, y| if (x, y) == (1, 3) { 1.5 } else { 0.5 });
    let message = albedo_map(&bright, (5, 4)).unwrap_err().to_string();
    assert!(message.contains("column 1, row 3 is 1.5"), "{message}");
}

#[test]
fn what_is_no_map_is_said_with_what_there_is() {
    let message = HeightSource::named("brick", 64).unwrap_err().to_string();
    assert!(message.contains("bricks, pebbles"), "{message}");
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("notes.png");
    std::fs::write(&text, "no picture").unwrap();
    assert!(
        heights(&text)
            .unwrap_err()
            .to_string()
            .contains("notes.png")
    );
}

/// Two colours of texels: light that has been on red ones is red.
#[test]
fn a_bounce_takes_the_colour_of_where_it_was() {
    // A wall between two strips of ground: the left one lies before a wall of its own colour.
    let steps = super::field(64, Border::Open, |x, _| if x >= 32.0 { 20.0 } else { 0.0 });
    let links = Links::cast(&steps, &LINKS, &|_| {});
    let wall: Vec<f32> = (0..64 * 64)
        .map(|texel| if texel % 64 >= 30 { 1.0 } else { 0.0 })
        .collect();
    let settings = TransportSettings {
        bounces: 4,
        least: 0.0,
    };
    let lit = Bounces::follow(&links, &wall, &settings);
    let dark = Bounces::follow(&links, &vec![0.0; 64 * 64], &settings);
    let beside = 32 * 64 + 26;
    assert!(
        lit.sum(beside) > 1.2 * dark.sum(beside),
        "{} {}",
        lit.sum(beside),
        dark.sum(beside)
    );
    // Ground that sends nothing back takes no second bounce from itself.
    let far = 32 * 64 + 2;
    assert!(lit.sum(far) < 1.05 * dark.sum(far) + 0.1);
}
