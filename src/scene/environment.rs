//! Light that comes from all round: radiance as a function of direction, and its
//! irradiance as nine spherical-harmonic coefficients.

use glam::Vec3;

/// Radiance from far away, by direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Linear RGB radiance seen along +x, −x, +y, −y, +z, −z.
    ///
    /// Between the axes the radiances are weighted by the squared direction cosines
    /// (the "ambient cube" of McTaggart 2004): smooth, and enough to say that the sky
    /// is blue above, the floor warm below and one wall brighter than the other.
    pub axes: [Vec3; 6],
}

impl Environment {
    /// Linear RGB radiance that arrives from unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        let weight = towards * towards;
        let pick = |axis: usize, component: f32| self.axes[2 * axis + usize::from(component < 0.0)];
        pick(0, towards.x) * weight.x
            + pick(1, towards.y) * weight.y
            + pick(2, towards.z) * weight.z
    }
}

/// Irradiance on a surface by its normal: nine coefficients a colour channel.
///
/// Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
/// Environment Maps": the cosine lobe keeps bands 0 to 2 of the radiance's spherical
/// harmonics, scaled by π, 2π/3 and π/4. The coefficients here are already scaled, so
/// that irradiance is their sum with the basis of [`basis`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Irradiance {
    /// Coefficients of [`basis`], linear RGB.
    pub coefficients: [Vec3; 9],
}

impl Irradiance {
    /// Projects a radiance function by a midpoint rule of `64 × 128` directions,
    /// exact to about 1e-4 for functions without detail finer than a few degrees.
    #[must_use]
    pub fn project(radiance: impl Fn(Vec3) -> Vec3) -> Self {
        const ROWS: usize = 64;
        const COLUMNS: usize = 128;
        let mut sums = [glam::DVec3::ZERO; 9];
        for row in 0..ROWS {
            // Even steps in cos θ are even steps in solid angle.
            let cos_theta = 1.0 - 2.0 * (row as f32 + 0.5) / ROWS as f32;
            let sin_theta = (1.0 - cos_theta * cos_theta).max(0.0).sqrt();
            for column in 0..COLUMNS {
                let phi = std::f32::consts::TAU * (column as f32 + 0.5) / COLUMNS as f32;
                let direction = Vec3::new(sin_theta * phi.cos(), cos_theta, sin_theta * phi.sin());
                let value = radiance(direction).as_dvec3();
                for (sum, y) in sums.iter_mut().zip(basis(direction)) {
                    *sum += value * f64::from(y);
                }
            }
        }
        let solid_angle = 4.0 * std::f64::consts::PI / (ROWS * COLUMNS) as f64;
        let mut coefficients = [Vec3::ZERO; 9];
        for (index, (coefficient, sum)) in coefficients.iter_mut().zip(sums).enumerate() {
            *coefficient = (sum * solid_angle * f64::from(cosine_lobe(index))).as_vec3();
        }
        Self { coefficients }
    }

    /// Irradiance on a surface of unit normal `normal`; never negative.
    #[must_use]
    pub fn at(&self, normal: Vec3) -> Vec3 {
        self.coefficients
            .iter()
            .zip(basis(normal))
            .map(|(coefficient, y)| *coefficient * y)
            .sum::<Vec3>()
            .max(Vec3::ZERO)
    }
}

/// The nine real spherical harmonics of bands 0 to 2 at a unit direction.
#[must_use]
pub fn basis(d: Vec3) -> [f32; 9] {
    [
        0.282_094_8,
        0.488_602_5 * d.y,
        0.488_602_5 * d.z,
        0.488_602_5 * d.x,
        1.092_548_4 * d.x * d.y,
        1.092_548_4 * d.y * d.z,
        0.315_391_57 * (3.0 * d.z * d.z - 1.0),
        1.092_548_4 * d.x * d.z,
        0.546_274_2 * (d.x * d.x - d.y * d.y),
    ]
}

/// What the clamped cosine keeps of a band (Ramamoorthi and Hanrahan 2001, eq. 8).
fn cosine_lobe(index: usize) -> f32 {
    use std::f32::consts::PI;
    match index {
        0 => PI,
        1..=3 => 2.0 * PI / 3.0,
        _ => PI / 4.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    #[test]
    fn uniform_radiance_gives_pi_everywhere() {
        let irradiance = Irradiance::project(|_| Vec3::ONE);
        for normal in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.0, -0.8)] {
            assert!((irradiance.at(normal) - Vec3::splat(PI)).length() < 2e-3);
        }
    }

    /// Radiance cos θ over the sphere, signed: the exact irradiance of band 1 alone
    /// is (2π/3) cos θ.
    #[test]
    fn a_linear_function_keeps_two_thirds_pi() {
        let irradiance = Irradiance::project(|d| Vec3::splat(d.y));
        assert!((irradiance.at(Vec3::Y).x - 2.0 * PI / 3.0).abs() < 2e-3);
        assert!((irradiance.at(Vec3::new(0.6, 0.8, 0.0)).x - 0.8 * 2.0 * PI / 3.0).abs() < 2e-3);
    }

    /// White sky over a black floor: π above, 0 below, π/2 on a wall, exactly. The
    /// projection stops at band 2, whose error for a half-space light is known to be
    /// below 1 % of the sky's π on top and on walls.
    #[test]
    fn a_half_space_of_light() {
        let irradiance = Irradiance::project(|d| if d.y > 0.0 { Vec3::ONE } else { Vec3::ZERO });
        assert!((irradiance.at(Vec3::Y).x - PI).abs() < 0.01 * PI);
        assert!((irradiance.at(Vec3::X).x - PI / 2.0).abs() < 0.01 * PI);
        assert!(irradiance.at(Vec3::NEG_Y).x < 0.01 * PI);
    }

    #[test]
    fn axes_are_seen_along_themselves() {
        let axes = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(Vec3::splat);
        let environment = Environment { axes };
        for (axis, direction) in [
            Vec3::X,
            Vec3::NEG_X,
            Vec3::Y,
            Vec3::NEG_Y,
            Vec3::Z,
            Vec3::NEG_Z,
        ]
        .into_iter()
        .enumerate()
        {
            assert!((environment.radiance(direction) - axes[axis]).length() < 1e-6);
        }
    }
}
