//! Jacket and shirt: body, shoulders, sleeves, collar, pockets.

use glam::Vec3;

use super::garments::{sleeve, wrinkles};
use super::person::Build;
use super::pose::Pose;
use crate::scene::modelling::math::{bump, lerp, sin, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};

/// Jacket or shirt without sleeves and collar: what straps and belts lie on.
pub(super) fn body(pose: &Pose, build: &Build, noise: Noise) -> Sculpture {
    let mut s = Sculpture::new();
    if build.woman {
        shirt(&mut s, pose, build, noise);
    } else {
        jacket(&mut s, pose, build, noise);
    }
    s
}

/// Jacket or shirt.
pub(super) fn top(pose: &Pose, build: &Build, noise: Noise) -> Sculpture {
    let mut s = body(pose, build, noise);
    for side in 0..2 {
        arm(&mut s, pose, build, noise, side);
    }
    collar(&mut s, pose, build);
    s
}

/// Relief of a body of cloth in front: a placket with buttons, seams, folds from the
/// shoulders to the waist.
fn front(noise: Noise, waist_y: f32) -> impl Fn(Vec3) -> f32 + Send + Sync {
    move |p: Vec3| {
        let ahead = smoothstep(0.0, 0.05, p.z);
        let placket = 0.0030 * smoothstep(0.026, 0.023, p.x.abs()) * ahead;
        let stitch = 0.0018 * bump(0.0195, 0.002, p.x.abs()) * ahead;
        let spacing = p.y / 0.085;
        let off = Vec3::new(p.x, (spacing - spacing.floor() - 0.5) * 0.085, 0.0).length();
        let button = 0.0028 * smoothstep(0.0095, 0.0075, off) * ahead;
        let near_waist = bump(waist_y, 0.16, p.y);
        let folds = wrinkles(noise, p, 18.0, if p.x < 0.0 { 0.8 } else { -0.8 });
        let drape = wrinkles(noise, Vec3::new(p.y * 0.4, p.x * 1.2, p.z), 16.0, 0.3);
        let calm = lerp(1.0, 0.35, smoothstep(0.05, 0.02, p.x.abs()) * ahead);
        (placket - stitch
            + button
            + calm * (0.0065 * near_waist * folds + 0.0022 * folds + 0.003 * drape))
            .clamp(-0.011, 0.011)
    }
}

fn jacket(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise) {
    let hips = (pose.hips[0] + pose.hips[1]) * 0.5;
    let up = pose.neck - pose.waist;
    let chest = Frame::along(pose.chest, up, Vec3::Z);
    s.add(
        Part::ellipsoid(chest, Vec3::new(0.178, 0.205, 0.130))
            .with_relief(0.011, front(noise, -0.22)),
    );
    let belly = Frame::along(pose.waist + Vec3::Y * 0.02, up, Vec3::Z);
    s.add(
        Part::ellipsoid(belly, Vec3::new(0.156, 0.19, 0.120))
            .blended(0.07)
            .with_relief(0.011, front(noise, -0.02)),
    );
    // The skirt below the belt, cut off level and hollow.
    let skirt = Frame::along(hips + Vec3::Y * 0.035, pose.waist - hips, Vec3::Z);
    s.add(
        Part::ellipsoid(skirt, Vec3::new(0.192, 0.19, 0.148))
            .blended(0.035)
            .with_relief(0.011, move |p| {
                let pleats = wrinkles(
                    noise,
                    Vec3::new(p.y * 0.3, p.x + 0.5 * p.z, p.z * 0.4),
                    15.0,
                    0.0,
                );
                let opening = -0.005
                    * smoothstep(0.006, 0.0, (p.x - 0.02).abs())
                    * smoothstep(0.0, 0.05, p.z);
                0.007 * pleats * smoothstep(0.08, -0.08, p.y) + opening
            }),
    );
    let cut = Frame::at(hips - Vec3::Y * 0.19);
    s.add(
        Part::block(cut, Vec3::new(0.4, 0.125, 0.4), 0.0)
            .carving()
            .blended(0.006),
    );
    let hollow = Frame::along(hips - Vec3::Y * 0.075, pose.waist - hips, Vec3::Z);
    s.add(
        Part::ellipsoid(hollow, Vec3::new(0.176, 0.05, 0.134))
            .carving()
            .blended(0.004),
    );
    shoulders(s, pose, build, noise);
    // Chest pockets, then the large ones on the skirt.
    for side in [-1.0, 1.0] {
        pocket(
            s,
            pose.chest + Vec3::new(side * 0.093, 0.035, 0.108),
            Vec3::new(side * 0.30, 0.10, 1.0),
            [0.054, 0.064],
            noise,
        );
        pocket(
            s,
            hips + Vec3::new(side * 0.118, 0.045, 0.105),
            Vec3::new(side * 0.75, 0.08, 1.0),
            [0.062, 0.066],
            noise,
        );
    }
}

