//! One storey of one side: arches on columns, the wall over them, balustrade, cornice.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::materials::Stuff;
use super::orders::{Column, baluster};
use super::weather::STAIN_STEP_M;
use super::{COURT_DROP_M, HALF_LENGTH_M, HALF_WIDTH_M, Side, mouldings};
use crate::scene::modelling::blocks::{block, hexahedron};
use crate::scene::modelling::math::{lerp, on_circle};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};

/// Half the thickness of the arcade's wall, metres.
pub(super) const HALF_WALL_M: f32 = 0.35;

/// Heights of a storey above the walk of the lower one, and its parts, metres.
#[derive(Clone, Copy)]
pub(super) struct Storey {
    pub floor_m: f32,
    /// Where the columns stand: on the floor, or on pedestals.
    pub column_foot_m: f32,
    pub column: Column,
    /// Where the arches begin.
    pub springing_m: f32,
    /// Half the width of the wall left between two arches.
    pub half_pier_m: f32,
    /// Top of the wall.
    pub top_m: f32,
    pub upper: bool,
}

impl Storey {
    /// The ground floor.
    pub fn lower() -> Self {
        let column = Column {
            height_m: 4.0,
            radius_m: 0.31,
            fluted: false,
        };
        Self {
            floor_m: 0.0,
            column_foot_m: 0.0,
            column,
            springing_m: 4.22,
            half_pier_m: 0.4,
            top_m: 6.35,
            upper: false,
        }
    }

    /// The gallery above.
    pub fn upper() -> Self {
        let column = Column {
            height_m: 2.75,
            radius_m: 0.225,
            fluted: true,
        };
        Self {
            floor_m: 6.7,
            column_foot_m: 7.75,
            column,
            springing_m: 10.65,
            half_pier_m: 0.33,
            top_m: 12.75,
            upper: true,
        }
    }

    /// Radius of the arches of a bay, metres.
    pub fn radius_m(&self, bay_m: f32) -> f32 {
        0.5 * bay_m - self.half_pier_m
    }
}

/// Builds one storey of a side.
pub(super) fn build(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    let column = storey.column.build();
    for i in 0..=side.bays {
        let x = i as f32 * side.bay_m;
        let foot = Frame::at(side.frame.point(Vec3::new(x, storey.column_foot_m, 0.0)));
        if i > 0 && i < side.bays {
            stuff.carved.place(&column, &foot);
            impost(stuff, &side.frame, x, storey);
            if storey.upper {
                pedestal(stuff, &side.frame, x, storey);
            }
        }
        if i < side.bays {
            bay(stuff, side, storey, x);
        }
    }
    if storey.upper {
        balustrade(stuff, side, storey);
        mouldings::cornice(stuff, side, storey);
    } else {
        steps(stuff, side);
        mouldings::string_course(stuff, side, storey);
    }
}

/// The block between capital and arch.
fn impost(stuff: &mut Stuff, frame: &Frame, x: f32, storey: &Storey) {
    let half = storey.half_pier_m;
    let bottom = storey.column_foot_m + storey.column.height_m;
    let y = storey.springing_m;
    let low = Vec3::new(x - half, bottom, -HALF_WALL_M);
    block(
        &mut stuff.carved,
        frame,
        low,
        Vec3::new(x + half, y - 0.07, HALF_WALL_M),
        0.01,
    );
    let over = Vec3::new(half + 0.05, 0.0, HALF_WALL_M + 0.05);
    let (low, high) = (
        Vec3::new(x, y - 0.07, 0.0) - over,
        Vec3::new(x, y, 0.0) + over,
    );
    block(&mut stuff.carved, frame, low, high, 0.015);
}

fn pedestal(stuff: &mut Stuff, frame: &Frame, x: f32, storey: &Storey) {
    let (low, high) = (storey.floor_m, storey.column_foot_m);
    let mut slab = |y0: f32, y1: f32, half: f32| {
        let low = Vec3::new(x - half, y0, -half);
        block(
            &mut stuff.carved,
            frame,
            low,
            Vec3::new(x + half, y1, half),
            0.012,
        );
    };
    slab(low, low + 0.16, 0.4);
    slab(low + 0.16, high - 0.12, 0.34);
    slab(high - 0.12, high, 0.4);
}

