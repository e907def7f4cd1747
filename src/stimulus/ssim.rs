//! SSIM: how alike the structure of two pictures is.
//!
//! Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
//! Structural Similarity", IEEE Trans. Image Process. 13(4), equations 13 to 17: a Gaussian window
//! of 11×11 pixels with a standard deviation of 1.5, K1 = 0.01, K2 = 0.03, and 255 as the range of
//! the values. They are luma, 0.299 R + 0.587 G + 0.114 B of the displayed levels (ITU-R BT.601,
//! the one that the authors' program takes), not rounded.

use rayon::prelude::*;

use super::difference::{SizesDiffer, check_sizes};
use super::manifest::Picture;
use super::plane::{Border, Plane};

/// Pixels from the middle of the window to its edge.
const RADIUS_PX: usize = 5;
/// Standard deviation of the window, pixels.
const DEVIATION_PX: f64 = 1.5;
/// (K1 · 255)² and (K2 · 255)², which keep dark and flat windows from dividing by nothing.
const C1: f32 = 6.5025;
const C2: f32 = 58.5225;
/// Taken off the luma before squares are summed: variances stay as they are, and single precision
/// loses less of them.
const MIDDLE: f32 = 128.0;

/// How alike two pictures are, pixel by pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct SsimMap {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// -1 (the opposite) to 1 (the same), rows from the top. A window that reaches over the edge
    /// finds the picture mirrored there, the pixel of the edge twice.
    pub values: Vec<f32>,
}

impl SsimMap {
    /// Mean over the windows that lie wholly inside, -1 to 1, as in the paper; over all windows
    /// along a side that is shorter than one. 1 for no pixels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let inside = |length: usize| match length > 2 * RADIUS_PX {
            true => RADIUS_PX..length - RADIUS_PX,
            false => 0..length,
        };
        let width = self.width_px as usize;
        let columns = inside(width);
        let count = columns.len() * inside(self.height_px as usize).len();
        if count == 0 {
            return 1.0;
        }
        let sum: f64 = inside(self.height_px as usize)
            .flat_map(|y| &self.values[y * width..][columns.clone()])
            .map(|&value| f64::from(value))
            .sum();
        sum / count as f64
    }
}

/// Compares two pictures; it does not matter which comes first.
///
/// # Errors
/// [`SizesDiffer`].
pub fn ssim(first: &Picture, second: &Picture) -> Result<SsimMap, SizesDiffer> {
    check_sizes(first, second)?;
    let window = window();
    let smooth = |plane: &Plane| plane.filtered(&window, &window, Border::Mirror);
    let [a, b] = [first, second].map(|picture| Plane::of(picture, |colour| luma(colour) - MIDDLE));
    let product = |a: &Plane, b: &Plane| smooth(&a.zip(b, |a, b| a * b)).values;
    let (squares_a, squares_b, products) = (product(&a, &a), product(&b, &b), product(&a, &b));
    let (means_a, means_b) = (smooth(&a).values, smooth(&b).values);
    let values = (0..products.len())
        .into_par_iter()
        .map(|i| {
            let (mean_a, mean_b) = (means_a[i], means_b[i]);
            similarity(
                [mean_a + MIDDLE, mean_b + MIDDLE],
                [
                    squares_a[i] - mean_a * mean_a,
                    squares_b[i] - mean_b * mean_b,
                ],
                products[i] - mean_a * mean_b,
            )
        })
        .collect();
    Ok(SsimMap {
        width_px: first.width_px,
        height_px: first.height_px,
        values,
    })
}

/// Equation 13 of two windows, of their means, variances and covariance.
fn similarity([mean_a, mean_b]: [f32; 2], [var_a, var_b]: [f32; 2], covariance: f32) -> f32 {
    // Rounding may leave a flat window a variance under 0.
    let variances = var_a.max(0.0) + var_b.max(0.0);
    let covariance = covariance.clamp(-0.5 * variances, 0.5 * variances);
    (2.0 * mean_a * mean_b + C1) * (2.0 * covariance + C2)
        / ((mean_a * mean_a + mean_b * mean_b + C1) * (variances + C2))
}

/// Luma of a displayed colour, 0 to 255.
fn luma([red, green, blue]: [u8; 3]) -> f32 {
    0.299 * f32::from(red) + 0.587 * f32::from(green) + 0.114 * f32::from(blue)
}

/// The weights along one side of the window; they sum to 1.
fn window() -> Vec<f32> {
    let radius = RADIUS_PX as i32;
    let weights: Vec<f64> = (-radius..=radius)
        .map(|x| libm::exp(-0.5 * (f64::from(x) / DEVIATION_PX).powi(2)))
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| (w / sum) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stimulus::test_pictures::{against, flat, pair};
    use proptest::prelude::*;

    /// Every row of `tests/data/ssim.csv`: scikit-image 0.26.0 on the same pictures, by
    /// `tests/data/ssim.py`.
    #[test]
    fn it_agrees_with_scikit_image() {
        let table = include_str!("../../tests/data/ssim.csv");
        let (rows, worst) = against(table, 1, |lead| {
            let [first, second] = pair(lead[0]);
            let found = ssim(&first, &second).unwrap();
            (found.mean(), found.values)
        });
        assert_eq!(rows, 54);
        assert!(worst.0 < 1e-4, "{worst:?}");
    }

    /// Without variance only the term of the means is left: (2ab + C1) / (a² + b² + C1).
    #[test]
    fn flat_pictures_have_the_closed_form() {
        for (a, b) in [(0_u8, 255_u8), (100, 110), (1, 2), (200, 200)] {
            let found = ssim(&flat(a), &flat(b)).unwrap();
            let (a, b, c) = (f64::from(a), f64::from(b), f64::from(C1));
            let expected = (2.0 * a * b + c) / (a * a + b * b + c);
            assert!((found.mean() - expected).abs() < 1e-4, "{a} {b}");
            for &value in &found.values {
                assert!((f64::from(value) - expected).abs() < 1e-4, "{a} {b}");
            }
        }
    }

    #[test]
    fn the_same_picture_is_alike() {
        for name in ["gradient", "edge", "noise"] {
            let [picture, _] = pair(name);
            let found = ssim(&picture, &picture).unwrap();
            assert!(
                found.values.iter().all(|v| (v - 1.0).abs() < 1e-6),
                "{name}"
            );
        }
    }

    #[test]
    fn other_sizes_are_refused_and_small_ones_are_not() {
        let small = |width_px, height_px| Picture {
            width_px,
            height_px,
            rgba8: [9, 9, 9, 255].repeat((width_px * height_px) as usize),
        };
        assert!(ssim(&small(2, 3), &small(3, 2)).is_err());
        for (width_px, height_px) in [(0, 0), (1, 1), (3, 40), (11, 10)] {
            let picture = small(width_px, height_px);
            assert!((ssim(&picture, &picture).unwrap().mean() - 1.0).abs() < 1e-6);
        }
    }

    proptest! {
        #[test]
        fn within_its_range_and_the_same_both_ways(a: [[u8; 3]; 12], b: [[u8; 3]; 12]) {
            let picture = |colours: [[u8; 3]; 12]| Picture {
                width_px: 4,
                height_px: 3,
                rgba8: colours.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect(),
            };
            let found = ssim(&picture(a), &picture(b)).unwrap();
            prop_assert!(found.values.iter().all(|value| value.abs() <= 1.0 + 1e-6));
            prop_assert_eq!(found, ssim(&picture(b), &picture(a)).unwrap());
        }
    }
}
