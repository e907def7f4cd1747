//! Cloth over limbs, with the folds that joints and gravity make; trousers.

use glam::Vec3;

use super::person::Build;
use super::pose::Pose;
use crate::scene::modelling::math::{lerp, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};

/// Sharp-crested wrinkles, −1 to 1, that run across the y axis of `p` (metres),
/// slanting; `fineness` is wrinkles a metre.
pub(super) fn wrinkles(noise: Noise, p: Vec3, fineness: f32, slant: f32) -> f32 {
    let warp = noise.gradient(p * (0.45 * fineness) + Vec3::splat(31.7));
    let across = p.y + slant * p.x + 0.35 * slant * p.z;
    let q = Vec3::new(p.x * 0.42, across + 0.35 * warp / fineness, p.z * 0.42) * fineness;
    let v = noise.gradient(q);
    let crest = 1.0 - 2.0 * v.abs().min(0.5);
    2.0 * crest * crest.sqrt() - 1.05
}

/// Part of a limb, with wrinkles whose height at `t` (0 to 1 along it) is `height_m(t)`.
pub(super) fn sleeve(
    a: (Vec3, f32),
    b: (Vec3, f32),
    noise: Noise,
    fineness: f32,
    limit_m: f32,
    height_m: impl Fn(f32) -> f32 + Send + Sync + 'static,
) -> Part {
    let length = a.0.distance(b.0);
    let slant = if a.0.x < 0.0 { 0.7 } else { -0.7 };
    Part::limb(a, b, Vec3::Z).with_relief(limit_m, move |p| {
        let t = p.y / length;
        // Where the broad folds go, the fine ones lie flat, so that they do not cross.
        let broad = wrinkles(noise, p, fineness * 0.5, slant);
        let fine = wrinkles(noise, p + Vec3::splat(5.0), fineness * 0.9, 0.3 * slant);
        let quiet = smoothstep(0.5, -0.5, broad);
        (height_m(t) * (0.9 * broad + 0.3 * fine * quiet)).clamp(-limit_m, limit_m)
    })
}

/// Trousers from the waist to over the boots (or into them, for the woman).
pub(super) fn trousers(pose: &Pose, build: &Build, noise: Noise) -> Sculpture {
    let g = build.girth;
    let mut s = Sculpture::new();
    let middle = (pose.hips[0] + pose.hips[1]) * 0.5;
    let hip_width = if build.woman { 0.178 } else { 0.168 } * lerp(1.0, g, 0.5);
    let pelvis = Frame::along(middle, pose.waist - middle, Vec3::Z);
    s.add(
        Part::ellipsoid(pelvis, Vec3::new(hip_width, 0.155, 0.118 * g)).with_relief(
            0.006,
            move |p| {
                // Folds fan out from the crotch.
                let fan = wrinkles(
                    noise,
                    Vec3::new(p.x * 0.5, p.y + p.x.abs() * 0.9, p.z),
                    26.0,
                    0.0,
                );
                0.0018 * fan * smoothstep(0.03, -0.08, p.y)
            },
        ),
    );
    // Waistband.
    let band = Frame::along(middle.lerp(pose.waist, 0.75), pose.waist - middle, Vec3::Z);
    s.add(Part::ellipsoid(band, Vec3::new(0.152 * g, 0.075, 0.108 * g)).blended(0.05));
    for side in 0..2 {
        leg(&mut s, pose, build, noise, side);
    }
    s
}

fn leg(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise, side: usize) {
    let g = build.girth;
    let (hip, knee, ankle) = (pose.hips[side], pose.knees[side], pose.ankles[side]);
    let seat = hip + Vec3::new(0.0, -0.035, -0.045);
    s.add(Part::ellipsoid(Frame::at(seat), Vec3::new(0.088, 0.10, 0.085) * g).blended(0.06));
    let thigh = sleeve(
        (hip - Vec3::Y * 0.02, 0.098 * g),
        (knee, 0.071 * g),
        noise,
        24.0,
        0.012,
        |t| 0.0025 + 0.006 * smoothstep(0.25, 0.0, t) + 0.008 * smoothstep(0.65, 1.0, t),
    );
    s.add(thigh.blended(0.05));
    let tucked = build.woman;
    let (end, cuff) = if tucked {
        (ankle.lerp(knee, 0.30), 0.053 * g)
    } else {
        (ankle + Vec3::Y * 0.015, 0.068 * g)
    };
    let calf = knee.lerp(end, 0.35) - Vec3::Z * 0.012;
    s.add(Part::limb((knee, 0.069 * g), (calf, 0.070 * g), Vec3::Z).blended(0.04));
    let shin = sleeve(
        (knee, 0.068 * g),
        (end, cuff),
        noise,
        30.0,
        0.013,
        move |t| {
            let stacked = if tucked { 0.005 } else { 0.011 };
            0.003 + 0.008 * smoothstep(0.3, 0.0, t) + stacked * smoothstep(0.55, 0.95, t)
        },
    );
    s.add(shin.blended(0.04));
    if !tucked {
        hem(s, ankle, knee, cuff);
    }
    // Side seam and a cargo pocket with its flap.
    let out = if side == 0 { -1.0 } else { 1.0 };
    let mid = hip.lerp(knee, 0.62) + Vec3::new(out * 0.075 * g, 0.0, 0.005);
    let frame = Frame::along(mid, hip - knee, Vec3::new(out, 0.0, 0.15));
    s.add(
        Part::block(frame, Vec3::new(0.062, 0.078, 0.018), 0.012)
            .blended(0.012)
            .with_relief(0.003, move |p| 0.0025 * wrinkles(noise, p, 34.0, 0.4)),
    );
    let flap = Frame {
        origin_m: frame.point(Vec3::new(0.0, 0.066, 0.006)),
        ..frame
    };
    s.add(Part::block(flap, Vec3::new(0.066, 0.024, 0.017), 0.007).blended(0.002));
}

/// Cuffs that break over the boots: stacked rings and a hollow below.
fn hem(s: &mut Sculpture, ankle: Vec3, knee: Vec3, cuff: f32) {
    let up = (knee - ankle).normalize();
    for (i, (lift, grow)) in [
        (0.012, 0.004),
        (0.048, 0.0),
        (0.085, 0.003),
        (0.125, -0.003),
    ]
    .iter()
    .enumerate()
    {
        let lean = 0.010 * if i % 2 == 0 { 1.0 } else { -1.0 };
        let at = ankle + up * *lift + Vec3::new(lean * 0.6, 0.0, 0.006 + lean);
        let frame = Frame::along(at, up + Vec3::new(0.35 * lean * 10.0, 0.0, 0.25), Vec3::Z);
        s.add(
            Part::ellipsoid(frame, Vec3::new(cuff + grow, 0.021, cuff + grow + 0.006))
                .blended(0.012),
        );
    }
    s.add(
        Part::ball(ankle - up * 0.045 + Vec3::Z * 0.01, 0.058)
            .carving()
            .blended(0.006),
    );
}
