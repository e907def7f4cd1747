//! Seeded points for kernels and noise tiles.

use glam::Vec3;
use rand_chacha::ChaCha20Rng;

use crate::seed::unit_f32;

/// A point on the unit sphere, evenly distributed (Archimedes: height and azimuth are).
pub fn on_sphere(rng: &mut ChaCha20Rng) -> Vec3 {
    let z = 2.0 * unit_f32(rng) - 1.0;
    let (sin_phi, cos_phi) = (std::f32::consts::TAU * unit_f32(rng)).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * cos_phi, radius * sin_phi, z)
}

/// `count` points in the unit sphere: directions spread by a Fibonacci lattice (even at any
/// count, where independent draws clump), lengths random and even between 0 and 1, the
/// whole turned by a random rotation.
pub fn in_sphere(count: usize, rng: &mut ChaCha20Rng) -> Vec<[f32; 4]> {
    const GOLDEN_ANGLE_RAD: f32 = 2.399_963_2;
    let turn = glam::Quat::from_rotation_arc(Vec3::Z, on_sphere(rng));
    let spin = std::f32::consts::TAU * unit_f32(rng);
    (0..count)
        .map(|index| {
            let z = 1.0 - 2.0 * (index as f32 + 0.5) / count as f32;
            let radius = (1.0 - z * z).max(0.0).sqrt();
            let (sin_phi, cos_phi) = (spin + GOLDEN_ANGLE_RAD * index as f32).sin_cos();
            let direction = turn * Vec3::new(radius * cos_phi, radius * sin_phi, z);
            // A length of 0 would sample the pixel itself.
            (direction * unit_f32(rng).max(0.05)).extend(0.0).to_array()
        })
        .collect()
}
