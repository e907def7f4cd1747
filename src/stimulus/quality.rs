//! How far images are from others, for whoever chooses by it: the scripted observer `model`.

use std::path::Path;

use rayon::prelude::*;

use super::difference::{SizesDiffer, check_sizes};
use super::flip::{self, FlipError};
use super::manifest::{ImageRecord, Picture, StimulusError};
use crate::scene::srgb;

/// Why two images of a set have no distance.
#[derive(Debug, thiserror::Error)]
pub enum DistanceError {
    /// An image is not there or not what it was.
    #[error(transparent)]
    Image(#[from] StimulusError),
    /// The pictures cannot be compared.
    #[error("{} and {}: {source}", first.display(), second.display())]
    Compared {
        /// File of the one.
        first: std::path::PathBuf,
        /// File of the other.
        second: std::path::PathBuf,
        /// Why.
        source: FlipError,
    },
}

/// A distance of two pictures: [`flip_mean`] or [`lightness_rmse`].
pub type Measure<'a> = &'a (dyn Fn(&Picture, &Picture) -> Result<f64, FlipError> + Sync);

/// Mean FLIP, 0 to 1, seen with so many pixels in a degree of the visual field.
///
/// # Errors
/// As [`flip::flip`].
pub fn flip_mean(
    first: &Picture,
    second: &Picture,
    pixels_per_degree: f32,
) -> Result<f64, FlipError> {
    flip::flip(first, second, pixels_per_degree).map(|map| map.mean())
}

/// Root of the mean squared difference of lightness, 0 to 100.
///
/// Lightness is CIE 1976 L* of the luminance that the 8-bit sRGB colour stands for (white is
/// 100): equal steps look about equal, which steps of linear light and of sRGB levels do less.
///
/// # Errors
/// [`SizesDiffer`].
pub fn lightness_rmse(first: &Picture, second: &Picture) -> Result<f64, SizesDiffer> {
    check_sizes(first, second)?;
    let pixels = |picture: &'_ Picture| picture.rgba8.len() / 4;
    let lightness = |pixel: &[u8]| {
        lightness(f64::from(srgb::luminance_u8([
            pixel[0], pixel[1], pixel[2],
        ])))
    };
    let squares = first
        .rgba8
        .chunks_exact(4)
        .zip(second.rgba8.chunks_exact(4));
    let sum: f64 = squares
        .filter(|(a, b)| a[..3] != b[..3])
        .map(|(a, b)| (lightness(a) - lightness(b)).powi(2))
        .sum();
    Ok((sum / pixels(first).max(1) as f64).sqrt())
}

/// CIE 1976 L* of a relative luminance, 0 to 1 (CIE 15:2018, equation 8.3).
fn lightness(luminance: f64) -> f64 {
    let delta = 6.0_f64 / 29.0;
    let root = if luminance > delta.powi(3) {
        libm::cbrt(luminance)
    } else {
        luminance / (3.0 * delta * delta) + 4.0 / 29.0
    };
    116.0 * root - 16.0
}

/// The distance of each pair of images of the set in `folder`; `done` is told after each.
///
/// # Errors
/// [`DistanceError`] of one that has none.
pub fn distances(
    folder: &Path,
    pairs: &[[&ImageRecord; 2]],
    measure: Measure<'_>,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<f64>, DistanceError> {
    let distance = |[first, second]: &[&ImageRecord; 2]| {
        let [a, b] = [first.load(folder)?, second.load(folder)?];
        let found = measure(&a, &b).map_err(|source| DistanceError::Compared {
            first: first.file.clone(),
            second: second.file.clone(),
            source,
        })?;
        done();
        Ok(found)
    };
    pairs.par_iter().map(distance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stimulus::test_pictures::flat;

    fn grey(level: u8, other: u8) -> Picture {
        let rgba8 = [level, level, level, 255, other, other, other, 255].to_vec();
        Picture {
            width_px: 2,
            height_px: 1,
            rgba8,
        }
    }

    /// L* of sRGB greys as colour science tables have them: 119 is 50.03, 0 is 0, 255 is 100.
    #[test]
    fn lightness_is_that_of_the_tables() {
        for (level, expected) in [(0, 0.0), (119, 50.03), (128, 53.585), (255, 100.0)] {
            let found = lightness_rmse(&flat(0), &flat(level)).unwrap();
            assert!((found - expected).abs() < 0.01, "{level}: {found}");
        }
    }

    /// One pixel of two differs by all of L*: the root of a half.
    #[test]
    fn squares_are_averaged_over_the_pixels() {
        let found = lightness_rmse(&grey(0, 0), &grey(0, 255)).unwrap();
        assert!((found - 100.0 * 0.5_f64.sqrt()).abs() < 1e-4, "{found}");
        assert_eq!(lightness_rmse(&grey(7, 9), &grey(7, 9)).unwrap(), 0.0);
        assert!(lightness_rmse(&grey(0, 0), &flat(0)).is_err());
    }
}
