//! The order: columns with base, shaft and capital; balusters. Proportions after
//! Vignola's Corinthian, a little stouter.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::{Vec2, Vec3};

use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::{cos, lerp, on_circle, pow, sin, smoothstep};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder};

/// Sizes of a column, metres.
#[derive(Clone, Copy)]
pub(super) struct Column {
    /// Foot of the plinth to the top of the abacus.
    pub height_m: f32,
    /// Radius of the shaft at its foot.
    pub radius_m: f32,
    /// Whether the shaft is fluted.
    pub fluted: bool,
}

impl Column {
    /// The column on the origin, y up.
    pub fn build(&self) -> MeshBuilder {
        let mut stone = MeshBuilder::new();
        let r = self.radius_m;
        let base_top = base(&mut stone, r);
        let capital_height = 2.2 * r;
        let shaft_top = self.height_m - capital_height;
        shaft(&mut stone, r, base_top, shaft_top, self.fluted);
        capital(&mut stone, r * 0.86, shaft_top, capital_height);
        stone
    }
}

/// Attic base: plinth, torus, scotia, torus. Gives the height of its top, metres.
fn base(stone: &mut MeshBuilder, r: f32) -> f32 {
    let plinth = 0.36 * r;
    let half = 1.42 * r;
    block(
        stone,
        &Frame::WORLD,
        Vec3::new(-half, 0.0, -half),
        Vec3::new(half, plinth, half),
        0.012,
    );
    Pen::at(1.15 * r, plinth)
        .to(1.18 * r, plinth)
        .bulge(0.32 * r, 0.2 * r)
        .by(-0.04 * r, 0.0)
        .by(0.0, 0.05 * r)
        .bulge(0.22 * r, -0.1 * r)
        .by(0.0, 0.05 * r)
        .bulge(0.2 * r, 0.12 * r)
        .by(-0.03 * r, 0.0)
        .by(0.0, 0.06 * r)
        .to(1.0 * r, plinth + 0.98 * r)
        .profile()
        .lathe(stone, &Frame::WORLD, 32);
    plinth + 0.98 * r
}

/// The shaft swells and tapers: straight for a third, then a curve to 0.86 of the foot.
fn shaft(stone: &mut MeshBuilder, r: f32, bottom: f32, top: f32, fluted: bool) {
    const FLUTES: f32 = 20.0;
    let columns = if fluted { 100 } else { 36 };
    stone.sheet(columns, 8, |s, t| {
        let angle = s * TAU;
        let taper = 1.0 - 0.14 * pow(((t - 0.3) / 0.7).max(0.0), 1.7);
        let depth = if fluted {
            let within = smoothstep(0.0, 0.05, t) * smoothstep(1.0, 0.95, t);
            let across = 0.5 + 0.5 * cos(angle * FLUTES);
            0.085 * r * within * pow(across, 0.6)
        } else {
            0.0
        };
        let around = on_circle(angle) * (r * taper - depth);
        let y = lerp(bottom, top, t);
        // Counter-clockwise from above is −z first, so that the sheet faces outwards.
        let uv = Vec2::new(angle * r, -y);
        (Vec3::new(around.x, y, -around.y), uv)
    });
}

/// A Corinthian capital: bell, two rows of leaves, four corner volutes, abacus.
fn capital(stone: &mut MeshBuilder, r: f32, y: f32, height: f32) {
    let bell = height * 0.84;
    Pen::at(r, y)
        .to(1.0 * r, y + 0.02 * height)
        .bulge(0.07 * height, 0.09 * r)
        .to(0.98 * r, y + 0.1 * height)
        .to(1.0 * r, y + 0.5 * height)
        .to(1.12 * r, y + 0.7 * height)
        .to(1.34 * r, y + bell)
        .profile()
        .lathe(stone, &Frame::WORLD, 24);
    for i in 0..8 {
        let angle = FRAC_PI_4 * i as f32;
        leaf(
            stone,
            angle,
            r * 1.0,
            y + 0.09 * height,
            height * 0.4,
            r * 0.44,
        );
        leaf(
            stone,
            angle + 0.5 * FRAC_PI_4,
            r * 1.02,
            y + 0.2 * height,
            height * 0.55,
            r * 0.40,
        );
    }
    for i in 0..4 {
        volute(
            stone,
            FRAC_PI_4 + FRAC_PI_2 * i as f32,
            r,
            y + 0.5 * height,
            bell - 0.5 * height,
        );
    }
    abacus(stone, r, y + bell, height - bell);
}

/// An acanthus leaf: up along the bell, out and over at the top; lobed at its edge,
/// with a raised midrib. Closed, so that its back is seen where it curls.
fn leaf(stone: &mut MeshBuilder, angle: f32, radius: f32, y: f32, height: f32, width: f32) {
    let frame = Frame::turned(Vec3::Y * y, angle);
    let point = move |s: f32, t: f32, thickness: f32| {
        let side = 2.0 * s - 1.0;
        // The spine: rises, then rolls over a circle of `curl`.
        let curl = 0.22 * height;
        let roll = ((t - 0.62) / 0.38).max(0.0) * 1.25 * PI;
        let (rise, out) = if t < 0.62 {
            (t / 0.62 * (height - curl), 0.05 * height * t)
        } else {
            (
                height - curl + curl * sin(roll),
                0.031 * height + curl * (1.0 - cos(roll)),
            )
        };
        let lobes = 1.0 + 0.16 * cos(t * TAU * 4.0) * smoothstep(0.2, 0.9, side.abs());
        let half = width * (0.75 + 0.35 * sin(t * PI)) * smoothstep(1.25, 0.55, t) * lobes;
        let ribs = 0.05 * width * cos(side * PI * 2.5) - 0.1 * width * side * side;
        // Thickness lies along the leaf's own normal, which rolls with it.
        // (none at its edges, where front and back meet).
        let raised =
            ribs + thickness * (1.0 - 0.9 * side * side) * smoothstep(1.0, 0.85, t).max(0.2);
        let (out, rise) = (out + raised * cos(roll), rise - raised * sin(roll));
        let x = side * half;
        // Wrapped about the bell.
        let around = x / radius;
        let distance = radius + out;
        frame.point(Vec3::new(
            sin(around) * distance,
            rise,
            cos(around) * distance,
        ))
    };
    let uv = move |s: f32, t: f32| Vec2::new(s * width * 2.0, -t * height);
    // Both sides of the same net: chords of different ones would cross where the leaf rolls.
    stone.sheet(4, 12, |s, t| (point(s, t, 0.05 * width), uv(s, t)));
    stone.sheet(4, 12, |s, t| (point(1.0 - s, t, -0.03 * width), uv(s, t)));
}

