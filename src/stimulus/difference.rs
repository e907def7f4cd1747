//! How much two images of one size differ, pixel by pixel, in levels of 8-bit sRGB.

use super::manifest::Picture;

/// The difference of two images. A pixel differs by the largest difference of its three channels.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// The largest difference of any pixel, levels.
    pub largest: u8,
    /// Column and row of the first pixel that differs by it.
    pub largest_at_px: (u32, u32),
    /// Mean absolute difference of a channel, levels.
    pub mean_abs: f64,
    /// Root of the mean squared difference of a channel, levels.
    pub rmse: f64,
    /// How many pixels differ by each number of levels.
    histogram: Box<[u64; 256]>,
}

/// Two images that cannot be compared pixel by pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "one image is {}×{} pixels and the other {}×{}; both must have one size",
    first_px.0, first_px.1, second_px.0, second_px.1
)]
pub struct SizesDiffer {
    /// Columns and rows of the first.
    pub first_px: (u32, u32),
    /// Columns and rows of the second.
    pub second_px: (u32, u32),
}

impl Difference {
    /// Compares two images.
    ///
    /// # Errors
    /// [`SizesDiffer`].
    pub fn between(first: &Picture, second: &Picture) -> Result<Self, SizesDiffer> {
        check_sizes(first, second)?;
        let mut histogram = Box::new([0_u64; 256]);
        let (mut sum, mut squares) = (0_u64, 0_u64);
        let (mut largest, mut largest_at) = (0, 0);
        for (index, apart) in apart(first, second).enumerate() {
            let worst = apart.into_iter().max().unwrap_or(0);
            histogram[usize::from(worst)] += 1;
            if worst > largest {
                (largest, largest_at) = (worst, index);
            }
            for channel in apart.map(u64::from) {
                sum += channel;
                squares += channel * channel;
            }
        }
        let width = first.width_px.max(1);
        let channels = 3.0 * (f64::from(width) * f64::from(first.height_px)).max(1.0);
        // Both fit: an index into pixels counted by two u32.
        let place = |index: usize| index.try_into().unwrap_or(u32::MAX);
        Ok(Self {
            largest,
            largest_at_px: (
                place(largest_at % width as usize),
                place(largest_at / width as usize),
            ),
            mean_abs: sum as f64 / channels,
            rmse: (squares as f64 / channels).sqrt(),
            histogram,
        })
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        self.histogram.iter().sum()
    }

    /// Share of pixels, 0 to 1, that differ by no more than `levels`; 1 for no pixels.
    #[must_use]
    pub fn share_within(&self, levels: u8) -> f64 {
        let within: u64 = self.histogram[..=usize::from(levels)].iter().sum();
        match self.pixels() {
            0 => 1.0,
            pixels => within as f64 / pixels as f64,
        }
    }
}

/// The absolute difference of each channel, multiplied by `gain` and clipped at white; black
/// where the images agree.
///
/// # Errors
/// [`SizesDiffer`].
pub fn difference_picture(
    first: &Picture,
    second: &Picture,
    gain: u32,
) -> Result<Picture, SizesDiffer> {
    check_sizes(first, second)?;
    let amplify = |channel: u8| u32::from(channel).saturating_mul(gain).min(255) as u8;
    Ok(Picture {
        width_px: first.width_px,
        height_px: first.height_px,
        rgba8: apart(first, second)
            .flat_map(|[red, green, blue]| [amplify(red), amplify(green), amplify(blue), 255])
            .collect(),
    })
}

fn apart<'a>(first: &'a Picture, second: &'a Picture) -> impl Iterator<Item = [u8; 3]> + 'a {
    let pixels = |picture: &'a Picture| picture.rgba8.chunks_exact(4);
    pixels(first)
        .zip(pixels(second))
        .map(|(a, b)| [0, 1, 2].map(|channel: usize| a[channel].abs_diff(b[channel])))
}

/// Refuses two images of different sizes.
pub(super) fn check_sizes(first: &Picture, second: &Picture) -> Result<(), SizesDiffer> {
    let size = |picture: &Picture| (picture.width_px, picture.height_px);
    if size(first) == size(second) {
        return Ok(());
    }
    Err(SizesDiffer {
        first_px: size(first),
        second_px: size(second),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// 4×2 pixels of one grey, with single pixels changed.
    fn grey(changes: &[(usize, [u8; 3])]) -> Picture {
        let mut rgba8 = [100, 100, 100, 255].repeat(8);
        for (index, colour) in changes {
            rgba8[4 * index..4 * index + 3].copy_from_slice(colour);
        }
        Picture {
            width_px: 4,
            height_px: 2,
            rgba8,
        }
    }

    /// One pixel off by (+1, 0, −1), one by (0, 10, 0): 12 levels over 24 channels.
    #[test]
    fn known_changes_give_known_numbers() {
        let changed = grey(&[(1, [101, 100, 99]), (6, [100, 110, 100])]);
        let found = Difference::between(&grey(&[]), &changed).unwrap();
        assert_eq!((found.largest, found.largest_at_px), (10, (2, 1)));
        assert!((found.mean_abs - 12.0 / 24.0).abs() < 1e-12);
        assert!((found.rmse - (102.0_f64 / 24.0).sqrt()).abs() < 1e-12);
        let shares = [0, 1, 9, 10].map(|levels| found.share_within(levels));
        assert_eq!(shares, [0.75, 0.875, 0.875, 1.0]);
    }

    #[test]
    fn the_picture_is_amplified_and_clipped() {
        let changed = grey(&[(1, [101, 100, 90])]);
        let shown = difference_picture(&grey(&[]), &changed, 16).unwrap();
        assert_eq!(shown.rgba8[4..8], [16, 0, 160, 255]);
        assert_eq!(shown.rgba8[..4], [0, 0, 0, 255]);
        let strong = difference_picture(&grey(&[]), &changed, 100).unwrap();
        assert_eq!(strong.rgba8[4..8], [100, 0, 255, 255]);
    }

    #[test]
    fn other_sizes_are_refused() {
        let wide = Picture {
            width_px: 8,
            height_px: 1,
            ..grey(&[])
        };
        assert!(Difference::between(&grey(&[]), &wide).is_err());
        assert!(difference_picture(&wide, &grey(&[]), 1).is_err());
    }

    proptest! {
        #[test]
        fn it_does_not_matter_which_comes_first(a: [[u8; 3]; 8], b: [[u8; 3]; 8]) {
            let picture = |colours: [[u8; 3]; 8]| {
                grey(&colours.into_iter().enumerate().collect::<Vec<_>>())
            };
            let there = Difference::between(&picture(a), &picture(b)).unwrap();
            prop_assert_eq!(&there, &Difference::between(&picture(b), &picture(a)).unwrap());
            prop_assert!(there.mean_abs <= there.rmse + 1e-12);
            prop_assert!(there.rmse <= f64::from(there.largest) + 1e-12);
            prop_assert_eq!(there.share_within(255), 1.0);
        }
    }
}
