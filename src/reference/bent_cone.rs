//! The bent cone: what is open to a point as one direction and an aperture, and the light that comes
//! in through it. `docs/bent-cones.md` has the whole derivation.
//!
//! The open directions are kept as a share and a mean ([`Opening`]). Weighted by the cosine these are all
//! that bands 0 and 1 of a light depend on, whatever the open directions look like: there the
//! irradiance is exact. Only for band 2 are they taken for a cone, the one whose mean is as long.

use glam::{Mat3, Vec3};

use super::directions::{Weighting, frame_of};
use crate::scene::environment::Irradiance;

/// The open directions of a point, to first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// The open share of the hemisphere, 0 to 1: k_A by the cosine, α uniform.
    pub share: f32,
    /// The mean of all directions of the hemisphere, the closed ones counted as nought: the share times
    /// the mean open direction. World space, no longer than the share.
    pub moment: Vec3,
}

/// A cone of open directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BentCone {
    /// Unit direction of its axis, world space.
    pub direction: Vec3,
    /// Cosine of the angle from its axis to its edge, 0 (a hemisphere) to 1 (a line).
    pub cos_half_angle: f32,
}

impl Opening {
    /// Nothing is open.
    pub const CLOSED: Self = Self {
        share: 0.0,
        moment: Vec3::ZERO,
    };

    /// The whole hemisphere round a unit normal.
    #[must_use]
    pub fn whole(normal: Vec3, weighting: Weighting) -> Self {
        Self {
            share: 1.0,
            moment: normal * BentCone::WIDEST.mean_length(weighting),
        }
    }

    /// With one open direction more, which stands for a part of the hemisphere's weight (all parts, the
    /// closed ones' too, sum to 1).
    #[must_use]
    pub fn with(self, direction: Vec3, part: f32) -> Self {
        Self {
            share: self.share + part,
            moment: self.moment + direction * part,
        }
    }

    /// The same, all of it times a factor.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self {
            share: self.share * factor,
            moment: self.moment * factor,
        }
    }

    /// The cone whose mean direction is as long as that of what is open; `None` where nothing is open, or
    /// so evenly to all sides that there is no mean direction. Directions that are spread further
    /// than a hemisphere's make a hemisphere.
    #[must_use]
    pub fn cone(&self, weighting: Weighting) -> Option<BentCone> {
        let direction = self.moment.try_normalize().filter(|_| self.share > 0.0)?;
        let length = (self.moment.length() / self.share).min(1.0);
        Some(BentCone {
            direction,
            cos_half_angle: BentCone::cos_of(length, weighting),
        })
    }

    /// Irradiance of a light that comes in through what is open, for an opening weighted by the
    /// cosine; never negative.
    ///
    /// E = π k_A (L₀ + ρ L₁(b) + ζ L₂(b)), with L_l the bands of the radiance, b the mean open direction and ρ
    /// its length. Both first terms are the integral itself, as ∫ L₀ + L₁(ω) of what is
    /// open asks for no more than its share and its mean. ζ = ⟨P₂⟩ = (1 + 3c²)/4 is that of an upright cone
    /// (cosines from c to 1) with the same ρ. Open it is the plain irradiance, with π, 2π/3 and π/4;
    /// constant light gives π k_A L through any opening. A mean that is shorter than a
    /// hemisphere's is no cone's: ζ then falls with its square, and goes where it has no direction.
    #[must_use]
    pub fn irradiance(&self, light: &Irradiance) -> Vec3 {
        let share = self.share.clamp(0.0, 1.0);
        let length = self.moment.length().min(share);
        let direction = self.moment.try_normalize().unwrap_or(Vec3::Y);
        let sharpness = 1.5 * length / share.max(1e-6);
        let cos = BentCone::cos_of(length / share.max(1e-6), Weighting::Cosine);
        let fourfold_p2 = (1.0 + 3.0 * cos * cos) * (sharpness * sharpness).min(1.0);
        // The coefficients hold π, 2π/3 and π/4 already.
        let bands = [share, 1.5 * length, share * fourfold_p2];
        light.banded(direction, bands).max(Vec3::ZERO)
    }
}

impl BentCone {
    /// The hemisphere.
    const WIDEST: Self = Self {
        direction: Vec3::Z,
        cos_half_angle: 0.0,
    };

