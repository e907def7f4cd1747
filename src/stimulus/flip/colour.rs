//! FLIP's colours: what the eye resolves of a picture, and how far two colours are apart.

use glam::{DMat3, Mat3, Vec3};
use rayon::prelude::*;

use crate::scene::srgb;
use crate::stimulus::manifest::Picture;
use crate::stimulus::plane::{Border, Plane};

/// Exponent of the distance of two colours, and the bend that gives small distances most of the
/// range: what is under `BEND_AT` of the largest distance gets `BEND_TO` (the paper's
/// "redistribution of errors").
const EXPONENT: f32 = 0.7;
const BEND_AT: f32 = 0.4;
const BEND_TO: f32 = 0.95;

/// One Gaussian of the contrast sensitivity, in the frequency domain `scale · exp(-width · f²)`
/// with f in cycles a degree (the paper's table of constants, after Johnson and Fairchild 2003).
struct Sensitivity {
    scale: f64,
    width: f64,
}

const ACHROMATIC: [Sensitivity; 1] = [Sensitivity {
    scale: 1.0,
    width: 0.0047,
}];
const RED_GREEN: [Sensitivity; 1] = [Sensitivity {
    scale: 1.0,
    width: 0.0053,
}];
const BLUE_YELLOW: [Sensitivity; 2] = [
    Sensitivity {
        scale: 34.1,
        width: 0.04,
    },
    Sensitivity {
        scale: 13.5,
        width: 0.025,
    },
];
/// The widest of all in space; all kernels are cut at three of its standard deviations.
const WIDEST: f64 = 0.04;

/// The conversions between linear light and CIE XYZ in shares of the white point.
pub struct Colours {
    to_xyz: Mat3,
    to_rgb: Mat3,
}

impl Colours {
    pub fn new() -> Self {
        // Linear sRGB to XYZ of D65 in the whole numbers that NVIDIA's program has. Dividing a row
        // by its sum makes white (1, 1, 1), which is what Lab starts from.
        let rows = [
            [10_135_552.0, 8_788_810.0, 4_435_075.0],
            [2_613_072.0, 8_788_810.0, 887_015.0],
            [1_425_312.0, 8_788_810.0, 70_074_185.0],
        ];
        let shares = rows.map(|row: [f64; 3]| row.map(|part| part / row.iter().sum::<f64>()));
        let to_xyz = DMat3::from_cols_array_2d(&shares).transpose();
        Self {
            to_xyz: to_xyz.as_mat3(),
            to_rgb: to_xyz.inverse().as_mat3(),
        }
    }

    /// A picture as lightness, red against green, and blue against yellow (Y, Cx, Cz), all linear
    /// in light, so that they can be filtered.
    pub fn opponents(&self, picture: &Picture) -> [Plane; 3] {
        let linear: Vec<f32> = (0..=255_u8)
            .map(|level| srgb::decode(f32::from(level) / 255.0))
            .collect();
        let channel = |number: fn(Vec3) -> f32| {
            Plane::of(picture, |levels| {
                let light = Vec3::from(levels.map(|level| linear[usize::from(level)]));
                number(self.to_xyz * light)
            })
        };
        [
            channel(|xyz| 116.0 * xyz.y - 16.0),
            channel(|xyz| 500.0 * (xyz.x - xyz.y)),
            channel(|xyz| 200.0 * (xyz.y - xyz.z)),
        ]
    }

    /// What is left of the channels of a picture to the eye, as L, a, b, where a and b shrink with
    /// the lightness (Hunt).
    pub fn seen(&self, channels: &[Plane; 3], pixels_per_degree: f32) -> Vec<Vec3> {
        let [lightness, red_green, blue_yellow] = channels;
        let lightness = blurred(lightness, &ACHROMATIC, pixels_per_degree);
        let red_green = blurred(red_green, &RED_GREEN, pixels_per_degree);
        let blue_yellow = blurred(blue_yellow, &BLUE_YELLOW, pixels_per_degree);
        let both = red_green.values.par_iter().zip(&blue_yellow.values);
        lightness
            .values
            .par_iter()
            .zip(both)
            .map(|(&y, (&cx, &cz))| {
                let y = (y + 16.0) / 116.0;
                let light = self.to_rgb * Vec3::new(y + cx / 500.0, y, y - cz / 200.0);
                // Blurring each channel by itself may leave what a display can show.
                self.lab(light.clamp(Vec3::ZERO, Vec3::ONE))
            })
            .collect()
    }

    /// The largest distance there is of two colours of sRGB, that of green and blue, raised to the
    /// exponent.
    pub fn largest_distance(&self) -> f32 {
        distance(self.lab(Vec3::Y), self.lab(Vec3::Z))
    }

    /// Linear light as CIE L*a*b* with a* and b* times a hundredth of L*.
    fn lab(&self, light: Vec3) -> Vec3 {
        const DELTA: f32 = 6.0 / 29.0;
        let [x, y, z] = (self.to_xyz * light).to_array().map(|share| {
            if share > DELTA * DELTA * DELTA {
                libm::cbrtf(share)
            } else {
                share / (3.0 * DELTA * DELTA) + 4.0 / 29.0
            }
        });
        let lightness = 116.0 * y - 16.0;
        let hunt = 0.01 * lightness;
        Vec3::new(lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z))
    }
}