fn shirt(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise) {
    let up = pose.neck - pose.waist;
    let chest = Frame::along(pose.chest + Vec3::Y * 0.01, up, Vec3::Z);
    s.add(
        Part::ellipsoid(chest, Vec3::new(0.152, 0.185, 0.108))
            .with_relief(0.011, front(noise, -0.2)),
    );
    for side in [-1.0, 1.0] {
        let bust = Frame::at(pose.chest + Vec3::new(side * 0.060, 0.0, 0.060));
        s.add(Part::ellipsoid(bust, Vec3::new(0.055, 0.057, 0.046)).blended(0.055));
    }
    let belly = Frame::along(pose.waist + Vec3::Y * 0.01, up, Vec3::Z);
    s.add(
        Part::ellipsoid(belly, Vec3::new(0.136, 0.15, 0.102))
            .blended(0.07)
            .with_relief(0.011, front(noise, 0.07)),
    );
    shoulders(s, pose, build, noise);
}

fn shoulders(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise) {
    let g = build.girth;
    for side in 0..2 {
        let shoulder = pose.shoulders[side];
        // Trapezius line from the neck, then the cap of the shoulder.
        let neck = pose.neck + Vec3::new(shoulder.x.signum() * 0.03, -0.022, -0.004);
        s.add(Part::limb((neck, 0.050 * g), (shoulder, 0.050 * g), Vec3::Z).blended(0.05));
        let back = (pose.chest + shoulder) * 0.5 + Vec3::new(0.0, 0.01, -0.045);
        s.add(Part::ball(back, 0.080 * g).blended(0.06));
        let cap = Frame::at(shoulder + Vec3::new(-0.006 * shoulder.x.signum(), -0.018, 0.0));
        s.add(
            Part::ellipsoid(cap, Vec3::new(0.056, 0.062, 0.060) * g)
                .blended(0.045)
                .with_relief(0.005, move |p| 0.003 * wrinkles(noise, p, 28.0, 0.9)),
        );
    }
}

fn pocket(s: &mut Sculpture, at: Vec3, facing: Vec3, half: [f32; 2], noise: Noise) {
    let frame = Frame::along(at, Vec3::Y, facing);
    s.add(
        Part::block(frame, Vec3::new(half[0], half[1], 0.017), 0.010)
            .blended(0.010)
            .with_relief(0.003, move |p| 0.0022 * wrinkles(noise, p, 36.0, 0.5)),
    );
    let flap = Frame {
        origin_m: frame.point(Vec3::new(0.0, half[1] * 0.72, 0.005)),
        ..frame
    };
    s.add(
        Part::block(
            flap,
            Vec3::new(half[0] + 0.004, half[1] * 0.34, 0.0165),
            0.006,
        )
        .blended(0.0015),
    );
    s.add(Part::ball(
        flap.point(Vec3::new(0.0, -half[1] * 0.16, 0.0165)),
        0.0065,
    ));
}

