//! The vaulted walks behind the arches, and the shell of the building round them.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::arcade::{HALF_WALL_M, Storey};
use super::materials::Stuff;
use super::weather::STAIN_STEP_M;
use super::{COURT_DROP_M, HALF_LENGTH_M, HALF_WIDTH_M, Side, WALK_M, walls};
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::{lerp, rotation};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};

/// The walk behind one side.
pub(super) fn build(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    let depth = WALK_M - HALF_WALL_M;
    for bay in 0..side.bays {
        let middle = Vec3::new(
            (bay as f32 + 0.5) * side.bay_m,
            storey.springing_m,
            -HALF_WALL_M - 0.5 * depth,
        );
        let frame = Frame {
            origin_m: side.frame.point(middle),
            axes: side.frame.axes,
        };
        vault(
            &mut stuff.plaster,
            &frame,
            0.5 * side.bay_m,
            0.5 * depth,
            rise_m(storey),
        );
        walls::back_wall(stuff, side, storey, bay);
    }
    for i in 0..=side.bays {
        rib(stuff, side, storey, i as f32 * side.bay_m);
    }
}

fn rise_m(storey: &Storey) -> f32 {
    storey.top_m - storey.springing_m - 0.25
}

/// A groin vault over a rectangle `2 half_x × 2 half_z`, springing at the frame's
/// origin: two crossing half-elliptic barrels, seen from below.
fn vault(plaster: &mut MeshBuilder, frame: &Frame, half_x: f32, half_z: f32, rise: f32) {
    // Four webs; in each the barrel's axis points from the middle to its own side.
    for quarter in 0..4 {
        let turned = quarter % 2 == 1;
        let (along, across) = if turned {
            (half_z, half_x)
        } else {
            (half_x, half_z)
        };
        let web = Frame {
            origin_m: frame.origin_m,
            axes: frame.axes * rotation(Vec3::Y, 0.5 * PI * quarter as f32),
        };
        plaster.sheet_with_normals(12, 6, |s, t| {
            let k = 2.0 * s - 1.0;
            let up = (1.0 - k * k).max(0.0).sqrt();
            // Outwards to inwards, so that the sheet faces down.
            let x = lerp(1.0, k.abs(), t) * along;
            let p = Vec3::new(x, rise * up, k * across);
            let normal = Vec3::new(0.0, -up / rise, -k / across);
            (
                web.point(p),
                web.direction(normal),
                Vec2::new(x, libm::asinf(k) * across),
            )
        });
    }
}

/// The arch across the walk between two bays, from column to wall.
fn rib(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32) {
    let depth = WALK_M - HALF_WALL_M;
    let (half_depth, rise) = (0.5 * depth, rise_m(storey));
    let origin = Vec3::new(x, storey.springing_m, -HALF_WALL_M - half_depth);
    let frame = Frame {
        origin_m: side.frame.point(origin),
        axes: side.frame.axes,
    };
    let outline = [
        (-0.22, 0.0),
        (-0.22, 0.1),
        (-0.15, 0.14),
        (0.15, 0.14),
        (0.22, 0.1),
        (0.22, 0.0),
    ];
    for pair in outline.windows(2) {
        let [(x0, d0), (x1, d1)] = [pair[0], pair[1]];
        stuff.carved.sheet(24, 1, |s, t| {
            let c = crate::scene::modelling::math::on_circle(PI * s);
            let shrink = 1.0 - lerp(d0, d1, t) / half_depth;
            let p = Vec3::new(
                lerp(x0, x1, t),
                c.y * rise * shrink,
                c.x * half_depth * shrink,
            );
            (
                frame.point(p),
                Vec2::new(lerp(x0, x1, t), s * PI * half_depth),
            )
        });
    }
    pilaster(stuff, side, storey, x);
}

/// A flat column on the back wall under each rib.
fn pilaster(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32) {
    let (bottom, top) = (storey.floor_m, storey.springing_m);
    let mut slab = |y0: f32, y1: f32, half: f32, out: f32| {
        let low = Vec3::new(x - half, y0, -WALK_M - 0.05);
        block(
            &mut stuff.carved,
            &side.frame,
            low,
            Vec3::new(x + half, y1, -WALK_M + out),
            0.012,
        );
    };
    slab(bottom, bottom + 0.28, 0.31, 0.2);
    slab(bottom + 0.28, bottom + 0.38, 0.28, 0.17);
    slab(bottom + 0.38, top - 0.4, 0.24, 0.13);
    slab(top - 0.4, top - 0.34, 0.27, 0.16);
    slab(top - 0.34, top - 0.12, 0.25, 0.14);
    slab(top - 0.12, top, 0.33, 0.22);
}

