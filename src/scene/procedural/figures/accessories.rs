//! What is worn over the clothes: belts, straps, pouches, a satchel, a waistcoat. They
//! are laid onto the cloth by walking along its distance field.

use std::f32::consts::TAU;

use glam::Vec3;

use super::person::{Build, Layer, Stuff};
use super::pose::Pose;
use crate::scene::modelling::math::{bump, on_circle};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, Noise};

/// Belts and bags, leather and metal.
pub(super) fn over(
    pose: &Pose,
    build: &Build,
    noise: Noise,
    body: &Sculpture,
    trousers: &Sculpture,
) -> Vec<Layer> {
    let mut leather = Sculpture::new();
    let mut metal = Sculpture::new();
    let cloth = |p: Vec3| body.distance_m(p).min(trousers.distance_m(p));
    let hips = (pose.hips[0] + pose.hips[1]) * 0.5;
    let (belt_at, tilt) = if build.woman {
        (hips.lerp(pose.waist, 0.45), 0.06)
    } else {
        (pose.waist - Vec3::Y * 0.035, 0.0)
    };
    if build.woman {
        // First, for its cuts must not reach the belt.
        waistcoat(&mut leather, pose, noise);
    }
    let belt = ring(belt_at, Vec3::new(tilt, 1.0, 0.0), &cloth);
    band(&mut leather, &belt, 0.024, 0.0042);
    buckle(&mut metal, &belt, 0.030);
    for (turn, size) in pouches(build.woman) {
        pouch(&mut leather, &belt, turn, size);
    }
    if !build.woman {
        // From beside the neck to the other hip.
        let across = Vec3::new(1.55, 1.0, 0.0);
        let strap = ring(pose.chest + Vec3::new(0.0, 0.035, 0.0), across, &cloth);
        band(&mut leather, &strap, 0.024, 0.0030);
        let bag = satchel(&mut leather, &mut metal, pose, &cloth);
        hang(&mut leather, &strap, &bag);
    }
    vec![
        Layer::dyed("leather", Stuff::Leather, leather, 0.0054, build.belts),
        Layer::dyed("buckles", Stuff::Metal, metal, 0.0028, 0xb8a06a),
    ]
}

/// Belt pouches: where round the body (turns from the front, to the left) and size (m).
fn pouches(woman: bool) -> Vec<(f32, [f32; 3])> {
    if woman {
        vec![
            (0.17, [0.036, 0.052, 0.020]),
            (-0.24, [0.030, 0.085, 0.022]),
            (0.30, [0.030, 0.040, 0.018]),
        ]
    } else {
        vec![
            (-0.135, [0.034, 0.044, 0.020]),
            (-0.215, [0.034, 0.044, 0.020]),
            (0.14, [0.024, 0.055, 0.016]),
        ]
    }
}

/// Points and normals round the body where a plane through `centre` with normal `axis`
/// meets the cloth; starts in front and turns to the figure's left.
fn ring(centre: Vec3, axis: Vec3, cloth: &dyn Fn(Vec3) -> f32) -> Vec<(Vec3, Vec3)> {
    const STEPS: usize = 72;
    let frame = Frame::along(centre, axis, Vec3::Z);
    let raw: Vec<Vec3> = (0..STEPS)
        .map(|i| {
            let c = on_circle(TAU * i as f32 / STEPS as f32);
            let out = frame.direction(Vec3::new(c.y, 0.0, c.x));
            let mut p = centre + out * 0.42;
            for _ in 0..40 {
                let d = cloth(p);
                if d < 0.0005 {
                    break;
                }
                p -= out * (0.8 * d);
            }
            p
        })
        .collect();
    // A strap spans small folds: smooth the way, then lift it off the cloth.
    let smooth = |i: usize| {
        let at = |k: usize| raw[(i + k + STEPS - 2) % STEPS];
        (at(0) + at(1) * 2.0 + at(2) * 3.0 + at(3) * 2.0 + at(4)) / 9.0
    };
    (0..STEPS)
        .map(|i| {
            let p = smooth(i);
            let along = smooth((i + 1) % STEPS) - smooth((i + STEPS - 1) % STEPS);
            let normal = along.cross(frame.axes.y_axis).normalize_or(Vec3::Z);
            let normal = if normal.dot(p - centre) < 0.0 {
                -normal
            } else {
                normal
            };
            let lift = (0.003 - cloth(p)).max(0.0);
            (p + normal * lift.min(0.012), normal)
        })
        .collect()
}

