//! Directions spread as an environment is bright, so that rays find its lamps.

use glam::{Mat3, Vec3};

use super::lit::luminance;
use crate::scene::Environment;
use crate::scene::environment::RadianceMap;
use crate::scene::environment::map::{coordinates, direction_at};
use crate::scene::modelling::math;

/// Directions over the whole sphere by the luminance of an environment's map.
#[derive(Debug)]
pub struct BrightDirections<'a> {
    map: &'a RadianceMap,
    world_from_map: Mat3,
    /// Directions a steradian, of each texel.
    densities: Vec<f32>,
    /// Share of the directions up to and with each texel.
    shares: Vec<f64>,
}

impl<'a> BrightDirections<'a> {
    /// By the brightness of `environment`; `None` if it is dark.
    #[must_use]
    pub fn new(environment: &'a Environment) -> Option<Self> {
        let map = environment.map();
        let (width, height) = (map.width_px(), map.height_px());
        let texel = |x: usize, y: usize| f64::from(luminance(map.texels()[y * width + x]).max(0.0));
        // Radiance is looked up between four texels: a lamp shines over its own texels' borders.
        let about = |index: usize| {
            let (x, y) = (index % width, index / width);
            let rows = [y.saturating_sub(1), y, (y + 1).min(height - 1)];
            let columns = [x + width - 1, x, x + 1].map(|x| x % width);
            let sum: f64 = (rows.iter())
                .flat_map(|&y| columns.map(|x| texel(x, y)))
                .sum();
            sum / 9.0
        };
        let weights: Vec<f64> = (0..width * height).map(about).collect();
        let mut total = 0.0;
        let sums: Vec<f64> = (weights.iter().enumerate())
            .map(|(index, weight)| {
                total += weight * map.solid_angle(index / width);
                total
            })
            .collect();
        (total > 0.0).then(|| Self {
            map,
            world_from_map: math::rotation(Vec3::Y, environment.about_y_rad()),
            densities: (weights.iter())
                .map(|weight| (weight / total) as f32)
                .collect(),
            shares: sums.iter().map(|sum| sum / total).collect(),
        })
    }

    /// How densely directions lie about a unit direction of the world, a steradian: 1 over the sphere.
    #[must_use]
    pub fn density(&self, towards: Vec3) -> f32 {
        let (width, height) = (self.map.width_px(), self.map.height_px());
        let (u, v) = coordinates(self.world_from_map.transpose() * towards);
        let column = ((u * width as f32).max(0.0) as usize).min(width - 1);
        let row = ((v * height as f32).max(0.0) as usize).min(height - 1);
        self.densities[row * width + column]
    }

    /// The direction of a point of the unit square; points spread evenly give directions so dense.
    #[must_use]
    pub fn direction(&self, [u, v]: [f32; 2]) -> Vec3 {
        let (width, height) = (self.map.width_px(), self.map.height_px());
        let place = f64::from(u);
        let texel = (self.shares)
            .partition_point(|share| *share <= place)
            .min(self.shares.len() - 1);
        let before = if texel == 0 {
            0.0
        } else {
            self.shares[texel - 1]
        };
        let part = (place - before) / (self.shares[texel] - before).max(f64::MIN_POSITIVE);
        let (column, row) = (texel % width, texel / width);
        let edge = |row: usize| math::cos(std::f32::consts::PI * row as f32 / height as f32);
        // Even in height, and so in solid angle.
        let height_at = edge(row) + v * (edge(row + 1) - edge(row));
        let across = (1.0 - height_at * height_at).max(0.0).sqrt();
        let from_up = math::atan2(across, height_at) / std::f32::consts::PI;
        let turn = (column as f32 + part.clamp(0.0, 1.0) as f32) / width as f32;
        self.world_from_map * direction_at(turn, from_up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of a function over the directions, divided by their density, is its integral; and they go
    /// where the light is, turned as it is.
    #[test]
    fn directions_are_as_dense_as_they_say() {
        let map = RadianceMap::from_fn(16, |d| Vec3::splat(if d.x > 0.9 { 100.0 } else { 1.0 }));
        let environment = Environment::from_map(map).turned(1.0);
        let bright = BrightDirections::new(&environment).unwrap();
        let towards = math::rotation(Vec3::Y, 1.0) * Vec3::X;
        let (mut integral, mut light, mut near) = (0.0, 0.0, 0);
        const SIDE: u32 = 200;
        for index in 0..SIDE * SIDE {
            let at = |i: u32| (i as f32 + 0.5) / SIDE as f32;
            let direction = bright.direction([at(index % SIDE), at(index / SIDE)]);
            assert!((direction.length() - 1.0).abs() < 1e-5);
            let density = bright.density(direction);
            integral += 1.0 / density / (SIDE * SIDE) as f32;
            light += environment.radiance(direction).x / density / (SIDE * SIDE) as f32;
            near += u32::from(direction.dot(towards) > 0.8);
        }
        let sphere = 4.0 * std::f32::consts::PI;
        assert!((integral / sphere - 1.0).abs() < 0.03, "{integral}");
        let mean = environment.map().mean().x * sphere;
        assert!((light / mean - 1.0).abs() < 0.05, "{light}, {mean}");
        assert!(near > SIDE * SIDE * 7 / 10, "{near}");
        let dark = Environment::from_map(RadianceMap::from_fn(2, |_| Vec3::ZERO));
        assert!(BrightDirections::new(&dark).is_none());
    }
}
