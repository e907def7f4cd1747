//! Where they stand: concrete slabs, a brick wall, a few crates.

use glam::Vec3;

use super::Materials;
use crate::scene::geometry::Mesh;
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::math::lerp;
use crate::scene::modelling::{Frame, MeshBuilder};
use crate::seed;

pub(super) fn meshes(materials: &Materials, seed: u64) -> Vec<Mesh> {
    let mut random = seed::generator(seed, "figures yard", 0);
    let mut draw = |low: f32, high: f32| lerp(low, high, seed::unit_f32(&mut random));
    let mut concrete = MeshBuilder::new();
    for row in -2..4 {
        for column in -3_i32..3 {
            let low = Vec3::new(column as f32 * 1.5 + 0.4, -0.2, row as f32 * 1.5 - 0.9);
            let high = low + Vec3::new(1.488, 0.2, 1.488);
            // Slabs have settled by a few millimetres; those they stand on have not.
            let settled = if row == 0 && column.abs() <= 1 {
                0.0
            } else {
                draw(-0.006, 0.0)
            };
            let tint = draw(0.9, 1.04);
            concrete.tint(Vec3::splat(tint));
            block(
                &mut concrete,
                &Frame::WORLD,
                low + Vec3::Y * settled,
                high + Vec3::Y * settled,
                0.010,
            );
        }
    }
    // Earth in the joints.
    concrete.tint(Vec3::new(0.12, 0.10, 0.08));
    let bed = [[-5.0, 6.0], [5.0, 6.0], [5.0, -4.0], [-5.0, -4.0]];
    concrete.quad(bed.map(|[x, z]| Vec3::new(x, -0.03, z)));
    let mut brick = MeshBuilder::new();
    let wall_z = -1.7;
    block(
        &mut brick,
        &Frame::WORLD,
        Vec3::new(-6.0, 0.35, wall_z - 0.3),
        Vec3::new(6.0, 3.6, wall_z),
        0.01,
    );
    concrete.tint(Vec3::splat(0.92));
    block(
        &mut concrete,
        &Frame::WORLD,
        Vec3::new(-6.0, -0.1, wall_z - 0.3),
        Vec3::new(6.0, 0.36, wall_z + 0.06),
        0.02,
    );
    for i in 0..4 {
        let x = -3.9 + 2.6 * i as f32;
        block(
            &mut brick,
            &Frame::WORLD,
            Vec3::new(x - 0.25, 0.35, wall_z - 0.2),
            Vec3::new(x + 0.25, 3.6, wall_z + 0.13),
            0.01,
        );
    }
    let mut wood = MeshBuilder::new();
    for (x, y, z, size, turn) in [
        (-1.35, 0.0, -1.02, 0.72, 0.12),
        (-1.42, 0.72, -1.05, 0.55, -0.2),
        (1.30, 0.0, -0.95, 0.80, -0.25),
        (2.15, 0.0, -1.15, 0.62, 0.3),
    ] {
        crate_box(
            &mut wood,
            &Frame::turned(Vec3::new(x, y, z), turn),
            size,
            &mut draw,
        );
    }
    vec![
        concrete.finish("yard", materials.concrete.0, materials.concrete.1),
        brick.finish("wall", materials.brick.0, materials.brick.1),
        wood.finish("crates", materials.wood.0, materials.wood.1),
    ]
}

/// A crate of planks in a frame of battens; origin at the middle of its foot.
fn crate_box(
    wood: &mut MeshBuilder,
    frame: &Frame,
    size: f32,
    draw: &mut impl FnMut(f32, f32) -> f32,
) {
    const PLANKS: u32 = 5;
    /// Thickness.
    const BATTEN_M: f32 = 0.032;
    let half = 0.5 * size;
    for turn in 0..4 {
        let side = frame.then(&Frame::turned(
            Vec3::Y * half,
            turn as f32 * std::f32::consts::FRAC_PI_2,
        ));
        let wide = size / PLANKS as f32;
        for i in 0..PLANKS {
            let y = -half + i as f32 * wide;
            wood.tint(Vec3::splat(draw(0.75, 1.15)));
            let out = half - draw(0.030, 0.036);
            block(
                wood,
                &side,
                Vec3::new(-half + 0.02, y + 0.004, out - 0.02),
                Vec3::new(half - 0.02, y + wide - 0.004, out),
                0.004,
            );
        }
        // Two of the sides stand between the other two: faces in one place would flicker.
        let reach = half - if turn % 2 == 0 { 0.0 } else { BATTEN_M };
        let mut batten = |low: [f32; 2], high: [f32; 2]| {
            wood.tint(Vec3::splat(draw(0.85, 1.05)));
            block(
                wood,
                &side,
                Vec3::new(low[0], low[1], half - BATTEN_M),
                Vec3::new(high[0], high[1], half),
                0.005,
            );
        };
        let b = 0.085 * size / 0.7;
        batten([-reach, -half], [reach, -half + b]);
        batten([-reach, half - b], [reach, half]);
        batten([-reach, -half + b], [-half + b, half - b]);
        batten([half - b, -half + b], [reach, half - b]);
    }
    // Dark inside, so that no light shows between the planks.
    wood.tint(Vec3::splat(0.15));
    let inner = half - 0.06;
    block(
        wood,
        frame,
        Vec3::new(-inner, 0.02, -inner),
        Vec3::new(inner, size - 0.04, inner),
        0.002,
    );
    wood.tint(Vec3::splat(0.9));
    block(
        wood,
        frame,
        Vec3::new(-half + 0.01, size - 0.03, -half + 0.01),
        Vec3::new(half - 0.01, size - 0.008, half - 0.01),
        0.004,
    );
}
