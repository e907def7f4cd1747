//! Laced boots with soles, heels and tongues.

use glam::Vec3;

use super::person::{Build, Layer, Stuff};
use super::pose::Pose;
use crate::scene::modelling::math::smoothstep;
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};
use crate::scene::texture::srgb;

pub(super) fn layer(pose: &Pose, build: &Build, noise: Noise) -> Layer {
    let mut s = Sculpture::new();
    for side in 0..2 {
        boot(&mut s, pose, build, noise, side);
    }
    let (leather, sole) = (srgb(build.boots), srgb(0x2b2723));
    Layer {
        name: "boots",
        stuff: Stuff::Leather,
        sculpture: s,
        cell_m: 0.0051,
        paint: Box::new(move |p, _| leather.lerp(sole, smoothstep(0.032, 0.027, p.y))),
    }
}

fn boot(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise, side: usize) {
    let k = if build.woman { 0.9 } else { 1.0 };
    let (ankle, knee, toes) = (pose.ankles[side], pose.knees[side], pose.toes[side]);
    // On the ground: x to the left of the foot, z ahead, origin under the ankle.
    let heel = Vec3::new(ankle.x, 0.0, ankle.z);
    let left = Vec3::Y.cross(toes);
    let at = |x: f32, y: f32, z: f32| heel + left * (x * k) + Vec3::Y * y + toes * (z * k);
    let flat = |x: f32, y: f32, z: f32| Frame {
        origin_m: at(x, y, z),
        axes: glam::Mat3::from_cols(left, Vec3::Y, toes),
    };
    let inward = if side == 0 { 0.006 } else { -0.006 };
    // Upper: heel, instep, toe cap.
    s.add(Part::ellipsoid(
        flat(0.0, 0.058, -0.03),
        Vec3::new(0.041, 0.055, 0.048) * k,
    ));
    s.add(
        Part::limb(
            (at(0.0, 0.095, 0.0), 0.044 * k),
            (at(inward, 0.055, 0.12), 0.037 * k),
            Vec3::Y,
        )
        .blended(0.03)
        .with_relief(0.004, move |p| {
            let crease = noise.gradient(Vec3::new(p.x * 10.0, p.y * 75.0, 1.5));
            0.0028 * crease * smoothstep(0.03, 0.09, p.y)
        }),
    );
    s.add(
        Part::ellipsoid(
            flat(inward, 0.046, 0.165),
            Vec3::new(0.047, 0.036, 0.052) * k,
        )
        .blended(0.025),
    );
    s.add(
        Part::ellipsoid(
            flat(inward, 0.046, 0.172),
            Vec3::new(0.0485, 0.0375, 0.047) * k,
        )
        .blended(0.001),
    );
    // Shaft, to mid-calf on her, over the ankle on him.
    let up = (knee - ankle).normalize();
    let top = if build.woman {
        ankle.lerp(knee, 0.48)
    } else {
        ankle + up * 0.11
    };
    let width = if build.woman { 0.066 } else { 0.054 };
    s.add(
        Part::limb((ankle - up * 0.01, 0.047 * k), (top, width), Vec3::Z)
            .blended(0.03)
            .with_relief(0.006, move |p| {
                let fold = noise.gradient(Vec3::new(p.x * 7.0, p.y * 34.0, p.z * 7.0));
                0.005 * (1.0 - 2.0 * fold.abs()) * smoothstep(0.16, 0.03, p.y)
            }),
    );
    if build.woman {
        let rim = Frame::along(top - up * 0.004, up, Vec3::Z);
        s.add(
            Part::new(
                rim,
                crate::scene::modelling::sdf::Shape::Torus {
                    major_m: width - 0.002,
                    minor_m: 0.009,
                },
            )
            .blended(0.004),
        );
    }
    let cut = Frame::along(top + up * 0.052, up, Vec3::Z);
    s.add(
        Part::block(cut, Vec3::new(0.12, 0.05, 0.12), 0.0)
            .carving()
            .blended(0.004),
    );
    laces(s, pose, side, k);
    sole(s, &flat, inward, k);
}

fn laces(s: &mut Sculpture, pose: &Pose, side: usize, k: f32) {
    let (ankle, toes) = (pose.ankles[side], pose.toes[side]);
    let left = Vec3::Y.cross(toes);
    let heel = Vec3::new(ankle.x, 0.0, ankle.z);
    for i in 0..5 {
        let t = i as f32 / 4.0;
        let (y, z) = (0.142 - 0.052 * t, 0.030 + 0.075 * t);
        let middle = heel + Vec3::Y * (y + 0.002) + toes * (z * k + 0.012);
        let ends =
            [-1.0, 1.0].map(|x| middle + left * (x * 0.022 * k) - Vec3::Y * 0.006 - toes * 0.004);
        s.add(Part::limb((ends[0], 0.0042), (middle, 0.0042), Vec3::Y));
        s.add(Part::limb((middle, 0.0042), (ends[1], 0.0042), Vec3::Y));
        for end in ends {
            s.add(Part::ball(end, 0.006));
        }
    }
}

fn sole(s: &mut Sculpture, flat: &dyn Fn(f32, f32, f32) -> Frame, inward: f32, k: f32) {
    let welt = |x: f32, y: f32, z: f32, half: [f32; 3]| {
        Part::ellipsoid(flat(x, y, z), Vec3::from(half) * k)
    };
    // A slab in the outline of a foot: three flat discs melted, cut off at the ground.
    for (x, z, half) in [
        (0.0, -0.032, [0.047, 0.026, 0.052]),
        (0.5 * inward, 0.06, [0.040, 0.024, 0.085]),
        (inward, 0.155, [0.053, 0.024, 0.070]),
    ] {
        s.add(welt(x, 0.020, z, half).blended(0.016));
    }
    let below = flat(0.0, -0.05, 0.05);
    s.add(
        Part::block(below, Vec3::new(0.2, 0.05, 0.3), 0.0)
            .carving()
            .blended(0.003),
    );
    // The step between heel and ball.
    let arch = flat(0.0, -0.001, 0.045);
    s.add(
        Part::block(arch, Vec3::new(0.09, 0.010, 0.028), 0.004)
            .carving()
            .blended(0.004),
    );
}
