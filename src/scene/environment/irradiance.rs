//! Irradiance by the normal, as nine spherical-harmonic coefficients of a radiance map.

use glam::{DVec3, Mat3, Vec3};

use super::RadianceMap;

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
    /// Projects a map, each texel by its exact solid angle.
    #[must_use]
    pub fn of(map: &RadianceMap) -> Self {
        let mut sums = [DVec3::ZERO; 9];
        for row in 0..map.height_px() {
            let mut row_sums = [DVec3::ZERO; 9];
            for column in 0..map.width_px() {
                let radiance = map.texels()[row * map.width_px() + column].as_dvec3();
                for (sum, y) in row_sums.iter_mut().zip(basis(map.direction(column, row))) {
                    *sum += radiance * f64::from(y);
                }
            }
            for (sum, row_sum) in sums.iter_mut().zip(row_sums) {
                *sum += row_sum * map.solid_angle(row);
            }
        }
        let mut coefficients = [Vec3::ZERO; 9];
        for (index, (coefficient, sum)) in coefficients.iter_mut().zip(sums).enumerate() {
            *coefficient = (sum * f64::from(cosine_lobe(index))).as_vec3();
        }
        Self { coefficients }
    }

    /// The same light with bands 1 and 2 weakened just enough that no normal receives less
    /// than nothing.
    ///
    /// Three bands cannot hold a small bright source: on the side away from it the sum rings
    /// below zero, by up to 4 % of its peak, and clamping there would tint shadows where one
    /// channel clamps before another. Sloan 2008, "Stupid Spherical Harmonics (SH)
    /// Tricks", windows band l by 1/(1 + λ l²(l+1)²), which minimises the squared Laplacian; λ is the
    /// smallest that does, 0 for light that does not ring. Band 0, the total, is not touched.
    #[must_use]
    pub fn without_ringing(&self) -> Self {
        const STEPS: u32 = 24;
        if self.windowed(0.0).lowest() >= 0.0 {
            return *self;
        }
        let (mut low, mut high) = (0.0_f32, 1.0_f32);
        while self.windowed(high).lowest() < 0.0 && high < 1e6 {
            high *= 2.0;
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            if self.windowed(middle).lowest() < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.windowed(high)
    }

    fn windowed(&self, lambda: f32) -> Self {
        let mut coefficients = self.coefficients;
        for (index, coefficient) in coefficients.iter_mut().enumerate() {
            let band = band(index) as f32;
            *coefficient /= 1.0 + lambda * (band * (band + 1.0)).powi(2);
        }
        Self { coefficients }
    }

    /// The smallest value of any channel over a fixed set of normals about 6° apart.
    fn lowest(&self) -> f32 {
        const NORMALS: u32 = 1024;
        (0..NORMALS)
            .map(|i| self.unclamped(spiral(i, NORMALS)).min_element())
            .fold(f32::MAX, f32::min)
    }

    /// The same light after a turn about +Y: the irradiance that `normal` had, the turned
    /// normal has.
    #[must_use]
    pub fn turned(&self, about_y_rad: f32) -> Self {
        // Bands 1 and 2 turn as the polynomials they are: those of the turned light are those of
        // this one, of coordinates turned back.
        let (sin, cos) = (libm::sinf(about_y_rad), libm::cosf(about_y_rad));
        let [c0, y, z, x, xy, yz, z2, xz, x2] = self.coefficients;
        // Over the basis functions' factors: M of the form n·M n, without its trace.
        let (k_cross, k_z, k_x) = (1.092_548_4, 0.315_391_57, 0.546_274_2);
        let (m_xx, m_zz) = (x2 * k_x - z2 * k_z, z2 * (2.0 * k_z));
        let m_yy = -(m_xx + m_zz);
        let m_xz = xz * (0.5 * k_cross);
        // R M Rᵀ for x' = cos x + sin z, z' = cos z − sin x.
        let t_xx = m_xx * (cos * cos) + m_xz * (2.0 * sin * cos) + m_zz * (sin * sin);
        let t_zz = m_zz * (cos * cos) - m_xz * (2.0 * sin * cos) + m_xx * (sin * sin);
        let t_xz = m_xz * (cos * cos - sin * sin) + (m_zz - m_xx) * (sin * cos);
        Self {
            coefficients: [
                c0,
                y,
                z * cos - x * sin,
                x * cos + z * sin,
                xy * cos + yz * sin,
                yz * cos - xy * sin,
                t_zz / (2.0 * k_z),
                t_xz / (0.5 * k_cross),
                (t_xx - m_yy) / (2.0 * k_x),
            ],
        }
    }

    /// The same light, `factor` times as strong.
    #[must_use]
    pub fn scaled(&self, factor: f32) -> Self {
        Self {
            coefficients: self.coefficients.map(|coefficient| coefficient * factor),
        }
    }

    /// Irradiance on a surface of unit normal `normal`; never negative.
    #[must_use]
    pub fn at(&self, normal: Vec3) -> Vec3 {
        self.unclamped(normal).max(Vec3::ZERO)
    }

    /// The sum in a unit direction with each band times a factor of its own; may be negative.
    #[must_use]
    pub fn banded(&self, direction: Vec3, factors: [f32; 3]) -> Vec3 {
        self.weighted(basis(direction), factors)
    }

    /// Radiance from a unit direction, as far as three bands hold it: the cosine lobe taken out of the
    /// coefficients again. May be negative.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        self.banded(towards, WITHOUT_LOBE)
    }

    /// Mean radiance over directions ω, of which three bands need no more than the means of ω and of
    /// ωωᵀ. May be negative.
    #[must_use]
    pub fn mean_radiance(&self, mean: Vec3, mean_of_products: Mat3) -> Vec3 {
        let m = mean_of_products;
        let values = [
            0.282_094_8,
            0.488_602_5 * mean.y,
            0.488_602_5 * mean.z,
            0.488_602_5 * mean.x,
            1.092_548_4 * m.x_axis.y,
            1.092_548_4 * m.y_axis.z,
            0.315_391_57 * (3.0 * m.z_axis.z - 1.0),
            1.092_548_4 * m.x_axis.z,
            0.546_274_2 * (m.x_axis.x - m.y_axis.y),
        ];
        self.weighted(values, WITHOUT_LOBE)
    }

    fn weighted(&self, values: [f32; 9], factors: [f32; 3]) -> Vec3 {
        (self.coefficients.iter().zip(values))
            .enumerate()
            .map(|(index, (coefficient, value))| {
                *coefficient * (value * factors[band(index) as usize])
            })
            .sum()
    }

    fn unclamped(&self, normal: Vec3) -> Vec3 {
        self.coefficients
            .iter()
            .zip(basis(normal))
            .map(|(coefficient, y)| *coefficient * y)
            .sum::<Vec3>()
    }
}

