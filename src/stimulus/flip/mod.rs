//! FLIP: how different two pictures look to somebody who flips between them.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference
//! Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), article 15;
//! here for pictures of low dynamic range. Colours are filtered by what the eye resolves at the
//! viewing distance and compared; where edges or points differ, the difference counts for more.
//! Filters that reach over the edge of a picture find its outermost pixel there, as in NVIDIA's
//! own program, which this agrees with (`tests/data/flip.py`).

mod colour;
mod features;

use rayon::prelude::*;

use super::difference::{SizesDiffer, check_sizes};
use super::manifest::Picture;
use colour::Colours;

/// Fewest pixels in a degree of the visual field that the filters are meant for.
pub const LOWEST_PIXELS_PER_DEGREE: f32 = 2.0;
/// Most pixels in a degree of the visual field: no display has more, and the filters grow with it.
pub const HIGHEST_PIXELS_PER_DEGREE: f32 = 1000.0;

/// How a display is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewing {
    /// From the eye to the display, metres.
    pub distance_m: f32,
    /// Columns of the whole display.
    pub display_width_px: f32,
    /// Width of the whole display, metres.
    pub display_width_m: f32,
}

impl Default for Viewing {
    /// What the paper takes where nothing is known: 0.7 m from a display 0.7 m
    /// wide with 3840 columns, 67.02 pixels a degree.
    fn default() -> Self {
        Self {
            distance_m: 0.7,
            display_width_px: 3840.0,
            display_width_m: 0.7,
        }
    }
}

impl Viewing {
    /// Pixels in one degree of the visual field, in the middle of the display.
    #[must_use]
    pub fn pixels_per_degree(self) -> f32 {
        self.distance_m * (self.display_width_px / self.display_width_m) * 1_f32.to_radians()
    }
}

/// Why two pictures have no FLIP.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FlipError {
    /// The pictures cannot be laid over each other.
    #[error(transparent)]
    Sizes(#[from] SizesDiffer),
    /// Too few, too many, or not a number.
    #[error(
        "{0} pixels a degree are not within {LOWEST_PIXELS_PER_DEGREE} to {HIGHEST_PIXELS_PER_DEGREE}"
    )]
    PixelsPerDegree(f32),
}

/// The visible difference of two pictures, pixel by pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct FlipMap {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// 0 (no difference) to 1 (the largest there is), rows from the top.
    pub values: Vec<f32>,
}

impl FlipMap {
    /// Mean over the pixels, 0 to 1; 0 for no pixels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.values.iter().copied().map(f64::from).sum();
        sum / self.values.len().max(1) as f64
    }

    /// The smallest value that at least a `share`, 0 to 1, of the pixels do not exceed (nearest
    /// rank): 0.5 gives the median, 1 the maximum. 0 for no pixels.
    #[must_use]
    pub fn percentile(&self, share: f64) -> f32 {
        if self.values.is_empty() {
            return 0.0;
        }
        let count = self.values.len();
        // Saturating: a share under 0 or NaN gives the first.
        let rank = ((share * count as f64).ceil() as usize).clamp(1, count);
        let mut values = self.values.clone();
        *values.select_nth_unstable_by(rank - 1, f32::total_cmp).1
    }

    /// The largest value, 0 to 1; 0 for no pixels.
    #[must_use]
    pub fn maximum(&self) -> f32 {
        self.values.iter().copied().fold(0.0, f32::max)
    }
}

