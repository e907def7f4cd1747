//! Radiance from far away as an equirectangular picture.

use glam::Vec3;
use rayon::prelude::*;

use crate::scene::modelling::math;

/// Linear RGB radiance by direction: columns are azimuth, rows run from straight up
/// to straight down.
///
/// The middle of the picture is −Z (what a camera sees by default), and its right half is +X: a
/// panorama looks as it did to whoever stood in it. Texel (0, 0) is at the top left; its
/// centre lies half a texel inside. The unit of radiance is the maker's own.
#[derive(Debug, Clone, PartialEq)]
pub struct RadianceMap {
    width_px: usize,
    height_px: usize,
    texels: Vec<Vec3>,
}

impl RadianceMap {
    /// A map from its texels, rows from the top; `None` unless there are
    /// `width_px × height_px` of them and at least one.
    #[must_use]
    pub fn new(width_px: usize, height_px: usize, texels: Vec<Vec3>) -> Option<Self> {
        let matches = width_px.checked_mul(height_px) == Some(texels.len()) && !texels.is_empty();
        matches.then_some(Self {
            width_px,
            height_px,
            texels,
        })
    }

    /// Evaluates a radiance function at the centre of each of `2 height_px × height_px` texels.
    ///
    /// # Panics
    /// If `height_px` is 0: a map has at least one row.
    #[must_use]
    pub fn from_fn(height_px: usize, radiance: impl Fn(Vec3) -> Vec3 + Sync) -> Self {
        assert!(height_px > 0, "a map has at least one row");
        let width_px = 2 * height_px;
        let texels = (0..width_px * height_px)
            .into_par_iter()
            .map(|index| {
                let (column, row) = (index % width_px, index / width_px);
                radiance(direction_at(
                    (column as f32 + 0.5) / width_px as f32,
                    (row as f32 + 0.5) / height_px as f32,
                ))
            })
            .collect();
        Self {
            width_px,
            height_px,
            texels,
        }
    }

    /// Columns.
    #[must_use]
    pub fn width_px(&self) -> usize {
        self.width_px
    }

    /// Rows.
    #[must_use]
    pub fn height_px(&self) -> usize {
        self.height_px
    }

    /// The texels, rows from the top.
    #[must_use]
    pub fn texels(&self) -> &[Vec3] {
        &self.texels
    }

    /// Unit direction of a texel's centre.
    #[must_use]
    pub fn direction(&self, column: usize, row: usize) -> Vec3 {
        direction_at(
            (column as f32 + 0.5) / self.width_px as f32,
            (row as f32 + 0.5) / self.height_px as f32,
        )
    }

    /// Solid angle of each texel of a row, steradians: exact, so that they sum to 4π.
    #[must_use]
    pub fn solid_angle(&self, row: usize) -> f64 {
        let edge =
            |row: usize| libm::cos(std::f64::consts::PI * row as f64 / self.height_px as f64);
        std::f64::consts::TAU / self.width_px as f64 * (edge(row) - edge(row + 1))
    }

    /// Radiance from unit direction `towards`: bilinear, round the azimuth and up to the poles.
    #[must_use]
    pub fn at(&self, towards: Vec3) -> Vec3 {
        let (u, v) = coordinates(towards);
        let x = u * self.width_px as f32 - 0.5;
        let y = (v * self.height_px as f32 - 0.5).clamp(0.0, (self.height_px - 1) as f32);
        let (left, top) = (x.floor(), y.floor());
        let (part_x, part_y) = (x - left, y - top);
        let left = (left as i64).rem_euclid(self.width_px as i64) as usize;
        let right = (left + 1) % self.width_px;
        let top = top as usize;
        let bottom = (top + 1).min(self.height_px - 1);
        let texel = |column, row| self.texels[row * self.width_px + column];
        texel(left, top).lerp(texel(right, top), part_x).lerp(
            texel(left, bottom).lerp(texel(right, bottom), part_x),
            part_y,
        )
    }

    /// The integral of radiance over the sphere, divided by 4π.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        let mut sum = glam::DVec3::ZERO;
        for (row, texels) in self.texels.chunks_exact(self.width_px).enumerate() {
            let row_sum: glam::DVec3 = texels.iter().map(|texel| texel.as_dvec3()).sum();
            sum += row_sum * self.solid_angle(row);
        }
        (sum / (4.0 * std::f64::consts::PI)).as_vec3()
    }

    /// A map of half the columns and rows, whose texels are the averages, by solid angle, of
    /// those they replace; a side of 1 stays, and the last of an odd number joins its neighbour.
    #[must_use]
    pub fn halved(&self) -> Self {
        let (width_px, height_px) = ((self.width_px / 2).max(1), (self.height_px / 2).max(1));
        let span = |index: usize, count: usize, full: usize| {
            let end = if index + 1 == count {
                full
            } else {
                2 * index + 2
            };
            (2 * index).min(full - 1)..end
        };
        let average = |index: usize| {
            let (column, row) = (index % width_px, index / width_px);
            let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
            for y in span(row, height_px, self.height_px) {
                let solid_angle = self.solid_angle(y) as f32;
                for x in span(column, width_px, self.width_px) {
                    sum += self.texels[y * self.width_px + x] * solid_angle;
                    weight += solid_angle;
                }
            }
            sum / weight
        };
        Self {
            width_px,
            height_px,
            texels: (0..width_px * height_px).map(average).collect(),
        }
    }
}