/// The wall round one arch: faces to both sides, soffit, voussoirs.
fn bay(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32) {
    const STEPS: u32 = 32;
    let radius = storey.radius_m(side.bay_m);
    let centre = Vec3::new(x + 0.5 * side.bay_m, storey.springing_m, 0.0);
    let frame = side.frame;
    let wall = if storey.upper {
        &mut stuff.brick
    } else {
        &mut stuff.ashlar
    };
    let top = storey.top_m - storey.springing_m;
    // Each face is a fan of strips from the arch to the bay's border.
    let border = |angle: f32| {
        let c = on_circle(angle);
        let half = 0.5 * side.bay_m;
        let reach = (half / c.x.abs().max(1e-6)).min(top / c.y.max(1e-6));
        c * reach
    };
    let corner_angle = libm::atan2f(top, 0.5 * side.bay_m);
    let mut angles: Vec<f32> = (0..=STEPS).map(|i| PI * i as f32 / STEPS as f32).collect();
    angles.extend([corner_angle, PI - corner_angle]);
    angles.sort_by(f32::total_cmp);
    for pair in angles.windows(2) {
        let at = |p: Vec2, z: f32| frame.point(centre + p.extend(z));
        let inner = [pair[0], pair[1]].map(|a| on_circle(a) * radius);
        let outer = [pair[0], pair[1]].map(border);
        for (z, [a, b]) in [(HALF_WALL_M, [1, 0]), (-HALF_WALL_M, [0, 1])] {
            let corners = [inner[a], inner[b], outer[b], outer[a]];
            wall.panel(corners.map(|p| at(p, z)), STAIN_STEP_M);
        }
    }
    wall.sheet(STEPS, 1, |s, t| {
        let p = on_circle(PI * (1.0 - s)) * radius;
        let z = lerp(-HALF_WALL_M, HALF_WALL_M, t);
        (
            frame.point(centre + p.extend(z)),
            Vec2::new(PI * s * radius, z),
        )
    });
    let place = Frame {
        origin_m: frame.point(centre),
        axes: frame.axes,
    };
    let behind = Frame {
        axes: frame.axes * crate::scene::modelling::math::rotation(Vec3::Y, PI),
        ..place
    };
    if storey.upper {
        archivolt(&mut stuff.carved, &place, radius);
    } else {
        voussoirs(&mut stuff.carved, &place, radius);
    }
    archivolt(&mut stuff.carved, &behind, radius);
    roundels(stuff, &place, side.bay_m, storey);
}

/// The ring of wedge stones round an arch, with a tall keystone.
fn voussoirs(stone: &mut MeshBuilder, frame: &Frame, radius: f32) {
    const STONES: u32 = 17;
    for i in 0..STONES {
        let key = i == STONES / 2;
        let turn = |k: f32| PI * (i as f32 + k) / STONES as f32;
        let (a, b) = (on_circle(turn(0.012)), on_circle(turn(0.988)));
        let outer = radius
            + if key {
                0.56
            } else if i % 2 == 0 {
                0.42
            } else {
                0.36
            };
        let front = HALF_WALL_M + if key { 0.14 } else { 0.06 };
        let inner = radius - if key { 0.05 } else { 0.012 };
        let at = |c: Vec2, r: f32, z: f32| frame.point((c * r).extend(z));
        let back = 0.0;
        // x: from b to a (leftwards is larger angle), y: outwards, z: to the front.
        let corners = [
            at(b, inner, back),
            at(a, inner, back),
            at(b, outer, back),
            at(a, outer, back),
            at(b, inner, front),
            at(a, inner, front),
            at(b, outer, front),
            at(a, outer, front),
        ];
        let tone = if key || i % 2 == 1 {
            Vec3::new(1.12, 1.10, 1.06)
        } else {
            Vec3::new(0.78, 0.66, 0.58)
        };
        stone.tint(tone);
        hexahedron(stone, &corners, 0.014);
    }
    stone.tint(Vec3::ONE);
}

/// A moulded band round an arch, and a plain keystone over it.
fn archivolt(stone: &mut MeshBuilder, frame: &Frame, radius: f32) {
    let z = HALF_WALL_M;
    // x is towards the onlooker, y away from the arch's centre. Drawn from the soffit out.
    Pen::at(z - 0.02, -0.004)
        .to(z + 0.035, -0.004)
        .by(0.0, 0.09)
        .by(0.02, 0.0)
        .by(0.0, 0.09)
        .by(0.015, 0.0)
        .ovolo(0.03, 0.035)
        .by(0.015, 0.0)
        .by(0.0, 0.03)
        .to(z - 0.01, 0.27)
        .profile()
        .arch(stone, frame, radius, 28);
}

