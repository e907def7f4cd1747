//! The floors: every slab is a stone of its own, so that no two are alike and each joint
//! is a real one. The court has octagons of two colours with dark diamonds between; the
//! walks have square tiles of fired clay in a border of stone.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use rand_chacha::ChaCha20Rng;

use super::materials::Stuff;
use super::{COURT_DROP_M, HALF_LENGTH_M, HALF_WIDTH_M, WALK_M};
use crate::scene::modelling::MeshBuilder;
use crate::scene::modelling::blocks::prism;
use crate::scene::modelling::math::{lerp, on_circle};
use crate::seed;

const CREAM: Vec3 = Vec3::new(0.66, 0.60, 0.50);
const ROSE: Vec3 = Vec3::new(0.42, 0.27, 0.21);
const SLATE: Vec3 = Vec3::new(0.16, 0.158, 0.158);

/// Side of an octagon's square, and of a clay tile, metres.
const OCTAGON_M: f32 = 0.6;
const CLAY_M: f32 = 0.4;
const JOINT_M: f32 = 0.006;

/// Lays the floors of court and walks.
pub(super) fn build(stuff: &mut Stuff, seed: u64) {
    let mut random = seed::generator(seed, "atrium floor", 0);
    court(&mut stuff.floor, &mut random);
    walks(stuff, &mut random);
}

/// One stone with a colour, a slant and a piece of the texture of its own.
fn lay(
    stone: &mut MeshBuilder,
    outline_m: &[Vec2],
    top_m: f32,
    tint: Vec3,
    random: &mut ChaCha20Rng,
) {
    let mut draw = |low: f32, high: f32| lerp(low, high, seed::unit_f32(random));
    let mut slab = MeshBuilder::new();
    let warm = draw(-0.06, 0.06);
    slab.tint(tint * draw(0.84, 1.10) * Vec3::new(1.0 + warm, 1.0, 1.0 - warm));
    // Feet have pressed some corners down by a millimetre or two.
    let slant = Vec2::new(draw(-0.004, 0.004), draw(-0.004, 0.004));
    let top = top_m - draw(0.0, 0.002);
    prism(&mut slab, outline_m, top, slant, 0.04, 0.005);
    slab.shift_uv(Vec2::new(draw(0.0, 8.0), draw(0.0, 8.0)));
    stone.place(&slab, &crate::scene::modelling::Frame::WORLD);
}

/// A regular outline of `corners` points round `centre`; its first corner at `turn_rad`.
fn polygon(centre: Vec2, corners: u32, radius_m: f32, turn_rad: f32) -> Vec<Vec2> {
    (0..corners)
        .map(|i| centre + on_circle(turn_rad + TAU * i as f32 / corners as f32) * radius_m)
        .collect()
}

fn rectangle(low: Vec2, high: Vec2) -> Vec<Vec2> {
    let gap = Vec2::splat(0.5 * JOINT_M);
    let (a, b) = (low + gap, high - gap);
    vec![a, Vec2::new(b.x, a.y), b, Vec2::new(a.x, b.y)]
}

fn court(stone: &mut MeshBuilder, random: &mut ChaCha20Rng) {
    let y = -COURT_DROP_M;
    // The pattern ends under the steps; a band of slate runs along them.
    let columns = 37;
    let rows = 10;
    let half = Vec2::new(columns as f32, rows as f32) * (0.5 * OCTAGON_M);
    // Corners cut at a quarter of the side: the diamonds then have sides of 0.35.
    let cut = 0.25 * OCTAGON_M;
    for row in 0..rows {
        for column in 0..columns {
            let centre = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * OCTAGON_M - half;
            let h = 0.5 * OCTAGON_M - 0.5 * JOINT_M;
            let corners = [
                [h, -h + cut],
                [h, h - cut],
                [h - cut, h],
                [-h + cut, h],
                [-h, h - cut],
                [-h, -h + cut],
                [-h + cut, -h],
                [h - cut, -h],
            ]
            .map(|c| centre + Vec2::from(c));
            let tint = if (row + column) % 2 == 0 { CREAM } else { ROSE };
            lay(stone, &corners, y, tint, random);
            if row > 0 && column > 0 {
                let corner = centre - Vec2::splat(0.5 * OCTAGON_M);
                let diamond = polygon(corner, 4, cut - JOINT_M, 0.0);
                lay(stone, &diamond, y, SLATE, random);
            }
        }
    }
    let band = 0.4;
    for i in 0..28 {
        let x = [i as f32, i as f32 + 1.0].map(|k| (k / 14.0 - 1.0) * half.x);
        for z in [-half.y - band, half.y] {
            let outline = rectangle(Vec2::new(x[0], z), Vec2::new(x[1], z + band));
            lay(stone, &outline, y, SLATE * 1.25, random);
        }
    }
}

/// Clay tiles behind the arches, all round, up to the slabs the columns stand on, with a
/// row of stone along those.
fn walks(stuff: &mut Stuff, random: &mut ChaCha20Rng) {
    // The columns' slabs reach half a metre back and stand a little proud of the tiles.
    let slabs = Vec2::new(HALF_LENGTH_M, HALF_WIDTH_M) + Vec2::splat(0.5);
    let top_m = -0.006;
    let outer = Vec2::new(HALF_LENGTH_M, HALF_WIDTH_M) + Vec2::splat(WALK_M);
    let count = (outer * 2.0 / CLAY_M).ceil().as_ivec2();
    for row in 0..count.y {
        for column in 0..count.x {
            let low = Vec2::new(column as f32, row as f32) * CLAY_M - outer;
            let high = low + Vec2::splat(CLAY_M);
            let beside_m = ((low + high).abs() * 0.5 - slabs).max_element();
            if beside_m < -0.5 * CLAY_M {
                continue;
            }
            let (builder, tint) = if beside_m > 0.5 * CLAY_M {
                (&mut stuff.terracotta, Vec3::new(0.55, 0.56, 0.58))
            } else if (row + column) % 2 == 0 {
                (&mut stuff.floor, CREAM)
            } else {
                (&mut stuff.floor, SLATE * 1.5)
            };
            lay(builder, &rectangle(low, high), top_m, tint, random);
        }
    }
}
