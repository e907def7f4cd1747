//! Things that stand about: urns with plants, and the well-head in the court.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::materials::Stuff;
use super::{COURT_DROP_M, Side};
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::{cos, lerp, on_circle, sin};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};
use crate::seed;

/// Urns in front of the long sides' columns.
pub(super) fn build(stuff: &mut Stuff, side: &Side, seed: u64) {
    if side.bays < 4 {
        return;
    }
    let number = u64::from(side.frame.origin_m.z > 0.0);
    for i in 1..side.bays {
        let x = i as f32 * side.bay_m;
        let foot = side.frame.point(Vec3::new(x, -COURT_DROP_M, 1.25));
        let mut random = seed::generator(seed, "atrium plant", number * 100 + u64::from(i));
        // None at the viewer's elbow.
        let beside_camera = (number == 1 && i == 5) || (number == 0 && i == 1);
        if i % 2 == 1 && !beside_camera {
            urn(stuff, foot, &mut random);
        }
    }
}

fn urn(stuff: &mut Stuff, foot: Vec3, random: &mut rand_chacha::ChaCha20Rng) {
    let frame = Frame::turned(foot, TAU * seed::unit_f32(random));
    block(
        &mut stuff.carved,
        &Frame::at(foot),
        Vec3::new(-0.3, 0.0, -0.3),
        Vec3::new(0.3, 0.22, 0.3),
        0.015,
    );
    Pen::at(0.22, 0.22)
        .torus(0.05)
        .to(0.15, 0.3)
        .to(0.13, 0.34)
        .to(0.24, 0.45)
        .to(0.34, 0.6)
        .to(0.385, 0.75)
        .to(0.38, 0.85)
        .to(0.35, 0.93)
        .to(0.34, 0.95)
        .to(0.36, 0.955)
        .bulge(0.08, 0.05)
        .to(0.34, 1.035)
        .to(0.31, 1.02)
        .to(0.3, 0.95)
        .profile()
        .lathe(&mut stuff.terracotta, &frame, 48);
    Pen::at(0.32, 0.95)
        .to(0.0, 0.97)
        .profile()
        .lathe(&mut stuff.wood, &frame, 24);
    let bush = bush(random);
    stuff.leaves.place(&bush, &Frame::at(foot + Vec3::Y * 0.95));
}

/// Arching blades from one root, and rounder leaves between them.
fn bush(random: &mut rand_chacha::ChaCha20Rng) -> MeshBuilder {
    let mut leaves = MeshBuilder::new();
    for i in 0..70 {
        let mut draw = |low: f32, high: f32| lerp(low, high, seed::unit_f32(random));
        let angle = TAU * (i as f32 * 0.618_034).fract() + draw(-0.2, 0.2);
        let length = draw(0.45, 1.0);
        let steep = draw(0.25, 1.3);
        let width = draw(0.022, 0.04);
        let (root, twist) = (draw(0.02, 0.16), draw(-0.4, 0.4));
        leaves.tint(Stuff::leaf_color(draw(0.0, 1.0), draw(0.0, 0.6)));
        let out = on_circle(angle);
        let (out, side) = (Vec3::new(out.x, 0.0, out.y), Vec3::new(-out.y, 0.0, out.x));
        leaves.sheet(2, 9, |s, t| {
            let bend = steep + 1.7 * t * t;
            let reach = length * t;
            let spine =
                out * (root + reach * sin(bend) * 0.8) + Vec3::Y * (reach * cos(0.62 * bend));
            let half = width * (4.0 * t * (1.0 - t) + 0.15 * (1.0 - t)) * 1.2;
            let across = 2.0 * s - 1.0;
            let fold = Vec3::Y * (across.abs() * half * 0.5);
            let turn = side * cos(twist) + Vec3::Y * sin(twist);
            (spine + turn * (across * half) + fold, Vec2::new(s, t))
        });
    }
    leaves
}

/// An eight-sided well-head on two steps, with an iron overthrow.
pub(super) fn well(stuff: &mut Stuff) {
    let foot = Vec3::new(-3.0, -COURT_DROP_M, 0.0);
    let frame = Frame::turned(foot, TAU / 16.0);
    let stone = &mut stuff.carved;
    Pen::at(1.35, 0.0)
        .to(1.35, 0.16)
        .to(1.33, 0.18)
        .to(1.05, 0.18)
        .to(1.05, 0.34)
        .to(1.03, 0.36)
        .to(0.6, 0.36)
        .profile()
        .lathe(stone, &frame, 8);
    Pen::at(0.72, 0.36)
        .to(0.74, 0.42)
        .bulge(0.1, 0.05)
        .to(0.66, 0.54)
        .to(0.62, 0.6)
        .to(0.66, 0.95)
        .to(0.7, 1.02)
        .bulge(0.08, 0.04)
        .to(0.78, 1.12)
        .to(0.8, 1.14)
        .to(0.8, 1.2)
        .to(0.78, 1.22)
        .to(0.56, 1.22)
        .to(0.54, 1.2)
        .to(0.54, 0.5)
        .to(0.0, 0.5)
        .profile()
        .lathe(stone, &frame, 48);
    // Garlands round the drum.
    for i in 0..8 {
        let start = TAU * i as f32 / 8.0;
        stone.sheet(8, 16, |s, t| {
            let angle = start + TAU / 8.0 * t;
            let sag = 0.93 - 0.16 * sin(t * TAU * 0.5);
            let thick = 0.022 + 0.022 * sin(t * TAU * 0.5) + 0.005 * sin(t * 60.0);
            let c = on_circle(s * TAU) * thick;
            let around = on_circle(angle) * (0.665 + c.x);
            (
                frame.point(Vec3::new(around.x, sag + c.y, around.y)),
                Vec2::new(s * 0.2, t * 0.5),
            )
        });
    }
    overthrow(stuff, foot);
}

fn overthrow(stuff: &mut Stuff, foot: Vec3) {
    let frame = Frame::at(foot + Vec3::Y * 1.2);
    stuff.metal.sheet(10, 48, |s, t| {
        let arc = on_circle(t * TAU * 0.5);
        let c = on_circle(s * TAU) * 0.025;
        let lift = 1.25 * libm::powf(arc.y.max(0.0), 0.45);
        (
            frame.point(Vec3::new(c.y, lift, arc.x * 0.67 + c.x * arc.x) + Vec3::Y * (c.x * arc.y)),
            Vec2::new(s, t),
        )
    });
    let wheel = Frame::along(frame.point(Vec3::Y * 1.05), Vec3::X, Vec3::Y);
    Pen::at(0.02, -0.03)
        .to(0.12, -0.03)
        .bulge(0.06, -0.02)
        .to(0.02, 0.03)
        .profile()
        .lathe(&mut stuff.metal, &wheel, 24);
}