/// Carved discs in the spandrels.
fn roundels(stuff: &mut Stuff, arch: &Frame, bay_m: f32, storey: &Storey) {
    if storey.upper {
        return;
    }
    let y = storey.top_m - storey.springing_m - 0.52;
    let centre = arch.point(Vec3::new(-0.5 * bay_m, y, HALF_WALL_M - 0.01));
    // The disc's axis is the wall's normal.
    let frame = Frame::along(centre, arch.axes.z_axis, arch.axes.y_axis);
    Pen::at(0.36, 0.0)
        .by(0.0, 0.05)
        .bulge(0.04, 0.02)
        .to(0.33, 0.075)
        .to(0.29, 0.08)
        .to(0.27, 0.03)
        .to(0.2, 0.025)
        .to(0.16, 0.05)
        .to(0.1, 0.09)
        .to(0.0, 0.11)
        .profile()
        .lathe(&mut stuff.carved, &frame, 20);
    // Petals of the rosette.
    stuff.carved.sheet(64, 5, |s, t| {
        let angle = s * std::f32::consts::TAU;
        let petal = libm::cosf(angle * 8.0);
        let r = 0.06 + 0.2 * t;
        let up = 0.04 + 0.07 * libm::sinf(t * PI) * (0.55 + 0.45 * petal) - 0.04 * t;
        let c = on_circle(angle) * r;
        (frame.point(Vec3::new(c.x, up, c.y)), c)
    });
}

/// Balusters between the pedestals, on a sill, under a rail.
fn balustrade(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    const POST: f32 = 0.34;
    let (low, high) = (storey.floor_m, storey.column_foot_m - 0.02);
    let post = baluster(high - 0.16 - (low + 0.16));
    for bay in 0..side.bays {
        let x0 = bay as f32 * side.bay_m + POST;
        let x1 = (bay + 1) as f32 * side.bay_m - POST;
        let mut rail = |y0: f32, y1: f32, half: f32| {
            let low = Vec3::new(x0, y0, -half);
            block(
                &mut stuff.carved,
                &side.frame,
                low,
                Vec3::new(x1, y1, half),
                0.015,
            );
        };
        rail(low, low + 0.16, 0.17);
        rail(high - 0.16, high - 0.07, 0.13);
        rail(high - 0.07, high, 0.18);
        let count = ((x1 - x0) / 0.27) as u32;
        for i in 0..count {
            let x = lerp(x0, x1, (i as f32 + 0.5) / count as f32);
            let foot = side.frame.point(Vec3::new(x, low + 0.16, 0.0));
            stuff.carved.place(
                &post,
                &Frame {
                    origin_m: foot,
                    axes: side.frame.axes,
                },
            );
        }
    }
}

/// Two steps from the walk down to the court.
fn steps(stuff: &mut Stuff, side: &Side) {
    let rise = COURT_DROP_M / 2.0;
    for (i, out) in [(1.0, 0.5), (2.0, 0.85)] {
        let top = -rise * (i - 1.0);
        let from = Vec3::new(-out, top - rise - 0.02, -0.5);
        let step = 1.6;
        let count = ((side.length_m() + 2.0 * out) / step).ceil() as u32;
        let width = (side.length_m() - 2.0 * out) / count as f32;
        for k in 0..count {
            let low = from + Vec3::new(2.0 * out + k as f32 * width, 0.0, 0.0);
            let high = Vec3::new(low.x + width, top, out);
            block(&mut stuff.carved, &side.frame, low, high, 0.02);
        }
    }
}

/// Square piers at the court's corners, from floor to cornice.
pub(super) fn corner_piers(stuff: &mut Stuff, storey: &Storey) {
    for (sx, sz) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let frame = Frame::at(Vec3::new(sx * HALF_LENGTH_M, 0.0, sz * HALF_WIDTH_M));
        let half = storey.half_pier_m.max(HALF_WALL_M + 0.02);
        let course = 0.48;
        let bottom = if storey.upper {
            storey.floor_m
        } else {
            -COURT_DROP_M
        };
        let count = ((storey.springing_m - 0.1 - bottom) / course)
            .round()
            .max(1.0);
        let step = (storey.springing_m - 0.1 - bottom) / count;
        for i in 0..count as u32 {
            let y = bottom + i as f32 * step;
            let out = if i == 0 { half + 0.05 } else { half };
            let low = Vec3::new(-out, y, -out);
            block(
                &mut stuff.carved,
                &frame,
                low,
                Vec3::new(out, y + step, out),
                0.018,
            );
        }
        let out = half + 0.06;
        let y = storey.springing_m;
        block(
            &mut stuff.carved,
            &frame,
            Vec3::new(-out, y - 0.1, -out),
            Vec3::new(out, y, out),
            0.015,
        );
    }
}
