//! What the dragon stands on: a low base of carved waves with curls of cloud round
//! its rim, and rocks under its loop.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::scene::modelling::math::{atan2, lerp, on_circle, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};
use crate::seed;

/// Half axes of the base, metres.
const BASE_M: Vec3 = Vec3::new(0.232, 0.020, 0.135);

pub(super) fn carve(sculpture: &mut Sculpture, seed: u64) {
    let noise = Noise::new(seed, "figurine rock", 0);
    let mut random = seed::generator(seed, "figurine rock", 1);
    let mut draw = |low: f32, high: f32| lerp(low, high, seed::unit_f32(&mut random));
    let base = Frame::at(Vec3::new(-0.012, 0.004, 0.0));
    sculpture.add(Part::ellipsoid(base, BASE_M).with_relief(0.004, move |p| {
        let out = Vec3::new(p.x / BASE_M.x, 0.0, p.z / BASE_M.z).length();
        let wave = noise.gradient(Vec3::new(p.x * 22.0, 3.5, p.z * 22.0));
        let crest = 1.0 - libm::sinf(out * 26.0 + 4.0 * wave).abs();
        0.0036 * crest * smoothstep(1.0, 0.9, out)
    }));
    // Flat below, so that it stands.
    let below = Frame::at(Vec3::new(0.0, -0.05, 0.0));
    sculpture.add(
        Part::block(below, Vec3::new(0.4, 0.05, 0.4), 0.0)
            .carving()
            .blended(0.002),
    );
    let boulders = [
        ([-0.012, 0.030, -0.022], [0.052, 0.040, 0.040]),
        ([0.030, 0.022, -0.060], [0.046, 0.034, 0.036]),
        ([-0.052, 0.024, -0.050], [0.044, 0.034, 0.036]),
        ([0.020, 0.018, 0.018], [0.034, 0.022, 0.026]),
        ([0.120, 0.016, -0.030], [0.040, 0.022, 0.032]),
        ([-0.190, 0.014, 0.020], [0.030, 0.020, 0.024]),
    ];
    for (at, radii) in boulders {
        let turn = draw(0.0, 6.0);
        let frame = Frame::turned(Vec3::from(at), turn);
        sculpture.add(
            Part::ellipsoid(frame, Vec3::from(radii))
                .blended(0.006)
                .with_relief(0.008, move |p| {
                    let strata = noise.fbm(Vec3::new(p.x * 30.0, p.y * 60.0, p.z * 30.0) + turn, 3);
                    let cracks = noise.gradient(p * 60.0 + turn).abs();
                    0.006 * strata - 0.005 * smoothstep(0.10, 0.0, cracks)
                }),
        );
    }
    for i in 0..13 {
        let turn = TAU * (i as f32 + draw(-0.25, 0.25)) / 13.0;
        let c = on_circle(turn);
        let out = Vec3::new(c.x / BASE_M.x, 0.0, c.y / BASE_M.z).normalize();
        let at = Vec3::new(BASE_M.x * c.x * 0.84 - 0.012, 0.012, BASE_M.z * c.y * 0.84);
        let along = Vec3::Y.cross(out);
        let size = draw(0.017, 0.023);
        let hand = if i % 2 == 0 { 1.0 } else { -1.0 };
        cloud(sculpture, at, out, size, hand);
        let beside = at + along * (hand * 1.35 * size) - Vec3::Y * 0.003;
        cloud(sculpture, beside, out, 0.62 * size, -hand);
    }
}

/// A curl of cloud: a lump with a spiral cut into its outer face.
fn cloud(sculpture: &mut Sculpture, at: Vec3, out: Vec3, size_m: f32, hand: f32) {
    let frame = Frame::along(at, Vec3::Y, out + Vec3::Y * 0.35);
    let pitch = 0.36 * size_m;
    sculpture.add(
        Part::ellipsoid(frame, Vec3::new(size_m, 0.85 * size_m, 0.62 * size_m))
            .blended(0.003)
            .with_relief(0.16 * size_m, move |p| {
                let turns = hand * atan2(p.y, p.x) / TAU;
                let distance = Vec3::new(p.x, p.y, 0.0).length();
                let winding = distance / pitch - turns;
                let across = (winding - winding.floor() - 0.5).abs();
                0.15 * size_m
                    * (smoothstep(0.5, 0.22, across) - 0.5)
                    * smoothstep(0.0, 0.3 * size_m, p.z)
            }),
    );
}
