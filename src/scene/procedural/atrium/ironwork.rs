//! Iron: the ties that hold the arches together, and lanterns on chains below their
//! crowns.

use std::f32::consts::TAU;

use glam::Vec3;

use super::Side;
use super::arcade::Storey;
use super::materials::Stuff;
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::on_circle;
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};

/// Ties and lanterns of one storey of a side.
pub(super) fn build(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    let iron = &mut stuff.iron;
    for bay in 0..side.bays {
        let x = bay as f32 * side.bay_m;
        let start = side
            .frame
            .point(Vec3::new(x, storey.springing_m + 0.06, 0.0));
        let along = Frame::along(start, side.frame.axes.x_axis, Vec3::Y);
        Pen::at(0.019, storey.half_pier_m - 0.1)
            .to(0.019, side.bay_m - storey.half_pier_m + 0.1)
            .profile()
            .lathe(iron, &along, 8);
        if !storey.upper && bay % 2 == 0 {
            let crown = storey.springing_m + storey.radius_m(side.bay_m);
            let at = Vec3::new(x + 0.5 * side.bay_m, crown, 0.0);
            lantern(
                iron,
                &Frame {
                    origin_m: side.frame.point(at),
                    axes: side.frame.axes,
                },
            );
        }
    }
}

/// A six-sided lantern; the frame's origin is where its chain is fixed.
fn lantern(iron: &mut MeshBuilder, frame: &Frame) {
    const CHAIN_M: f32 = 1.35;
    const LINK_M: f32 = 0.075;
    for i in 0..(CHAIN_M / LINK_M) as u32 {
        // Links stand across each other by turns.
        let turn = if i % 2 == 0 { 0.0 } else { 0.25 * TAU };
        let link = frame.then(&Frame::turned(Vec3::Y * (-LINK_M * (i as f32 + 0.5)), turn));
        iron.sheet(4, 8, |s, t| {
            let (ring, c) = (on_circle(-t * TAU), on_circle(s * TAU) * 0.007);
            let p = Vec3::new(ring.x * (0.024 + c.x), ring.y * (0.046 + c.x), c.y);
            (link.point(p), on_circle(t))
        });
    }
    let body = frame.then(&Frame::at(Vec3::Y * -(CHAIN_M + 0.62)));
    // Foot, floor and roof.
    Pen::at(0.0, -0.10)
        .to(0.02, -0.07)
        .bulge(0.04, 0.02)
        .to(0.15, 0.0)
        .to(0.15, 0.03)
        .to(0.13, 0.04)
        .to(0.0, 0.04)
        .profile()
        .lathe(iron, &body, 6);
    Pen::at(0.0, 0.44)
        .to(0.17, 0.44)
        .to(0.19, 0.46)
        .to(0.10, 0.55)
        .to(0.045, 0.575)
        .bulge(0.05, 0.03)
        .to(0.0, 0.64)
        .profile()
        .lathe(iron, &body, 6);
    for i in 0..6 {
        let c = on_circle(TAU * i as f32 / 6.0) * 0.145;
        let post = body.then(&Frame::at(Vec3::new(c.x, 0.03, -c.y)));
        block(
            iron,
            &post,
            Vec3::new(-0.009, 0.0, -0.009),
            Vec3::new(0.009, 0.42, 0.009),
            0.002,
        );
    }
    // The candle.
    Pen::at(0.028, 0.04)
        .to(0.028, 0.24)
        .to(0.0, 0.25)
        .profile()
        .lathe(iron, &body, 10);
}
