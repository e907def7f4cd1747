//! The rock the dragon winds about, on a low round base.

use glam::Vec3;

use crate::scene::modelling::math::smoothstep;
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};
use crate::seed;

pub(super) fn carve(sculpture: &mut Sculpture, seed: u64) {
    let noise = Noise::new(seed, "figurine rock", 0);
    let mut random = seed::generator(seed, "figurine rock", 1);
    let mut draw = |low: f32, high: f32| low + (high - low) * seed::unit_f32(&mut random);
    // The base: a disc with a rounded rim, worked with waves.
    let base = Frame::at(Vec3::new(0.0, 0.004, 0.0));
    sculpture.add(
        Part::ellipsoid(base, Vec3::new(0.152, 0.020, 0.152)).with_relief(0.004, move |p| {
            let distance = Vec3::new(p.x, 0.0, p.z).length();
            let wave = noise.gradient(Vec3::new(p.x * 26.0, 3.5, p.z * 26.0));
            let crest = 1.0 - (libm::sinf(distance * 190.0 + 5.0 * wave)).abs();
            0.0036 * crest * smoothstep(0.152, 0.13, distance)
        }),
    );
    // Boulders, facetted by fractures, leaning on each other up to the neck.
    let boulders = [
        ([0.0, 0.040, 0.0], [0.080, 0.060, 0.078]),
        ([0.012, 0.095, -0.008], [0.050, 0.060, 0.050]),
        ([-0.012, 0.140, 0.010], [0.036, 0.052, 0.036]),
        ([0.004, 0.185, 0.0], [0.022, 0.044, 0.022]),
        ([-0.055, 0.026, 0.030], [0.045, 0.034, 0.042]),
        ([0.050, 0.026, 0.045], [0.042, 0.032, 0.040]),
        ([0.030, 0.030, -0.058], [0.046, 0.036, 0.040]),
    ];
    for (at, radii) in boulders {
        let turn = draw(0.0, 6.0);
        let frame = Frame::turned(Vec3::from(at), turn);
        sculpture.add(
            Part::ellipsoid(frame, Vec3::from(radii))
                .blended(0.012)
                .with_relief(0.008, move |p| {
                    let strata = noise.fbm(Vec3::new(p.x * 22.0, p.y * 55.0, p.z * 22.0) + turn, 3);
                    let cracks = noise.gradient(p * 48.0 + turn).abs();
                    0.007 * strata - 0.004 * smoothstep(0.12, 0.0, cracks)
                }),
        );
    }
}
