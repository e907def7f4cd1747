//! Hair: a shell about the skull combed into strands; short on him, drawn back into
//! a tail on her.

use glam::Vec3;

use super::person::{Build, Layer, Stuff};
use super::pose::Pose;
use crate::scene::modelling::math::{catmull_rom, sin, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};
use crate::scene::texture::srgb;

pub(super) fn layer(pose: &Pose, build: &Build, noise: Noise) -> Layer {
    let mut s = Sculpture::new();
    let k = build.head;
    let egg = |at: [f32; 3], radii: [f32; 3]| {
        let frame = Frame {
            origin_m: pose.head.point(Vec3::from(at) * k),
            axes: pose.head.axes,
        };
        Part::ellipsoid(frame, Vec3::from(radii) * k)
    };
    let combed = move |p: Vec3| {
        // Strands run from the brow backwards: fine across x, long along the comb.
        let around = libm::atan2f(p.x, p.y.max(0.01));
        let warp = noise.gradient(p * 30.0);
        let strand = noise.gradient(Vec3::new(around * 22.0 + 0.9 * warp, p.z * 16.0, 3.5));
        let fine = noise.gradient(Vec3::new(around * 60.0 + warp, p.z * 30.0, 8.5));
        0.0045 * (1.0 - 2.4 * strand.abs()) + 0.0018 * fine
    };
    if build.woman {
        s.add(egg([0.0, 0.034, -0.017], [0.0835, 0.0895, 0.1010]).with_relief(0.007, combed));
    } else {
        s.add(egg([0.0, 0.040, -0.014], [0.0800, 0.0880, 0.0985]).with_relief(0.007, combed));
        s.add(
            egg([0.010, 0.094, 0.044], [0.050, 0.028, 0.042])
                .blended(0.02 * k)
                .with_relief(0.007, combed),
        );
    }
    // Free the face, the ears and the nape.
    let low = if build.woman { 0.0 } else { 0.004 };
    s.add(
        egg([0.0, -0.026 + low, 0.092], [0.064, 0.084, 0.060])
            .carving()
            .blended(0.008),
    );
    for side in [-1.0, 1.0] {
        s.add(
            egg([side * 0.092, -0.030, 0.012], [0.026, 0.056, 0.052])
                .carving()
                .blended(0.008),
        );
    }
    s.add(
        egg([0.0, -0.125, -0.020], [0.13, 0.066, 0.13])
            .carving()
            .blended(0.012),
    );
    if build.woman {
        tail(&mut s, pose, k, noise);
    }
    let color = srgb(build.hair);
    Layer {
        name: "hair",
        stuff: Stuff::Hair,
        sculpture: s,
        cell_m: 0.0035,
        paint: Box::new(move |p, _| {
            let tone = noise.gradient(Vec3::new(p.x * 160.0, p.y * 26.0, p.z * 60.0));
            color * (1.0 + 0.3 * tone + 0.25 * smoothstep(0.0, 0.6, tone))
        }),
    }
}

/// A tail from the crown down the back, and two loose locks at the temples.
fn tail(s: &mut Sculpture, pose: &Pose, k: f32, noise: Noise) {
    let at = |p: [f32; 3]| pose.head.point(Vec3::from(p) * k);
    let strand = |s: &mut Sculpture, points: &[[f32; 4]], blend: f32| {
        const STEPS: usize = 14;
        let knot = |i: usize| {
            let [x, y, z, r] = catmull_rom(points, i as f32 / STEPS as f32);
            (at([x, y, z]), r * k)
        };
        for i in 0..STEPS {
            s.add(
                Part::limb(knot(i), knot(i + 1), Vec3::Z)
                    .blended(blend)
                    .with_relief(0.003, move |p| {
                        let around = libm::atan2f(p.x, p.z);
                        0.0028 * noise.gradient(Vec3::new(around * 3.0, 2.0 * p.y, 5.5))
                            + 0.001 * sin(around * 9.0)
                    }),
            );
        }
    };
    strand(
        s,
        &[
            [0.0, 0.050, -0.105, 0.020],
            [0.0, 0.045, -0.140, 0.030],
            [0.006, -0.020, -0.160, 0.034],
            [0.010, -0.100, -0.145, 0.030],
            [0.004, -0.180, -0.135, 0.016],
            [0.000, -0.215, -0.140, 0.004],
        ],
        0.01,
    );
    for side in [-1.0, 1.0] {
        strand(
            s,
            &[
                [side * 0.040, 0.082, 0.062, 0.008],
                [side * 0.068, 0.035, 0.055, 0.0085],
                [side * 0.074, -0.020, 0.040, 0.006],
                [side * 0.066, -0.070, 0.046, 0.0018],
            ],
            0.006,
        );
    }
}
