//! The rays of a texel: one of some well-spread patterns, turned about the normal.

use std::f32::consts::TAU;

use glam::Vec3;
use rand_chacha::rand_core::Rng;

use crate::reference::Weighting;
use crate::reference::sobol::{Scramble, Sobol, mix};
use crate::seed;

/// How many patterns there are: neighbours rarely have the same, and all fit into a cache.
const PATTERNS: usize = 64;

/// Directions over the hemisphere round +Z, uniform in solid angle.
#[derive(Debug)]
pub(super) struct Directions {
    rays: usize,
    /// Pattern by pattern.
    directions: Vec<Vec3>,
    base: u64,
}

impl Directions {
    /// Patterns of `rays` directions, a power of two.
    pub fn new(rays: usize, seed: u64) -> Self {
        let sobol = Sobol::new(rays);
        let base = seed::generator(seed, "height-field-directions", 0).next_u64();
        let directions = (0..PATTERNS)
            .flat_map(|pattern| {
                let scramble = Scramble::new(base, pattern as u64, 0);
                (0..rays)
                    .map(|ray| Weighting::Uniform.direction(sobol.point(ray, scramble)))
                    .collect::<Vec<_>>()
            })
            .collect();
        Self {
            rays,
            directions,
            base,
        }
    }

    /// The pattern of a texel, and the sine and cosine of how far it is turned.
    fn of(&self, texel: usize) -> (&[Vec3], (f32, f32)) {
        let bits = mix(self.base ^ texel as u64);
        let pattern = bits as usize % PATTERNS;
        let turn = (bits >> 40) as f32 / (1_u64 << 24) as f32;
        (
            &self.directions[pattern * self.rays..(pattern + 1) * self.rays],
            (TAU * turn).sin_cos(),
        )
    }

    /// The directions of a texel's rays, round +Z.
    pub fn turned(&self, texel: usize) -> impl Iterator<Item = Vec3> + '_ {
        let (pattern, (sin, cos)) = self.of(texel);
        pattern
            .iter()
            .map(move |d| Vec3::new(cos * d.x - sin * d.y, sin * d.x + cos * d.y, d.z))
    }

    /// Their cosines to the normal.
    pub fn cosines(&self, texel: usize) -> impl Iterator<Item = f32> + '_ {
        self.of(texel).0.iter().map(|d| d.z)
    }
}