fn arm(s: &mut Sculpture, pose: &Pose, build: &Build, noise: Noise, side: usize) {
    let g = build.girth;
    let (shoulder, elbow, wrist) = (pose.shoulders[side], pose.elbows[side], pose.wrists[side]);
    let upper = sleeve(
        (shoulder - Vec3::Y * 0.008, 0.056 * g),
        (elbow, 0.049 * g),
        noise,
        34.0,
        0.011,
        |t| 0.0025 + 0.003 * smoothstep(0.35, 0.0, t) + 0.007 * smoothstep(0.6, 1.0, t),
    );
    s.add(upper.blended(0.025));
    let rolled = build.woman;
    let end = if rolled {
        elbow.lerp(wrist, 0.42)
    } else {
        wrist
    };
    let lower = sleeve(
        (elbow, 0.053 * g),
        (end, if rolled { 0.047 * g } else { 0.042 * g }),
        noise,
        38.0,
        0.011,
        |t| 0.0022 + 0.0075 * smoothstep(0.4, 0.0, t) + 0.005 * smoothstep(0.6, 0.95, t),
    );
    s.add(lower.blended(0.03));
    cuff(s, elbow, end, rolled, g);
}

/// A buttoned cuff, or a rolled sleeve of three turns; open at the end.
fn cuff(s: &mut Sculpture, elbow: Vec3, end: Vec3, rolled: bool, g: f32) {
    let along = (end - elbow).normalize();
    if rolled {
        for (back, radius) in [(0.0, 0.0545), (0.017, 0.056), (0.034, 0.053)] {
            let frame = Frame::along(
                end - along * back + Vec3::Y * (0.001 * sin(back * 90.0)),
                along,
                Vec3::Z,
            );
            s.add(Part::ellipsoid(frame, Vec3::new(radius * g, 0.0125, radius * g)).blended(0.003));
        }
    } else {
        let start = end - along * 0.052;
        s.add(
            Part::limb(
                (start, 0.0455 * g),
                (end - along * 0.012, 0.0455 * g),
                Vec3::Z,
            )
            .blended(0.003),
        );
        let beyond = Frame::along(end + along * 0.075, along, Vec3::Z);
        s.add(
            Part::block(beyond, Vec3::new(0.09, 0.06, 0.09), 0.0)
                .carving()
                .blended(0.003),
        );
    }
    s.add(
        Part::limb((end, 0.034 * g), (end + along * 0.03, 0.036 * g), Vec3::Z)
            .carving()
            .blended(0.003),
    );
}

fn collar(s: &mut Sculpture, pose: &Pose, build: &Build) {
    let g = build.girth;
    let up = (pose.head.origin_m - pose.neck).normalize();
    let base = pose.neck - up * 0.03;
    let height = if build.woman { 0.030 } else { 0.045 };
    s.add(Part::limb((base, 0.084 * g), (base + up * height, 0.078 * g), Vec3::Z).blended(0.02));
    // Turned-down wings at the front.
    for side in [-1.0, 1.0] {
        let at = base + Vec3::new(side * 0.052 * g, 0.014, 0.080 * g);
        let frame = Frame::along(
            at,
            Vec3::new(side * 0.55, 1.0, -0.35),
            Vec3::new(side * 0.35, 0.35, 1.0),
        );
        s.add(Part::block(frame, Vec3::new(0.030, 0.050, 0.0065), 0.004).blended(0.0015));
    }
    // The neck's opening, wider in front.
    s.add(
        Part::limb((base, 0.060 * g), (base + up * 0.16, 0.080 * g), Vec3::Z)
            .carving()
            .blended(0.006),
    );
    let notch = base + up * 0.06 + Vec3::Z * 0.085 * g;
    s.add(
        Part::limb(
            (notch, 0.050 * g),
            (notch - Vec3::Y * 0.10 + Vec3::Z * 0.035, 0.010),
            Vec3::Z,
        )
        .carving()
        .blended(0.006),
    );
}