/// A flat strap along a closed ring.
fn band(leather: &mut Sculpture, ring: &[(Vec3, Vec3)], half_width: f32, half_thick: f32) {
    let n = ring.len();
    for i in 0..n {
        let ((a, normal), (b, _)) = (ring[i], ring[(i + 1) % n]);
        let along = b - a;
        let frame = Frame::along((a + b) * 0.5, along, normal);
        let half = Vec3::new(half_width, 0.56 * along.length(), half_thick);
        leather.add(Part::block(frame, half, 0.0022).blended(0.003));
    }
}

fn at_turn(ring: &[(Vec3, Vec3)], turn: f32) -> (Vec3, Vec3) {
    let n = ring.len() as f32;
    let i = ((turn - turn.floor()) * n) as usize;
    ring[i.min(ring.len() - 1)]
}

/// A rectangular frame with a tongue, at the front.
fn buckle(metal: &mut Sculpture, ring: &[(Vec3, Vec3)], half: f32) {
    let (p, normal) = at_turn(ring, 0.0);
    let frame = Frame::along(p + normal * 0.006, Vec3::Y, normal);
    let bar = |a: [f32; 2], b: [f32; 2]| {
        let at = |q: [f32; 2]| frame.point(Vec3::new(q[0] * half, q[1] * half, 0.0));
        Part::limb((at(a), 0.0036), (at(b), 0.0036), normal)
    };
    let corners = [[-1.1, -0.95], [1.1, -0.95], [1.1, 0.95], [-1.1, 0.95]];
    for i in 0..4 {
        metal.add(bar(corners[i], corners[(i + 1) % 4]));
    }
    metal.add(bar([-1.1, 0.0], [0.9, 0.0]));
}

fn pouch(leather: &mut Sculpture, ring: &[(Vec3, Vec3)], turn: f32, half: [f32; 3]) {
    let (p, normal) = at_turn(ring, turn);
    let out = Vec3::new(normal.x, 0.0, normal.z).normalize_or(Vec3::Z);
    let frame = Frame::along(
        p + out * half[2] - Vec3::Y * (half[1] - 0.022),
        Vec3::Y,
        out,
    );
    leather.add(Part::block(frame, Vec3::from(half), 0.010));
    let lid = Frame {
        origin_m: frame.point(Vec3::new(0.0, half[1] * 0.62, 0.003)),
        ..frame
    };
    leather.add(Part::block(
        lid,
        Vec3::new(half[0] + 0.003, half[1] * 0.42, half[2] + 0.002),
        0.008,
    ));
    leather.add(Part::ball(
        lid.point(Vec3::new(0.0, -half[1] * 0.24, half[2] + 0.002)),
        0.0058,
    ));
}

