//! Hands: bare, or in gloves.

use glam::Vec3;

use super::person::{Build, Layer, Stuff};
use super::pose::Pose;
use crate::scene::modelling::Frame;
use crate::scene::modelling::math::{cos, lerp, sin};
use crate::scene::modelling::sculpture::{Part, Sculpture};

pub(super) fn layers(pose: &Pose, build: &Build) -> Vec<Layer> {
    let mut s = Sculpture::new();
    for side in 0..2 {
        hand(&mut s, pose, build, side);
    }
    let (stuff, color) = if build.woman {
        (Stuff::Skin, build.skin)
    } else {
        (Stuff::Leather, 0x4d3a2b)
    };
    vec![Layer::dyed("hands", stuff, s, 0.0033, color)]
}

fn hand(s: &mut Sculpture, pose: &Pose, build: &Build, side: usize) {
    let k = if build.woman { 0.90 } else { 1.05 };
    let (wrist, elbow) = (pose.wrists[side], pose.elbows[side]);
    // y towards the fingers, z out of the palm; the thumb is on `thumb` x.
    let frame = Frame::along(wrist, pose.fingers[side], pose.palms[side]);
    let thumb = if side == 0 { -1.0 } else { 1.0 };
    let at = |x: f32, y: f32, z: f32| frame.point(Vec3::new(thumb * x, y, z) * k);
    // Forearm down to the wrist, flat like a real one.
    let reach = if build.woman { 0.62 } else { 0.15 };
    s.add(Part::limb(
        (
            wrist.lerp(elbow, reach),
            if build.woman { 0.038 } else { 0.030 },
        ),
        (wrist, 0.0265 * k),
        Vec3::Z,
    ));
    let palm = Frame {
        origin_m: at(0.0, 0.052, 0.0),
        ..frame
    };
    s.add(Part::block(palm, Vec3::new(0.039, 0.050, 0.0150) * k, 0.0148 * k).blended(0.018));
    s.add(
        Part::limb(
            (at(0.018, 0.028, 0.008), 0.017 * k),
            (at(0.030, 0.055, 0.010), 0.013 * k),
            Vec3::Z,
        )
        .blended(0.012),
    );
    let grip = pose.grip[side];
    for finger in 0..4 {
        let i = finger as f32;
        let x = 0.0295 - 0.0195 * i;
        let length = [0.92, 1.0, 0.95, 0.76][finger];
        let root = Vec3::new(x, 0.094 - 0.003 * (i - 1.2) * (i - 1.2), 0.0);
        bend(
            s,
            &at,
            root,
            (0.06 - 0.045 * i) * (1.0 - grip),
            length,
            grip + 0.05 * i * (1.0 - grip),
        );
    }
    // Thumb: out to its side, then along.
    let closed = lerp(0.25, 1.0, grip);
    let a = at(0.030, 0.030, 0.006);
    let b = at(0.046 - 0.012 * closed, 0.058, 0.010 + 0.018 * closed);
    let c = at(
        0.050 - 0.026 * closed,
        0.086 - 0.006 * closed,
        0.012 + 0.030 * closed,
    );
    let d = at(
        0.050 - 0.036 * closed,
        0.108 - 0.012 * closed,
        0.014 + 0.034 * closed,
    );
    for (p, q) in [
        ((a, 0.0150), (b, 0.0128)),
        ((b, 0.0125), (c, 0.0108)),
        ((c, 0.0108), (d, 0.0085)),
    ] {
        s.add(Part::limb((p.0, p.1 * k), (q.0, q.1 * k), Vec3::Z).blended(0.006));
    }
}

/// A finger of three bones from `root`, in the hand's plane turned by `spread`, bent
/// towards the palm by `grip`.
fn bend(
    s: &mut Sculpture,
    at: &dyn Fn(f32, f32, f32) -> Vec3,
    root: Vec3,
    spread: f32,
    length: f32,
    grip: f32,
) {
    let mut p = root;
    let mut angle = 0.0;
    let mut radius = 0.0094;
    for (bone, bent) in [(0.044, 1.25), (0.027, 1.6), (0.021, 1.0)] {
        angle += bent * grip + 0.04;
        let step = Vec3::new(
            sin(spread) * cos(angle),
            cos(spread) * cos(angle),
            sin(angle),
        ) * (bone * length);
        let q = p + step;
        let thinner = radius * 0.90;
        s.add(
            Part::limb(
                (at(p.x, p.y, p.z), radius),
                (at(q.x, q.y, q.z), thinner),
                Vec3::Z,
            )
            .blended(0.004),
        );
        p = q;
        radius = thinner;
    }
}