    /// The angle from its axis to its edge, radians, 0 to π/2.
    #[must_use]
    pub fn half_angle_rad(&self) -> f32 {
        self.cos_half_angle.clamp(0.0, 1.0).acos()
    }

    /// Length of the mean of its directions: (1 + c)/2 if all count alike; (2/3)(1 + c + c²)/(1 + c) if they
    /// count by the cosine and the cone stands upright.
    #[must_use]
    pub fn mean_length(&self, weighting: Weighting) -> f32 {
        let c = self.cos_half_angle;
        match weighting {
            Weighting::Uniform => 0.5 * (1.0 + c),
            Weighting::Cosine => (1.0 + c + c * c) / (1.5 * (1.0 + c)),
        }
    }

    /// The inverse: by the cosine c² + (1 − q) c + (1 − q) = 0, where q is 3/2 of the length.
    fn cos_of(length: f32, weighting: Weighting) -> f32 {
        let cos = match weighting {
            Weighting::Uniform => 2.0 * length - 1.0,
            Weighting::Cosine => {
                let beyond = (1.5 * length - 1.0).max(0.0);
                0.5 * (beyond + (beyond * (beyond + 4.0)).sqrt())
            }
        };
        cos.clamp(0.0, 1.0)
    }

    /// Irradiance through the cone on a surface of unit `normal` of which the share `k_a` is open, 0 to 1:
    /// the mean radiance over the part of the cone above the surface, by the cosine, times
    /// π k_A. Never negative. What [`Opening::irradiance`] is compared with: here all bands rest on the
    /// cone.
    #[must_use]
    pub fn irradiance(&self, normal: Vec3, k_a: f32, light: &Irradiance) -> Vec3 {
        let Some((mean, mean_of_products)) = self.lit_moments(normal) else {
            return Vec3::ZERO;
        };
        let radiance = light.mean_radiance(mean, mean_of_products);
        (radiance * (std::f32::consts::PI * k_a.clamp(0.0, 1.0))).max(Vec3::ZERO)
    }

    /// The means of ω and of ωωᵀ over the part of the cone above the surface, by the cosine to the normal;
    /// `None` if no part is above.
    ///
    /// Round the normal, heights µ spread by the cosine are the roots of an even spread. At each the
    /// cone holds the azimuths up to ψ to both sides of its axis, and their integrals are closed:
    /// cos ψ = (c − µ b·n) / (√(1−µ²) √(1−(b·n)²)).
    fn lit_moments(&self, normal: Vec3) -> Option<(Vec3, Mat3)> {
        const HEIGHTS: u32 = 256;
        let frame = frame_of(normal);
        let axis = frame.transpose() * self.direction;
        let across = axis.truncate().length();
        let towards = axis.truncate().try_normalize().unwrap_or(glam::Vec2::X);
        let (mut weight, mut first) = (0.0_f32, Vec3::ZERO);
        // xx, yy, zz and xz, with x towards the axis.
        let mut second = [0.0_f32; 4];
        for i in 0..HEIGHTS {
            let height = ((i as f32 + 0.5) / HEIGHTS as f32).sqrt();
            let radius = (1.0 - height * height).sqrt();
            let cos = (self.cos_half_angle - height * axis.z) / (radius * across).max(1e-12);
            let half_turn = cos.clamp(-1.0, 1.0).acos();
            let (sin, cos) = half_turn.sin_cos();
            weight += 2.0 * half_turn;
            first += Vec3::new(2.0 * radius * sin, 0.0, 2.0 * height * half_turn);
            second[0] += radius * radius * (half_turn + sin * cos);
            second[1] += radius * radius * (half_turn - sin * cos);
            second[2] += 2.0 * height * height * half_turn;
            second[3] += 2.0 * height * radius * sin;
        }
        let turn = Mat3::from_cols(
            Vec3::new(towards.x, towards.y, 0.0),
            Vec3::new(-towards.y, towards.x, 0.0),
            Vec3::Z,
        );
        let [xx, yy, zz, xz] = second.map(|sum| sum / weight);
        let products = Mat3::from_cols(
            Vec3::new(xx, 0.0, xz),
            Vec3::new(0.0, yy, 0.0),
            Vec3::new(xz, 0.0, zz),
        );
        let to_world = frame * turn;
        (weight > 1e-6).then(|| {
            (
                to_world * (first / weight),
                to_world * products * to_world.transpose(),
            )
        })
    }
}

#[cfg(test)]
mod tests;