/// One over what [`cosine_lobe`] keeps of each band.
const WITHOUT_LOBE: [f32; 3] = {
    use std::f32::consts::PI;
    [1.0 / PI, 1.5 / PI, 4.0 / PI]
};

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

/// The band of a coefficient.
fn band(index: usize) -> u32 {
    match index {
        0 => 0,
        1..=3 => 1,
        _ => 2,
    }
}

/// What the clamped cosine keeps of a band (Ramamoorthi and Hanrahan 2001, eq. 8).
fn cosine_lobe(index: usize) -> f32 {
    use std::f32::consts::PI;
    match band(index) {
        0 => PI,
        1 => 2.0 * PI / 3.0,
        _ => PI / 4.0,
    }
}

/// Direction `index` of `count` spread evenly over the sphere along a golden-angle spiral.
fn spiral(index: u32, count: u32) -> Vec3 {
    let y = 1.0 - 2.0 * (index as f32 + 0.5) / count as f32;
    let azimuth = 2.399_963_2 * index as f32;
    let horizontal = (1.0 - y * y).max(0.0).sqrt();
    Vec3::new(
        horizontal * libm::cosf(azimuth),
        y,
        horizontal * libm::sinf(azimuth),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::environment::{Environment, Sky};
    use crate::scene::modelling::math;
    use proptest::prelude::*;
    use std::f32::consts::PI;

    fn project(radiance: impl Fn(Vec3) -> Vec3 + Sync) -> Irradiance {
        Irradiance::of(&RadianceMap::from_fn(64, radiance))
    }

    #[test]
    fn uniform_radiance_gives_pi_everywhere() {
        let irradiance = project(|_| Vec3::ONE);
        for normal in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.0, -0.8)] {
            assert!((irradiance.at(normal) - Vec3::splat(PI)).length() < 2e-3);
        }
    }

    /// Radiance cos θ over the sphere, signed: the exact irradiance of band 1 alone
    /// is (2π/3) cos θ.
    #[test]
    fn a_linear_function_keeps_two_thirds_pi() {
        let irradiance = project(|d| Vec3::splat(d.y));
        assert!((irradiance.at(Vec3::Y).x - 2.0 * PI / 3.0).abs() < 2e-3);
        assert!((irradiance.at(Vec3::new(0.6, 0.8, 0.0)).x - 0.8 * 2.0 * PI / 3.0).abs() < 2e-3);
    }

    /// White sky over a black floor: π above, 0 below, π/2 on a wall, exactly. The
    /// projection stops at band 2, whose error for a half-space light is known to be
    /// below 1 % of the sky's π on top and on walls.
    #[test]
    fn a_half_space_of_light() {
        let irradiance = project(|d| if d.y > 0.0 { Vec3::ONE } else { Vec3::ZERO });
        assert!((irradiance.at(Vec3::Y).x - PI).abs() < 0.01 * PI);
        assert!((irradiance.at(Vec3::X).x - PI / 2.0).abs() < 0.01 * PI);
        assert!(irradiance.at(Vec3::NEG_Y).x < 0.01 * PI);
    }

    fn with_one_bright_texel(column: usize, row: usize) -> RadianceMap {
        let (width_px, height_px) = (128, 64);
        let mut texels = vec![Vec3::ZERO; width_px * height_px];
        texels[row * width_px + column] = Vec3::new(1000.0, 500.0, 2000.0);
        RadianceMap::new(width_px, height_px, texels).unwrap()
    }

    /// A distant point of flux F (radiance times solid angle) at angle θ from the normal, kept to
    /// band 2: F (1/4 + cos θ/2 + 5/32 (3 cos² θ − 1)), from the addition theorem.
    #[test]
    fn one_bright_texel_lights_as_a_point_kept_to_three_bands() {
        for (column, row) in [(64, 32), (3, 10), (100, 55), (0, 0)] {
            let map = with_one_bright_texel(column, row);
            let irradiance = Irradiance::of(&map);
            let towards = map.direction(column, row);
            let flux = 1000.0 * map.solid_angle(row) as f32;
            for i in 0..100 {
                let normal = spiral(i, 100);
                let cos = normal.dot(towards);
                let expected = flux * (0.25 + 0.5 * cos + 5.0 / 32.0 * (3.0 * cos * cos - 1.0));
                let found = irradiance.unclamped(normal);
                assert!(
                    (found.x - expected).abs() < 1e-4 * flux,
                    "{found} {expected}"
                );
                assert!((found.y - 0.5 * expected).abs() < 1e-4 * flux);
                assert!((found.z - 2.0 * expected).abs() < 2e-4 * flux);
            }
        }
    }

    #[test]
    fn ringing_goes_and_the_total_stays() {
        let raw = Irradiance::of(&with_one_bright_texel(40, 20));
        assert!(raw.lowest() < 0.0);
        let mended = raw.without_ringing();
        // Rounding may leave the lowest normal a hair below nothing.
        assert!(mended.lowest() > -1e-4 * mended.coefficients[0].max_element());
        assert_eq!(mended.coefficients[0], raw.coefficients[0]);
        // No more than needed: within a part in a thousand of touching zero.
        assert!(mended.lowest() < 1e-3 * mended.coefficients[0].max_element());
        let smooth = project(|d| Vec3::splat(2.0 + d.y));
        assert_eq!(smooth.without_ringing(), smooth);
    }

    /// Cosine-weighted radiance of every texel in front, no harmonics.
    fn brute_force(map: &RadianceMap, normal: Vec3) -> Vec3 {
        let mut sum = DVec3::ZERO;
        for row in 0..map.height_px() {
            for column in 0..map.width_px() {
                let cos = f64::from(map.direction(column, row).dot(normal).max(0.0));
                let texel = map.texels()[row * map.width_px() + column].as_dvec3();
                sum += texel * cos * map.solid_angle(row);
            }
        }
        sum.as_vec3()
    }

    /// Ramamoorthi and Hanrahan 2001: nine coefficients of natural light are right to about 1 % on
    /// average, and to 9 % of its total at worst. A sky is smooth: it is held to 9 % of the mean.
    #[test]
    fn nine_coefficients_of_a_sky_are_close_to_the_whole_integral() {
        for clouds in [0.0, 0.5] {
            let environment = Environment::sky(Sky {
                clouds,
                ..Sky::default()
            });
            let map = environment.map().halved().halved();
            let irradiance = Irradiance::of(&map).without_ringing();
            let total = map.mean() * PI;
            let errors = (0..200).map(|i| {
                let normal = spiral(i, 200);
                let error = (irradiance.at(normal) - brute_force(&map, normal)) / total;
                error.abs().max_element()
            });
            let errors: Vec<f32> = errors.collect();
            let mean = errors.iter().sum::<f32>() / errors.len() as f32;
            let worst = errors.iter().copied().fold(0.0, f32::max);
            assert!(mean < 0.015 && worst < 0.09, "mean {mean}, worst {worst}");
        }
    }

    proptest! {
        /// Turning the light and the normal together changes nothing.
        #[test]
        fn turned_light_on_a_turned_normal(
            values in proptest::array::uniform9(-2.0_f32..2.0),
            angle_rad in -7.0_f32..7.0,
            which in 0_u32..64,
        ) {
            let irradiance = Irradiance { coefficients: values.map(Vec3::splat) };
            let normal = spiral(which, 64);
            let turned_normal = math::rotation(Vec3::Y, angle_rad) * normal;
            let found = irradiance.turned(angle_rad).unclamped(turned_normal).x;
            let expected = irradiance.unclamped(normal).x;
            prop_assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
    }
}