/// A bag on his left hip, under the strap. Gives its frame, z away from the body.
fn satchel(
    leather: &mut Sculpture,
    metal: &mut Sculpture,
    pose: &Pose,
    cloth: &dyn Fn(Vec3) -> f32,
) -> Frame {
    let out = Vec3::new(0.86, 0.0, 0.50).normalize();
    let mut at = pose.hips[1] + Vec3::new(0.0, -0.02, 0.03) + out * 0.35;
    for _ in 0..40 {
        at -= out * (0.8 * cloth(at)).max(0.0);
    }
    let frame = Frame::along(at + out * 0.040, Vec3::new(0.06, 1.0, 0.0), out);
    leather.add(Part::block(frame, Vec3::new(0.135, 0.105, 0.046), 0.026));
    let lid = Frame {
        origin_m: frame.point(Vec3::new(0.0, 0.035, 0.004)),
        ..frame
    };
    leather.add(Part::block(lid, Vec3::new(0.140, 0.074, 0.0475), 0.018));
    for x in [-0.07, 0.07] {
        let strap = Frame {
            origin_m: frame.point(Vec3::new(x, -0.02, 0.045)),
            ..frame
        };
        leather.add(Part::block(strap, Vec3::new(0.012, 0.072, 0.006), 0.003));
        let clasp = Frame {
            origin_m: frame.point(Vec3::new(x, -0.035, 0.051)),
            ..frame
        };
        metal.add(Part::block(clasp, Vec3::new(0.016, 0.012, 0.004), 0.003));
    }
    frame
}

/// The bag's own straps, from both ends of its top up to the strap round the chest.
fn hang(leather: &mut Sculpture, strap: &[(Vec3, Vec3)], bag: &Frame) {
    for x in [-0.10, 0.10] {
        let end = bag.point(Vec3::new(x, 0.085, 0.0));
        let Some(&(start, normal)) = strap
            .iter()
            .min_by(|a, b| a.0.distance(end).total_cmp(&b.0.distance(end)))
        else {
            return;
        };
        let along = end - start;
        let frame = Frame::along((start + end) * 0.5, along, normal);
        let half = Vec3::new(0.020, 0.5 * along.length() + 0.008, 0.0035);
        leather.add(Part::block(frame, half, 0.0022).blended(0.003));
    }
}

/// A short leather waistcoat, open in front.
fn waistcoat(leather: &mut Sculpture, pose: &Pose, noise: Noise) {
    let up = pose.neck - pose.waist;
    let chest = Frame::along(pose.chest + Vec3::Y * 0.01, up, Vec3::Z);
    leather.add(
        Part::ellipsoid(chest, Vec3::new(0.160, 0.180, 0.124)).with_relief(0.004, move |p| {
            let crease = noise.gradient(Vec3::new(p.x * 12.0, p.y * 26.0, p.z * 12.0));
            // Panels are sewn together under the arms and down from the shoulders.
            let seam = bump(0.088, 0.004, p.x.abs());
            0.0022 * crease - 0.0030 * seam
        }),
    );
    for side in [-1.0, 1.0] {
        let bust = Frame::at(pose.chest + Vec3::new(side * 0.060, -0.004, 0.060));
        leather.add(Part::ellipsoid(bust, Vec3::new(0.064, 0.066, 0.055)).blended(0.06));
    }
    let waist = Frame::along(pose.waist + Vec3::Y * 0.03, up, Vec3::Z);
    leather.add(Part::ellipsoid(waist, Vec3::new(0.147, 0.125, 0.116)).blended(0.05));
    // Cut: below, at the arms and neck, and open down the front.
    let level = Frame::along(pose.waist - up.normalize() * 0.155, up, Vec3::Z);
    leather.add(
        Part::block(level, Vec3::new(0.4, 0.12, 0.4), 0.0)
            .carving()
            .blended(0.006),
    );
    for side in 0..2 {
        let shoulder = pose.shoulders[side];
        let hole = shoulder + Vec3::new(shoulder.x.signum() * 0.03, -0.03, 0.0);
        leather.add(Part::ball(hole, 0.092).carving().blended(0.006));
    }
    leather.add(
        Part::ball(pose.neck + Vec3::new(0.0, 0.0, 0.02), 0.098)
            .carving()
            .blended(0.006),
    );
    let opening = Frame::along(pose.chest + Vec3::new(0.0, -0.05, 0.16), Vec3::Y, Vec3::Z);
    leather.add(
        Part::ellipsoid(opening, Vec3::new(0.040, 0.24, 0.12))
            .carving()
            .blended(0.006),
    );
}
