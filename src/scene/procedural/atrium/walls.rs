//! The back walls of the walks: wainscot, painted plaster, doors and shuttered windows.

use glam::Vec3;

use super::arcade::Storey;
use super::materials::Stuff;
use super::weather::STAIN_STEP_M;
use super::{Side, WALK_M};
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::rotation;
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};

/// Back wall of one bay: a wainscot of ashlar, plaster above, every other bay a door.
pub(super) fn back_wall(stuff: &mut Stuff, side: &Side, storey: &Storey, bay: u32) {
    let (x0, x1) = (bay as f32 * side.bay_m, (bay + 1) as f32 * side.bay_m);
    let z = -WALK_M;
    let dado = storey.floor_m + 1.1;
    let wall = |builder: &mut MeshBuilder, y0: f32, y1: f32, z: f32| {
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        builder.panel(
            corners.map(|[x, y]| side.frame.point(Vec3::new(x, y, z))),
            STAIN_STEP_M,
        );
    };
    wall(&mut stuff.ashlar, storey.floor_m, dado, z + 0.05);
    wall(&mut stuff.plaster, dado, storey.top_m + 0.3, z);
    painted_bands(stuff, side, storey, [x0, x1]);
    let rail = Pen::at(0.0, dado - 0.08)
        .by(0.02, 0.0)
        .bulge(0.06, 0.025)
        .by(0.02, 0.01)
        .by(0.0, 0.04)
        .to(-0.06, dado + 0.05)
        .profile();
    let ends = [x0, x1].map(|x| side.frame.point(Vec3::new(x, 0.0, z + 0.05)));
    rail.run(&mut stuff.carved, &ends, false);
    if (bay + u32::from(storey.upper)).is_multiple_of(2) {
        door(stuff, side, storey, 0.5 * (x0 + x1));
    } else {
        window(stuff, side, storey, 0.5 * (x0 + x1));
    }
}

/// Fields and lines painted on the plaster: red above the wainscot, a frieze under the
/// vault. Each lies a few millimetres before the wall.
fn painted_bands(stuff: &mut Stuff, side: &Side, storey: &Storey, [x0, x1]: [f32; 2]) {
    let (foot, top) = (storey.floor_m + 1.15, storey.springing_m);
    let (red, ochre, green) = (
        Vec3::new(0.50, 0.25, 0.19),
        Vec3::new(0.80, 0.58, 0.33),
        Vec3::new(0.42, 0.50, 0.42),
    );
    for (low, high, tint) in [
        (foot, foot + 1.05, red),
        (foot + 1.09, foot + 1.13, ochre),
        (top - 0.52, top - 0.47, ochre),
        (top - 0.43, top - 0.14, green),
        (top - 0.10, top - 0.05, ochre),
    ] {
        stuff.plaster.tint(tint);
        let corners = [[x0, low], [x1, low], [x1, high], [x0, high]];
        stuff.plaster.panel(
            corners.map(|[x, y]| side.frame.point(Vec3::new(x, y, 0.004 - WALK_M))),
            STAIN_STEP_M,
        );
    }
    stuff.plaster.tint(Vec3::ONE);
}

/// A panelled double door in a stone frame.
fn door(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32) {
    let (y, z) = (storey.floor_m, -WALK_M);
    let (half, height) = (0.75, 2.6);
    let frame = &side.frame;
    let mut stone = |x0: f32, y0: f32, x1: f32, y1: f32, out: f32| {
        let low = Vec3::new(x + x0, y + y0, z - 0.1);
        block(
            &mut stuff.carved,
            frame,
            low,
            Vec3::new(x + x1, y + y1, z + out),
            0.015,
        );
    };
    stone(-half - 0.24, 0.0, -half, height, 0.16);
    stone(half, 0.0, half + 0.24, height, 0.16);
    stone(-half - 0.24, height, half + 0.24, height + 0.26, 0.16);
    stone(
        -half - 0.36,
        height + 0.26,
        half + 0.36,
        height + 0.36,
        0.28,
    );
    for leaf in [-1.0, 1.0] {
        let (a, b) = if leaf < 0.0 {
            (-half, -0.008)
        } else {
            (0.008, half)
        };
        let mut board = |x0: f32, y0: f32, x1: f32, y1: f32, out: f32| {
            let low = Vec3::new(x + x0, y + y0, z);
            block(
                &mut stuff.wood,
                frame,
                low,
                Vec3::new(x + x1, y + y1, z + out),
                0.012,
            );
        };
        board(a, 0.0, b, height, 0.07);
        for (low, high) in [(0.12, 0.75), (0.87, 1.6), (1.72, height - 0.12)] {
            board(a + 0.1, low, b - 0.1, high, 0.1);
            board(a + 0.16, low + 0.06, b - 0.16, high - 0.06, 0.115);
        }
        let ring = frame.point(Vec3::new(x + leaf * 0.09, y + 1.2, z + 0.11));
        Pen::at(0.0, 0.0)
            .to(0.045, 0.0)
            .ovolo(-0.045, 0.03)
            .profile()
            .lathe(
                &mut stuff.metal,
                &Frame::along(ring, frame.axes.z_axis, Vec3::Y),
                16,
            );
    }
}

/// A blind window: moulded frame, sill on brackets, shutters.
fn window(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32) {
    let (y, z) = (storey.floor_m + 1.5, -WALK_M);
    let (half, height) = (0.5, 1.5);
    let frame = &side.frame;
    let mut stone = |x0: f32, y0: f32, x1: f32, y1: f32, out: f32| {
        let low = Vec3::new(x + x0, y + y0, z - 0.1);
        block(
            &mut stuff.carved,
            frame,
            low,
            Vec3::new(x + x1, y + y1, z + out),
            0.012,
        );
    };
    stone(-half - 0.18, 0.0, -half, height, 0.12);
    stone(half, 0.0, half + 0.18, height, 0.12);
    stone(-half - 0.18, height, half + 0.18, height + 0.2, 0.12);
    stone(-half - 0.26, height + 0.2, half + 0.26, height + 0.29, 0.22);
    stone(-half - 0.28, -0.12, half + 0.28, 0.0, 0.24);
    stone(-half - 0.12, -0.34, -half + 0.04, -0.12, 0.16);
    stone(half - 0.04, -0.34, half + 0.12, -0.12, 0.16);
    for slat in 0..15 {
        let y0 = y + 0.05 + slat as f32 * 0.095;
        for (a, b) in [(-half, -0.01), (0.01, half)] {
            let turn = Frame {
                origin_m: frame.point(Vec3::new(x, y0, z + 0.03)),
                axes: frame.axes * rotation(Vec3::X, 0.5),
            };
            let low = Vec3::new(a + 0.06, 0.0, 0.0);
            block(
                &mut stuff.wood,
                &turn,
                low,
                Vec3::new(b - 0.06, 0.09, 0.014),
                0.004,
            );
        }
    }
    let mut stile = |a: f32, b: f32| {
        let low = Vec3::new(x + a, y, z);
        block(
            &mut stuff.wood,
            frame,
            low,
            Vec3::new(x + b, y + height, z + 0.075),
            0.008,
        );
    };
    for (a, b) in [
        (-half, -half + 0.06),
        (-0.07, -0.01),
        (0.01, 0.07),
        (half - 0.06, half),
    ] {
        stile(a, b);
    }
    block(
        &mut stuff.wood,
        frame,
        Vec3::new(x - half, y, z - 0.02),
        Vec3::new(x + half, y + height, z + 0.01),
        0.002,
    );
}
