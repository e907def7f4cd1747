//! FLIP's features: how strong an edge or a point stands at each pixel, and how two differ.

use rayon::prelude::*;

use crate::stimulus::plane::{Border, Plane};

/// Width of an edge to the eye, degrees (the paper's w); the Gaussian's deviation is half of it.
const FEATURE_WIDTH_DEGREES: f64 = 0.082;

/// How strong an edge and a point are at a pixel, each 0 to √2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strengths {
    edge: f32,
    point: f32,
}

/// A Gaussian and its first and second derivative, along one direction.
struct Kernels {
    blur: Vec<f32>,
    edge: Vec<f32>,
    point: Vec<f32>,
}

impl Kernels {
    /// The derivatives are scaled so that their positive weights sum to 1 and their negative ones
    /// to -1: a step from black to white then has an edge of 1.
    fn new(pixels_per_degree: f32) -> Self {
        let deviation = 0.5 * FEATURE_WIDTH_DEGREES * f64::from(pixels_per_degree);
        let radius = (3.0 * deviation).ceil() as i32;
        let squared = deviation * deviation;
        let weights = |weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (-radius..=radius)
                .map(|x| {
                    let x = f64::from(x);
                    weight(x) * libm::exp(-x * x / (2.0 * squared))
                })
                .collect()
        };
        Self {
            blur: scaled(&weights(&|_| 1.0)),
            edge: scaled(&weights(&|x| -x)),
            point: scaled(&weights(&|x| x * x / squared - 1.0)),
        }
    }
}

/// Weights whose positive ones sum to 1 and whose negative ones to -1, where there are any.
fn scaled(weights: &[f64]) -> Vec<f32> {
    let sum = |sign: f64| weights.iter().map(|w| (w * sign).max(0.0)).sum::<f64>();
    let (positive, negative) = (sum(1.0), sum(-1.0));
    weights
        .iter()
        .map(|&w| match w {
            _ if w > 0.0 => (w / positive) as f32,
            _ if w < 0.0 => (w / negative) as f32,
            _ => 0.0,
        })
        .collect()
}

/// How strong edges and points are at every pixel, of the lightness channel Y of
/// [`Colours::opponents`](super::colour::Colours::opponents).
pub fn strengths(lightness: &Plane, pixels_per_degree: f32) -> Vec<Strengths> {
    let kernels = Kernels::new(pixels_per_degree);
    // In the range 0 to 1, as the filters expect.
    let grey = lightness.zip(lightness, |y, _| (y + 16.0) / 116.0);
    let blurred = grey.along_rows(&kernels.blur, Border::Repeat);
    let lengths = |derivative: &[f32]| {
        let across = grey.filtered(derivative, &kernels.blur, Border::Repeat);
        let down = blurred.along_columns(derivative, Border::Repeat);
        across.zip(&down, |x, y| (x * x + y * y).sqrt())
    };
    let (edges, points) = (lengths(&kernels.edge), lengths(&kernels.point));
    let both = edges.values.par_iter().zip(&points.values);
    both.map(|(&edge, &point)| Strengths { edge, point })
        .collect()
}

/// How different the features of two pictures are at a pixel, 0 to 1.
pub fn difference(first: Strengths, second: Strengths) -> f32 {
    let edges = (first.edge - second.edge).abs();
    let points = (first.point - second.point).abs();
    (edges.max(points) * std::f32::consts::FRAC_1_SQRT_2)
        .sqrt()
        .min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stimulus::test_pictures::{WIDTH_PX, picture};

    #[test]
    fn kernels_are_balanced() {
        for pixels_per_degree in [2.0, 25.0, 67.0, 1000.0] {
            let kernels = Kernels::new(pixels_per_degree);
            let sum = |weights: &[f32]| weights.iter().sum::<f32>();
            assert!((sum(&kernels.blur) - 1.0).abs() < 1e-5);
            assert!(sum(&kernels.edge).abs() < 1e-5);
            assert!(sum(&kernels.point).abs() < 1e-5);
            let positive = |weights: &[f32]| weights.iter().map(|w| w.max(0.0)).sum::<f32>();
            assert!((positive(&kernels.edge) - 1.0).abs() < 1e-5);
            assert!((positive(&kernels.point) - 1.0).abs() < 1e-5);
        }
    }

    /// A step from black to white between two columns: beside it the edge is nearly the whole
    /// step, far away nothing; a flat area has no features.
    #[test]
    fn a_step_is_an_edge() {
        let step = picture(|x, _| [if x < 32 { 0 } else { 255 }; 3]);
        let lightness = Plane::of(&step, |[level, ..]| 116.0 * f32::from(level) / 255.0 - 16.0);
        let found = strengths(&lightness, 67.0);
        let row = &found[20 * WIDTH_PX as usize..][..WIDTH_PX as usize];
        // The column left of the step sees all weights to its right, which are one side of the
        // odd kernel.
        assert!((row[31].edge - 1.0).abs() < 1e-5, "{:?}", row[31]);
        assert!(row[5].edge.abs() < 1e-5 && row[5].point.abs() < 1e-5);
        assert!(row[31].point > 0.1);
        assert_eq!(difference(row[31], row[31]), 0.0);
        let apart = difference(row[31], row[5]);
        assert!((apart - std::f32::consts::FRAC_1_SQRT_2.sqrt()).abs() < 1e-3);
    }
}