/// How different two colours of [`Colours::seen`] are, 0 to 1; `largest` is
/// [`Colours::largest_distance`].
pub fn difference(first: Vec3, second: Vec3, largest: f32) -> f32 {
    let apart = distance(first, second);
    let bend = BEND_AT * largest;
    if apart < bend {
        apart * BEND_TO / bend
    } else {
        (BEND_TO + (apart - bend) / (largest - bend) * (1.0 - BEND_TO)).min(1.0)
    }
}

/// The HyAB distance (Abasi and others 2020), raised to the exponent.
fn distance(first: Vec3, second: Vec3) -> f32 {
    let apart = first - second;
    let chroma = (apart.y * apart.y + apart.z * apart.z).sqrt();
    libm::powf(apart.x.abs() + chroma, EXPONENT)
}

/// A channel blurred by the sum of Gaussians that its contrast sensitivity is in space.
fn blurred(channel: &Plane, sensitivity: &[Sensitivity], pixels_per_degree: f32) -> Plane {
    let mut kernels = kernels(sensitivity, f64::from(pixels_per_degree)).into_iter();
    let first = kernels.next().map_or_else(
        || channel.clone(),
        |(rows, columns)| channel.filtered(&rows, &columns, Border::Repeat),
    );
    kernels.fold(first, |sum, (rows, columns)| {
        let more = channel.filtered(&rows, &columns, Border::Repeat);
        sum.zip(&more, |a, b| a + b)
    })
}

/// For each Gaussian its kernel along the rows and along the columns. In space it is
/// `scale · √(π / width) · exp(-π² r² / width)` at r degrees, and the weights of all together are
/// scaled to sum 1. The root is that of one dimension, as NVIDIA's program has it; without it blue
/// against yellow would be blurred a little less. The share of a Gaussian stands in its kernel of
/// the rows.
fn kernels(sensitivity: &[Sensitivity], pixels_per_degree: f64) -> Vec<(Vec<f32>, Vec<f32>)> {
    use std::f64::consts::PI;
    let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
    let gaussians: Vec<(f64, Vec<f64>)> = sensitivity
        .iter()
        .map(|Sensitivity { scale, width }| {
            let weights = (-radius..=radius).map(|pixels| {
                let degrees = f64::from(pixels) / pixels_per_degree;
                libm::exp(-PI * PI * degrees * degrees / width)
            });
            (scale * (PI / width).sqrt(), weights.collect())
        })
        .collect();
    let sum = |weights: &[f64]| weights.iter().sum::<f64>();
    let total: f64 = gaussians
        .iter()
        .map(|(height, weights)| height * sum(weights) * sum(weights))
        .sum();
    let scaled = |weights: &[f64], by: f64| weights.iter().map(|w| (w * by) as f32).collect();
    gaussians
        .iter()
        .map(|(height, weights)| {
            let share = height * sum(weights) / total;
            (scaled(weights, share), scaled(weights, 1.0 / sum(weights)))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_100_and_grey_has_no_colour() {
        let colours = Colours::new();
        let white = colours.lab(Vec3::ONE);
        assert!(
            (white - Vec3::new(100.0, 0.0, 0.0)).length() < 1e-3,
            "{white}"
        );
        // 18 % of the light is L* 49.5.
        let grey = colours.lab(Vec3::splat(0.18));
        assert!(
            (grey - Vec3::new(49.496, 0.0, 0.0)).length() < 1e-2,
            "{grey}"
        );
        assert!(colours.lab(Vec3::ZERO).length() < 1e-4);
    }

    #[test]
    fn light_comes_back_from_xyz() {
        let colours = Colours::new();
        let light = Vec3::new(0.9, 0.2, 0.05);
        let back = colours.to_rgb * (colours.to_xyz * light);
        assert!((back - light).length() < 1e-6);
    }

    #[test]
    fn kernels_keep_flat_areas_and_are_symmetric() {
        for sensitivity in [&ACHROMATIC[..], &RED_GREEN, &BLUE_YELLOW] {
            for pixels_per_degree in [2.0, 25.0, 67.0, 1000.0] {
                let found = kernels(sensitivity, pixels_per_degree);
                let sum = |weights: &[f32]| weights.iter().map(|&w| f64::from(w)).sum::<f64>();
                let total: f64 = found.iter().map(|(r, c)| sum(r) * sum(c)).sum();
                assert!((total - 1.0).abs() < 1e-5, "{total}");
                for (rows, _) in &found {
                    assert!(rows.iter().eq(rows.iter().rev()));
                }
            }
        }
    }

    /// Both sides of the bend meet at `BEND_TO`, and green against blue is 1.
    #[test]
    fn the_bend_has_no_step() {
        let colours = Colours::new();
        let largest = colours.largest_distance();
        let [green, blue] = [Vec3::Y, Vec3::Z].map(|light| colours.lab(light));
        assert!((difference(green, blue, largest) - 1.0).abs() < 1e-6);
        let at_bend = libm::powf(BEND_AT * largest, 1.0 / EXPONENT);
        for nudge in [0.999, 1.001] {
            let found = difference(Vec3::ZERO, Vec3::X * at_bend * nudge, largest);
            assert!((found - BEND_TO).abs() < 1e-3, "{found}");
        }
    }
}