/// Vaults over the four corners of the walks.
pub(super) fn corners(stuff: &mut Stuff, storey: &Storey) {
    let half = 0.5 * (WALK_M - HALF_WALL_M);
    let reach = HALF_WALL_M + half;
    for (sx, sz) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let middle = Vec3::new(
            sx * (HALF_LENGTH_M + reach),
            storey.springing_m,
            sz * (HALF_WIDTH_M + reach),
        );
        vault(
            &mut stuff.plaster,
            &Frame::at(middle),
            half + HALF_WALL_M,
            half + HALF_WALL_M,
            rise_m(storey),
        );
        // The two outer walls of the corner.
        let (x0, x1) = (sx * HALF_LENGTH_M, sx * (HALF_LENGTH_M + WALK_M));
        let (z0, z1) = (sz * HALF_WIDTH_M, sz * (HALF_WIDTH_M + WALK_M));
        let (y0, y1) = (storey.floor_m, storey.top_m + 0.3);
        let mut wall = |a: Vec2, b: Vec2| {
            let corners = [(a, y0), (b, y0), (b, y1), (a, y1)];
            stuff
                .plaster
                .panel(corners.map(|(c, y)| Vec3::new(c.x, y, c.y)), STAIN_STEP_M);
        };
        // Ordered so that each faces the corner's middle.
        let (along_x, along_z) = (
            [Vec2::new(x0, z1), Vec2::new(x1, z1)],
            [Vec2::new(x1, z1), Vec2::new(x1, z0)],
        );
        if sx * sz < 0.0 {
            wall(along_x[0], along_x[1]);
            wall(along_z[0], along_z[1]);
        } else {
            wall(along_x[1], along_x[0]);
            wall(along_z[1], along_z[0]);
        }
    }
}

/// Floors, roofs, parapet and the outside of the walls.
pub(super) fn shell(stuff: &mut Stuff) {
    let (l, w) = (HALF_LENGTH_M, HALF_WIDTH_M);
    let (outer_x, outer_z) = (l + WALK_M, w + WALK_M);
    let level = |builder: &mut MeshBuilder, y: f32, x: [f32; 2], z: [f32; 2], up: bool| {
        let p = |x: f32, z: f32| Vec3::new(x, y, z);
        let corners = [p(x[0], z[1]), p(x[1], z[1]), p(x[1], z[0]), p(x[0], z[0])];
        if up {
            builder.quad(corners);
        } else {
            let [a, b, c, d] = corners;
            builder.quad([d, c, b, a]);
        }
    };
    // Under the slabs of court and walks is only their bed, seen in the joints.
    let bed = 0.03;
    stuff.floor.tint(Vec3::splat(0.25));
    level(
        &mut stuff.floor,
        -COURT_DROP_M - bed,
        [-l, l],
        [-w, w],
        true,
    );
    for (y, inset) in [(-bed, 0.45), (6.7, -0.1), (13.37, HALF_WALL_M)] {
        let (ix, iz) = (l - inset, w - inset);
        let target = if y > 10.0 {
            &mut stuff.terracotta
        } else {
            &mut stuff.floor
        };
        level(target, y, [-outer_x, outer_x], [iz, outer_z], true);
        level(target, y, [-outer_x, outer_x], [-outer_z, -iz], true);
        level(target, y, [ix, outer_x], [-iz, iz], true);
        level(target, y, [-outer_x, -ix], [-iz, iz], true);
    }
    stuff.floor.tint(Vec3::ONE);
    parapet(stuff);
    // The outside, so that no light comes through the walls.
    for (a, b) in [
        ([-outer_x, -outer_z], [-outer_x, outer_z]),
        ([-outer_x, outer_z], [outer_x, outer_z]),
        ([outer_x, outer_z], [outer_x, -outer_z]),
        ([outer_x, -outer_z], [-outer_x, -outer_z]),
    ] {
        let p = |c: [f32; 2], y: f32| Vec3::new(c[0] * 1.02, y, c[1] * 1.02);
        stuff
            .brick
            .quad([p(a, -0.3), p(b, -0.3), p(b, 13.4), p(a, 13.4)]);
    }
}

/// A low brick wall above the cornice, with a stone coping.
fn parapet(stuff: &mut Stuff) {
    let (x, z) = (
        HALF_LENGTH_M - HALF_WALL_M + 0.25,
        HALF_WIDTH_M - HALF_WALL_M + 0.25,
    );
    // Clockwise from above, so that the outside of the run is the court.
    let path = [[-x, -z], [x, -z], [x, z], [-x, z]].map(|[x, z]| Vec3::new(x, 0.0, z));
    let wall = Pen::at(0.0, 13.2).by(0.0, 0.95).profile();
    wall.run(&mut stuff.brick, &path, true);
    let coping = Pen::at(0.0, 14.1)
        .by(0.08, 0.0)
        .by(0.0, 0.08)
        .ovolo(0.02, 0.04)
        .by(-0.5, 0.1)
        .profile();
    coping.run(&mut stuff.carved, &path, true);
}
