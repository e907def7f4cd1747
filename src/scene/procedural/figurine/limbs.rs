//! Four legs with clawed feet: three on the ground, one raised.

use glam::Vec3;

use super::body::{Spine, shield};
use crate::scene::modelling::math::on_circle;
use crate::scene::modelling::sculpture::{Part, Sculpture};

struct Leg {
    /// Where on the spine it begins, fraction of the knots.
    spine: f32,
    /// Knee (or elbow), ankle (or wrist) and the middle of the foot, metres.
    knee_m: Vec3,
    ankle_m: Vec3,
    foot_m: Vec3,
    /// Which way the toes point and which way the sole faces.
    toes: Vec3,
    sole: Vec3,
    radius_m: f32,
}

pub(super) fn carve(sculpture: &mut Sculpture, spine: &Spine) {
    for leg in legs() {
        build(sculpture, spine, &leg);
    }
}

/// The hind legs braced, one fore leg on the ground, the other raised under the jaw.
fn legs() -> [Leg; 4] {
    let leg = |spine: f32, joints: [[f32; 3]; 3], toes: [f32; 3], sole: [f32; 3], radius_m| {
        let [knee_m, ankle_m, foot_m] = joints.map(Vec3::from);
        let toes = Vec3::from(toes).normalize();
        let sole = Vec3::from(sole);
        Leg {
            spine,
            knee_m,
            ankle_m,
            foot_m,
            toes,
            sole: (sole - toes * toes.dot(sole)).normalize(),
            radius_m,
        }
    };
    let down = [0.0, -1.0, 0.0];
    [
        leg(
            0.345,
            [
                [-0.072, 0.072, 0.066],
                [-0.118, 0.040, 0.070],
                [-0.106, 0.024, 0.080],
            ],
            [1.0, -0.12, 0.35],
            down,
            0.0150,
        ),
        leg(
            0.335,
            [
                [-0.100, 0.066, -0.070],
                [-0.140, 0.036, -0.072],
                [-0.130, 0.024, -0.080],
            ],
            [1.0, -0.12, -0.35],
            down,
            0.0145,
        ),
        leg(
            0.715,
            [
                [0.060, 0.066, 0.072],
                [0.098, 0.036, 0.088],
                [0.112, 0.024, 0.094],
            ],
            [1.0, -0.12, 0.3],
            down,
            0.0140,
        ),
        leg(
            0.745,
            [
                [0.152, 0.070, 0.006],
                [0.186, 0.112, 0.014],
                [0.196, 0.122, 0.018],
            ],
            [0.80, 0.55, 0.10],
            [0.35, -0.35, 0.87],
            0.0135,
        ),
    ]
}

fn build(sculpture: &mut Sculpture, spine: &Spine, leg: &Leg) {
    let hip = spine.at(leg.spine);
    let r = leg.radius_m;
    let front = hip.ahead;
    // Small scales in rows round thigh and shank.
    let scaled = |part: Part| {
        part.with_relief(0.0014, move |p| {
            let turns = libm::atan2f(p.x, p.z) / std::f32::consts::TAU;
            0.0013 * shield(turns * 12.0, p.y / 0.0062)
        })
    };
    let haunch = hip.at_m.lerp(leg.knee_m, 0.30);
    sculpture.add(
        scaled(Part::limb(
            (haunch, 1.65 * r),
            (leg.knee_m, 0.92 * r),
            front,
        ))
        .blended(0.9 * r),
    );
    sculpture.add(Part::ball(leg.knee_m, 0.98 * r).blended(0.3 * r));
    // A calf that bulges behind the shank.
    let calf = leg.knee_m.lerp(leg.ankle_m, 0.35);
    sculpture
        .add(scaled(Part::limb((leg.knee_m, 0.80 * r), (calf, 0.86 * r), front)).blended(0.4 * r));
    sculpture
        .add(scaled(Part::limb((calf, 0.84 * r), (leg.ankle_m, 0.52 * r), front)).blended(0.3 * r));
    sculpture
        .add(Part::limb((leg.ankle_m, 0.55 * r), (leg.foot_m, 0.55 * r), front).blended(0.4 * r));
    flames(sculpture, leg, spine);
    foot(sculpture, leg);
}

/// Locks of hair like flames behind the joint.
fn flames(sculpture: &mut Sculpture, leg: &Leg, spine: &Spine) {
    let hip = spine.at(leg.spine);
    let r = leg.radius_m;
    let behind = ((leg.knee_m - leg.ankle_m).normalize()
        - (hip.at_m - leg.knee_m).normalize() * 0.3
        - leg.toes * 0.8)
        .normalize();
    let side = behind.cross(leg.knee_m - leg.ankle_m).normalize_or(Vec3::Z);
    for i in 0..5 {
        let fan = (i as f32 - 2.0) * 0.5;
        let mut at = leg.knee_m.lerp(leg.ankle_m, 0.12 * i as f32) + side * (0.25 * r * fan);
        let mut way = (behind + Vec3::Y * (0.25 - 0.2 * i as f32) + side * (0.3 * fan)).normalize();
        let mut radius = 0.36 * r;
        for _ in 0..5 {
            let next = at + way * (0.62 * r);
            let thinner = 0.70 * radius;
            sculpture.add(Part::limb((at, radius), (next, thinner), side).blended(0.12 * r));
            at = next;
            radius = thinner;
            way = (way + Vec3::Y * 0.28).normalize();
        }
    }
}

/// A palm, four toes of two joints with knuckles, each ending in a hooked claw.
fn foot(sculpture: &mut Sculpture, leg: &Leg) {
    let r = leg.radius_m;
    let palm = leg.foot_m + leg.toes * (0.5 * r);
    sculpture.add(Part::limb((leg.foot_m, 0.55 * r), (palm, 0.58 * r), leg.sole).blended(0.5 * r));
    let side = leg.toes.cross(leg.sole);
    for i in 0..5 {
        // The last points backwards: a thumb.
        let (spread, length) = if i == 4 {
            (2.75, 0.7)
        } else {
            ((i as f32 - 1.5) * 0.42, 1.0)
        };
        let c = on_circle(spread);
        let way = (leg.toes * c.x + side * c.y).normalize();
        let knuckle = palm + way * (1.1 * r * length) - leg.sole * (0.22 * r);
        let joint = palm + way * (1.85 * r * length) + leg.sole * (0.02 * r);
        let end = palm + way * (2.4 * r * length) + leg.sole * (0.36 * r);
        let claw = palm + way * (2.95 * r * length) + leg.sole * (1.05 * r);
        sculpture
            .add(Part::limb((palm, 0.36 * r), (knuckle, 0.30 * r), leg.sole).blended(0.25 * r));
        sculpture
            .add(Part::limb((knuckle, 0.33 * r), (joint, 0.25 * r), leg.sole).blended(0.10 * r));
        sculpture.add(Part::limb((joint, 0.27 * r), (end, 0.22 * r), leg.sole).blended(0.08 * r));
        sculpture.add(Part::limb((end, 0.20 * r), (claw, 0.03 * r), leg.sole).blended(0.03 * r));
    }
}