/// A scroll under a corner of the abacus.
fn volute(stone: &mut MeshBuilder, angle: f32, r: f32, y: f32, height: f32) {
    // turned() brings z to the angle's direction; the scroll lies in its yz plane.
    let frame = Frame::turned(Vec3::Y * y, angle);
    let eye = Vec2::new(1.52 * r, height * 0.62);
    let path = move |t: f32| {
        if t < 0.4 {
            let k = t / 0.4;
            let start = Vec2::new(1.05 * r, 0.0);
            let end = eye + Vec2::new(0.0, 0.36 * height);
            let lifted = start.lerp(end, k) - Vec2::new(0.16 * r * sin(k * PI), 0.0);
            return (lifted, 0.05 * r);
        }
        let k = (t - 0.4) / 0.6;
        let radius = 0.36 * height * (1.0 - 0.8 * k);
        let turn = FRAC_PI_2 - k * 1.6 * TAU;
        (eye + on_circle(turn) * radius, 0.05 * r * (1.0 - 0.4 * k))
    };
    stone.sheet(5, 22, |s, t| {
        let (p, thick) = path(t);
        let (q, _) = path(t + 1e-3);
        let along = (q - p).normalize_or(Vec2::Y);
        let across = Vec2::new(-along.y, along.x);
        let c = on_circle(-s * TAU);
        let offset = across * (c.x * thick);
        let wide = 0.13 * r * c.y;
        (
            frame.point(Vec3::new(wide, p.y + offset.y, p.x + offset.x)),
            Vec2::new(s * 0.1, -t * 0.8),
        )
    });
}

/// A square slab with hollow sides and cut corners.
fn abacus(stone: &mut MeshBuilder, r: f32, y: f32, height: f32) {
    let outline = move |angle: f32| {
        let c = on_circle(angle);
        let square = 1.0 / c.x.abs().max(c.y.abs());
        let hollow = 1.0 - 0.16 * smoothstep(FRAC_PI_2 * 0.5, 0.0, nearest_side(angle));
        c * (1.36 * r * (square * hollow).min(1.33))
    };
    let rows = [
        (0.93, 0.0),
        (1.0, 0.35),
        (1.0, 0.55),
        (1.06, 0.62),
        (1.06, 1.0),
    ];
    stone.sheet(48, 8, |s, t| {
        let k = t.clamp(0.0, 0.9999) * 4.0;
        let i = k as usize;
        let (a, b) = (rows[i], rows[i + 1]);
        let (scale, up) = (lerp(a.0, b.0, k - i as f32), lerp(a.1, b.1, k - i as f32));
        let p = outline(s * TAU) * scale;
        (
            Vec3::new(p.x, y + up * height, -p.y),
            Vec2::new(s * 6.0 * r, -up * height),
        )
    });
    // Its top and under side, as far as they are seen.
    stone.sheet(48, 1, |s, t| {
        let p = outline(s * TAU) * lerp(0.93, 0.4, 1.0 - t);
        (Vec3::new(p.x, y, -p.y), Vec2::new(p.x, p.y))
    });
    stone.sheet(48, 1, |s, t| {
        let p = outline(s * TAU) * lerp(1.06, 0.2, t);
        (Vec3::new(p.x, y + height, -p.y), Vec2::new(p.x, p.y))
    });
}

/// Angle to the middle of the nearest side of a square, radians.
fn nearest_side(angle: f32) -> f32 {
    let quarter = angle / FRAC_PI_2;
    (quarter - (quarter + 0.5).floor()).abs() * FRAC_PI_2
}

/// A turned baluster `height_m` tall.
pub(super) fn baluster(height_m: f32) -> MeshBuilder {
    let h = height_m;
    let mut stone = MeshBuilder::new();
    for (low, high) in [(0.0, 0.09), (0.92, 1.0)] {
        block(
            &mut stone,
            &Frame::WORLD,
            Vec3::new(-0.085, low * h, -0.085),
            Vec3::new(0.085, high * h, 0.085),
            0.006,
        );
    }
    Pen::at(0.07, 0.09 * h)
        .torus(0.05 * h)
        .to(0.045, 0.16 * h)
        .to(0.078, 0.27 * h)
        .to(0.086, 0.34 * h)
        .to(0.076, 0.42 * h)
        .to(0.046, 0.58 * h)
        .to(0.036, 0.7 * h)
        .to(0.036, 0.76 * h)
        .torus(0.045 * h)
        .to(0.042, 0.85 * h)
        .to(0.075, 0.92 * h)
        .profile()
        .lathe(&mut stone, &Frame::WORLD, 8);
    stone
}
