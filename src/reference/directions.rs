//! Directions over the hemisphere, spread as an estimate weights them.

use std::f32::consts::TAU;

use glam::{Mat3, Vec3};

/// What the directions of the hemisphere count by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Weighting {
    /// By the cosine to the normal: k_A = (1/π) ∫ v cosθ dω (thesis eq. 3).
    Cosine,
    /// All alike: α = (1/2π) ∫ V dω (the notes' eq. 4).
    Uniform,
}

impl Weighting {
    /// The direction of a point of the unit square, round +Z. Points spread evenly give
    /// directions spread by the weighting, so that an estimate is a plain mean.
    #[must_use]
    #[inline]
    pub fn direction(self, [u, v]: [f32; 2]) -> Vec3 {
        // Heights stay above 0: u is below 1.
        let z = match self {
            Self::Cosine => (1.0 - u).sqrt(),
            Self::Uniform => 1.0 - u,
        };
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (TAU * v).sin_cos();
        Vec3::new(radius * cos, radius * sin, z)
    }
}

/// The rotation that takes +Z to a unit normal (Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited").
#[must_use]
pub fn frame_of(normal: Vec3) -> Mat3 {
    let sign = 1.0_f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    Mat3::from_cols(
        Vec3::new(
            1.0 + sign * normal.x * normal.x * a,
            sign * b,
            -sign * normal.x,
        ),
        Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
        normal,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean heights: ∫ cos²θ/π dω = 2/3 and ∫ cosθ/2π dω = 1/2, by the midpoint rule.
    #[test]
    fn heights_are_spread_by_the_weighting() {
        for (weighting, mean) in [(Weighting::Cosine, 2.0 / 3.0), (Weighting::Uniform, 0.5)] {
            let heights = (0..1000).map(|i| {
                let direction = weighting.direction([(i as f32 + 0.5) / 1000.0, 0.3]);
                assert!((direction.length() - 1.0).abs() < 1e-6);
                direction.z
            });
            assert!((heights.sum::<f32>() / 1000.0 - mean).abs() < 1e-3);
        }
    }

    #[test]
    fn frames_are_rotations_for_every_normal() {
        for normal in [
            Vec3::Z,
            Vec3::NEG_Z,
            Vec3::X,
            Vec3::new(0.6, -0.48, -0.64),
            Vec3::new(1e-4, 0.0, -1.0).normalize(),
        ] {
            let frame = frame_of(normal);
            assert!((frame * frame.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-5));
            assert!((frame.determinant() - 1.0).abs() < 1e-5);
            assert!((frame * Vec3::Z - normal).length() < 1e-6);
        }
    }
}