/// Where a unit direction lies in the picture, both from 0 to 1.
#[must_use]
pub fn coordinates(towards: Vec3) -> (f32, f32) {
    use std::f32::consts::{PI, TAU};
    let u = 0.5 + math::atan2(towards.x, -towards.z) / TAU;
    // Not the arc cosine of y, which loses half its digits near the poles.
    let horizontal = (towards.x * towards.x + towards.z * towards.z).sqrt();
    (u, math::atan2(horizontal, towards.y) / PI)
}

/// The unit direction of a place in the picture; inverse of [`coordinates`].
#[must_use]
pub fn direction_at(u: f32, v: f32) -> Vec3 {
    use std::f32::consts::{PI, TAU};
    let (azimuth, from_up) = ((u - 0.5) * TAU, v * PI);
    let horizontal = math::sin(from_up);
    Vec3::new(
        horizontal * math::sin(azimuth),
        math::cos(from_up),
        -horizontal * math::cos(azimuth),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_middle_is_ahead_and_the_right_is_right() {
        for (direction, (u, v)) in [
            (Vec3::NEG_Z, (0.5, 0.5)),
            (Vec3::X, (0.75, 0.5)),
            (Vec3::NEG_X, (0.25, 0.5)),
            (Vec3::Y, (0.5, 0.0)),
            (Vec3::NEG_Y, (0.5, 1.0)),
        ] {
            let found = coordinates(direction);
            assert!((found.1 - v).abs() < 1e-6, "{direction}: {found:?}");
            // The azimuth of a pole means nothing.
            assert!(
                direction.y != 0.0 || (found.0 - u).abs() < 1e-6,
                "{found:?}"
            );
        }
    }

    #[test]
    fn solid_angles_sum_to_the_sphere() {
        for height_px in [1, 2, 7, 64] {
            let map = RadianceMap::from_fn(height_px, |_| Vec3::ONE);
            let sum: f64 = (0..height_px)
                .map(|row| map.solid_angle(row) * map.width_px() as f64)
                .sum();
            assert!((sum - 4.0 * std::f64::consts::PI).abs() < 1e-9, "{sum}");
            assert!((map.mean() - Vec3::ONE).length() < 1e-6);
        }
    }

    #[test]
    fn the_azimuth_has_no_seam() {
        let map = RadianceMap::from_fn(16, |d| Vec3::splat(1.0 + d.x));
        // Behind, where the picture's left and right edges meet.
        let (left, right) = (
            map.at(Vec3::new(-1e-4, 0.0, 1.0).normalize()),
            map.at(Vec3::new(1e-4, 0.0, 1.0).normalize()),
        );
        assert!((left - right).length() < 1e-3, "{left} {right}");
    }

    #[test]
    fn a_map_needs_as_many_texels_as_it_says() {
        assert!(RadianceMap::new(4, 2, vec![Vec3::ONE; 8]).is_some());
        assert!(RadianceMap::new(4, 2, vec![Vec3::ONE; 7]).is_none());
        assert!(RadianceMap::new(0, 0, Vec::new()).is_none());
        assert!(RadianceMap::new(usize::MAX, 2, Vec::new()).is_none());
    }

    proptest! {
        #[test]
        fn directions_and_coordinates_are_inverse(u in 0.001_f32..0.999, v in 0.01_f32..0.99) {
            let direction = direction_at(u, v);
            prop_assert!((direction.length() - 1.0).abs() < 1e-5);
            let (u2, v2) = coordinates(direction);
            prop_assert!((u - u2).abs() < 1e-4 && (v - v2).abs() < 1e-4, "{u2} {v2}");
        }

        /// Halving averages: no light appears or is lost, whatever the size.
        #[test]
        fn halving_keeps_the_mean(
            width_px in 1_usize..12,
            height_px in 1_usize..9,
            values in proptest::collection::vec(0.0_f32..100.0, 12 * 9),
        ) {
            let texels = values[..width_px * height_px].iter().map(|&v| Vec3::splat(v)).collect();
            let map = RadianceMap::new(width_px, height_px, texels).unwrap();
            let (before, after) = (map.mean().x, map.halved().mean().x);
            // With an odd number of columns the last ones join: as many texels, less evenly.
            let even = width_px == 1 || width_px.is_multiple_of(2);
            let even = even && (height_px == 1 || height_px.is_multiple_of(2));
            prop_assert!(!even || (before - after).abs() < 1e-3 * before.max(1.0), "{before} {after}");
        }
    }
}
