//! Four legs with clawed feet: the hind ones braced, the fore ones raised.

use glam::Vec3;

use super::body::Spine;
use crate::scene::modelling::math::{on_circle, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};

struct Leg {
    /// Where on the spine it begins, fraction of the knots.
    spine: f32,
    /// Knee (or elbow) and foot, metres.
    knee_m: Vec3,
    foot_m: Vec3,
    /// Which way the toes point and which way the sole faces.
    toes: Vec3,
    sole: Vec3,
    radius_m: f32,
}

pub(super) fn carve(sculpture: &mut Sculpture, spine: &Spine) {
    for leg in legs(spine) {
        build(sculpture, spine, &leg);
    }
}

/// Legs grow sideways out of the body towards the outside of the coil.
fn legs(spine: &Spine) -> Vec<Leg> {
    let outwards = |t: f32, reach: f32, drop: f32, ahead: f32| {
        let knot = spine.at(t);
        let out = Vec3::new(knot.at_m.x, 0.0, knot.at_m.z).normalize_or(Vec3::X);
        knot.at_m + out * reach - Vec3::Y * drop + knot.ahead * ahead
    };
    let leg = |t: f32, knee: [f32; 3], foot: [f32; 3], radius_m: f32| {
        let knot = spine.at(t);
        let out = Vec3::new(knot.at_m.x, 0.0, knot.at_m.z).normalize_or(Vec3::X);
        Leg {
            spine: t,
            knee_m: outwards(t, knee[0], knee[1], knee[2]),
            foot_m: outwards(t, foot[0], foot[1], foot[2]),
            toes: (out * 0.75 + knot.ahead * 0.55 - Vec3::Y * 0.25).normalize(),
            sole: (-Vec3::Y - out * 0.2).normalize(),
            radius_m,
        }
    };
    vec![
        leg(0.50, [0.046, -0.014, -0.020], [0.058, 0.030, 0.014], 0.0125),
        leg(
            0.565,
            [0.050, -0.012, -0.024],
            [0.060, 0.036, 0.006],
            0.0120,
        ),
        leg(
            0.745,
            [0.050, -0.004, -0.022],
            [0.066, 0.022, 0.016],
            0.0110,
        ),
        leg(0.80, [0.048, 0.018, -0.010], [0.072, -0.008, 0.028], 0.0105),
    ]
}

fn build(sculpture: &mut Sculpture, spine: &Spine, leg: &Leg) {
    let hip = spine.at(leg.spine);
    let r = leg.radius_m;
    let front = hip.ahead;
    // Haunch, shank, with scales like rings.
    let haunch = hip.at_m.lerp(leg.knee_m, 0.25);
    let scaled = |part: Part, size: f32| {
        part.with_relief(0.0011, move |p| {
            let ring = p.y / 0.0042 + 0.5 * ((p.x * 700.0).floor() % 2.0).abs();
            let f = ring - ring.floor();
            0.0010 * smoothstep(0.0, 0.25, f) * (1.0 - 0.7 * f) * smoothstep(0.0, 0.004, size)
        })
    };
    sculpture.add(
        scaled(
            Part::limb((haunch, 1.45 * r), (leg.knee_m, 0.82 * r), front),
            r,
        )
        .blended(0.9 * r),
    );
    sculpture.add(
        scaled(
            Part::limb((leg.knee_m, 0.80 * r), (leg.foot_m, 0.50 * r), front),
            r,
        )
        .blended(0.35 * r),
    );
    // A tuft of hair at the elbow.
    for i in 0..4 {
        let fan = (i as f32 - 1.5) * 0.3;
        let way =
            ((leg.knee_m - leg.foot_m).normalize() + hip.ahead * (-0.8 + fan) + hip.back * fan)
                .normalize();
        let end = leg.knee_m + way * (2.2 - fan.abs()) * r;
        sculpture.add(Part::limb((leg.knee_m, 0.34 * r), (end, 0.04 * r), front).blended(0.25 * r));
    }
    foot(sculpture, leg);
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
        let knuckle = palm + way * (0.95 * r * length) - leg.sole * (0.22 * r);
        let joint = palm + way * (1.6 * r * length) + leg.sole * (0.02 * r);
        let end = palm + way * (2.05 * r * length) + leg.sole * (0.36 * r);
        let claw = palm + way * (2.5 * r * length) + leg.sole * (1.05 * r);
        sculpture
            .add(Part::limb((palm, 0.36 * r), (knuckle, 0.30 * r), leg.sole).blended(0.25 * r));
        sculpture
            .add(Part::limb((knuckle, 0.33 * r), (joint, 0.25 * r), leg.sole).blended(0.10 * r));
        sculpture.add(Part::limb((joint, 0.27 * r), (end, 0.22 * r), leg.sole).blended(0.08 * r));
        sculpture.add(Part::limb((end, 0.20 * r), (claw, 0.03 * r), leg.sole).blended(0.03 * r));
    }
}