/// Compares `test` with `reference`, seen with so many pixels in a degree of the visual field
/// ([`Viewing::pixels_per_degree`]), 2 to 1000. It does not matter which of the two is which.
///
/// # Errors
/// [`FlipError`].
pub fn flip(
    reference: &Picture,
    test: &Picture,
    pixels_per_degree: f32,
) -> Result<FlipMap, FlipError> {
    check_sizes(reference, test)?;
    if !(LOWEST_PIXELS_PER_DEGREE..=HIGHEST_PIXELS_PER_DEGREE).contains(&pixels_per_degree) {
        return Err(FlipError::PixelsPerDegree(pixels_per_degree));
    }
    let colours = Colours::new();
    let opponents = [reference, test].map(|picture| colours.opponents(picture));
    let [lab, test_lab] = opponents
        .each_ref()
        .map(|channels| colours.seen(channels, pixels_per_degree));
    let [found, test_found] = opponents
        .each_ref()
        .map(|channels| features::strengths(&channels[0], pixels_per_degree));
    let largest = colours.largest_distance();
    let colour = lab.par_iter().zip(&test_lab);
    let feature = found.par_iter().zip(&test_found);
    let values = colour
        .zip(feature)
        .map(|((&a, &b), (&c, &d))| {
            let colour = colour::difference(a, b, largest);
            // The paper's final difference: features bend the colour's difference upwards.
            libm::powf(colour, 1.0 - features::difference(c, d))
        })
        .collect();
    Ok(FlipMap {
        width_px: reference.width_px,
        height_px: reference.height_px,
        values,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stimulus::test_pictures::{against, flat, pair};
    use proptest::prelude::*;

    fn map(values: &[f32]) -> FlipMap {
        FlipMap {
            width_px: values.len() as u32,
            height_px: 1,
            values: values.to_vec(),
        }
    }

    /// Every row of `tests/data/flip.csv`: NVIDIA's flip-evaluator 1.7 on the same pictures, by
    /// `tests/data/flip.py`.
    #[test]
    fn it_agrees_with_nvidias_own() {
        let table = include_str!("../../../tests/data/flip.csv");
        let (rows, worst) = against(table, 2, |lead| {
            let [reference, test] = pair(lead[0]);
            let found = flip(&reference, &test, lead[1].parse().unwrap()).unwrap();
            (found.mean(), found.values)
        });
        assert_eq!(rows, 108);
        assert!(worst.0 < 1e-4, "{worst:?}");
    }

    #[test]
    fn the_same_picture_does_not_differ() {
        for name in ["gradient", "edge", "noise"] {
            let [picture, _] = pair(name);
            let found = flip(&picture, &picture, 67.0).unwrap();
            assert!(found.values.iter().all(|&value| value == 0.0), "{name}");
        }
    }

    /// Not 1: the largest distance is that of green and blue, not of black and white.
    #[test]
    fn black_and_white_are_nearly_as_far_as_can_be() {
        let found = flip(&flat(0), &flat(255), 67.0).unwrap();
        let value = found.values[0];
        assert!((0.95..1.0).contains(&value), "{value}");
        assert!(
            found
                .values
                .iter()
                .all(|other| (other - value).abs() < 1e-4)
        );
    }

    #[test]
    fn other_sizes_and_viewings_are_refused() {
        let picture = flat(9);
        let turned = Picture {
            width_px: picture.height_px,
            height_px: picture.width_px,
            ..picture.clone()
        };
        let refused = flip(&picture, &turned, 67.0);
        assert!(matches!(refused, Err(FlipError::Sizes(_))));
        for wrong in [f32::NAN, -67.0, 0.0, 1.9, 1001.0, f32::INFINITY] {
            let refused = flip(&picture, &picture, wrong);
            assert!(matches!(refused, Err(FlipError::PixelsPerDegree(_))));
        }
        let empty = Picture {
            width_px: 0,
            height_px: 0,
            rgba8: Vec::new(),
        };
        assert_eq!(flip(&empty, &empty, 67.0).unwrap().mean(), 0.0);
    }

    /// The paper's own number, and a display of half the columns from half as far.
    #[test]
    fn pixels_of_a_degree() {
        let paper = Viewing::default();
        assert!((paper.pixels_per_degree() - 67.020_64).abs() < 1e-3);
        let near = Viewing {
            distance_m: 0.35,
            display_width_px: 1920.0,
            ..paper
        };
        assert!((near.pixels_per_degree() - 67.020_64 / 4.0).abs() < 1e-3);
    }

    #[test]
    fn percentiles_are_values_of_pixels() {
        let found = map(&[0.4, 0.1, 0.3, 0.2]);
        let shares = [0.0, 0.25, 0.26, 0.5, 0.75, 1.0].map(|share| found.percentile(share));
        assert_eq!(shares, [0.1, 0.1, 0.2, 0.2, 0.3, 0.4]);
        assert_eq!(found.maximum(), 0.4);
        assert!((found.mean() - 0.25).abs() < 1e-7);
        let none = map(&[]);
        assert_eq!(
            (none.percentile(0.5), none.maximum(), none.mean()),
            (0.0, 0.0, 0.0)
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn within_0_and_1_and_the_same_both_ways(
            a: [[u8; 3]; 12], b: [[u8; 3]; 12], ppd in 2.0_f32..120.0,
        ) {
            let picture = |colours: [[u8; 3]; 12]| Picture {
                width_px: 4,
                height_px: 3,
                rgba8: colours.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect(),
            };
            let found = flip(&picture(a), &picture(b), ppd).unwrap();
            prop_assert!(found.values.iter().all(|value| (0.0..=1.0).contains(value)));
            prop_assert_eq!(found, flip(&picture(b), &picture(a), ppd).unwrap());
        }
    }
}
