//! Whether two images make a pair that can be judged by its ambient occlusion.

use super::difference::Difference;
use super::manifest::{PairRecord, Picture};
use crate::scene::srgb;

/// Relative difference of mean luminance above which two images made elsewhere are suspected of
/// differing in more than the occlusion.
const LUMINANCE_TOLERANCE: f64 = 0.2;

/// Compares two images made elsewhere: what is worth a look, in words.
///
/// # Errors
/// Both sizes, if they differ.
pub fn compare(first: &Picture, second: &Picture) -> Result<Vec<String>, String> {
    let difference = Difference::between(first, second).map_err(|sizes| sizes.to_string())?;
    if difference.largest == 0 {
        return Ok(Vec::new());
    }
    let (a, b) = (mean_luminance(first), mean_luminance(second));
    let apart = (a - b).abs() / a.max(b);
    let mut warnings = Vec::new();
    if apart > LUMINANCE_TOLERANCE {
        warnings.push(format!(
            "the mean luminance of the two images differs by {:.0} % ({a:.3} and {b:.3} of white): they probably differ in more \
             than the ambient occlusion",
            100.0 * apart
        ));
    }
    Ok(warnings)
}

/// A warning if both images of a pair are the same file.
#[must_use]
pub fn identical(pair: &PairRecord) -> Option<String> {
    (pair.first.sha256 == pair.second.sha256).then(|| {
        format!(
            "condition \"{}\": both images are the same to the last pixel; there is nothing to judge",
            pair.condition
        )
    })
}

/// Mean relative luminance, 0 to 1.
fn mean_luminance(picture: &Picture) -> f64 {
    let pixels = picture.rgba8.chunks_exact(4);
    let count = pixels.len().max(1) as f64;
    let sum: f64 = pixels
        .map(|p| f64::from(srgb::luminance_u8([p[0], p[1], p[2]])))
        .sum();
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(level: u8, width_px: u32) -> Picture {
        Picture {
            width_px,
            height_px: 2,
            rgba8: [level, level, level, 255].repeat(2 * width_px as usize),
        }
    }

    #[test]
    fn unequal_sizes_are_named_both() {
        let message = compare(&grey(9, 3), &grey(9, 4)).unwrap_err();
        assert!(
            message.contains("3×2") && message.contains("4×2"),
            "{message}"
        );
    }

    /// Levels 188 and 170 are luminances of about 0.50 and 0.40.
    #[test]
    fn a_large_step_in_luminance_is_suspicious_and_a_small_one_is_not() {
        assert!(compare(&grey(188, 3), &grey(180, 3)).unwrap().is_empty());
        let warnings = compare(&grey(188, 3), &grey(165, 3)).unwrap();
        assert!(warnings[0].contains("luminance"), "{warnings:?}");
        assert!(compare(&grey(0, 3), &grey(0, 3)).unwrap().is_empty());
    }
}
