//! Things laid in courses: ashlar, brick.

use glam::{IVec2, IVec3, Vec2, Vec3};

use super::{Recipe, Texel, srgb};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::{lerp, smoothstep};

/// Where a point lies in its stone.
struct InStone {
    /// A number in [0, 1) of this stone, and another.
    ids: [f32; 2],
    /// Distance to the nearest edge of the stone, metres.
    edge_m: f32,
}

/// Courses of equal stones, `across` × `courses` a tile, each course shifted by
/// `shift` of a stone against the last.
#[derive(Clone, Copy)]
struct Bond {
    across: i32,
    courses: i32,
    shift: f32,
    tile_m: f32,
}

impl Bond {
    fn find(&self, noise: Noise, uv: Vec2) -> InStone {
        let y = uv.y * self.courses as f32;
        let course = (y.floor() as i32).rem_euclid(self.courses);
        let x = uv.x * self.across as f32 + self.shift * (course % 2) as f32;
        let stone = (x.floor() as i32).rem_euclid(self.across);
        let within = Vec2::new(x - x.floor(), y - y.floor());
        let size_m = self.tile_m / Vec2::new(self.across as f32, self.courses as f32);
        let edge = (within.min(Vec2::ONE - within)) * size_m;
        InStone {
            ids: [3, 4].map(|k| noise.at(IVec3::new(stone, course, k))),
            edge_m: edge.min_element(),
        }
    }
}

/// Dressed limestone blocks, 0.8 × 0.4 m, with thin lime joints.
#[must_use]
pub fn ashlar(seed: u64) -> Recipe {
    const TILE_M: f32 = 3.2;
    let noise = Noise::new(seed, "texture ashlar", 0);
    let bond = Bond {
        across: 4,
        courses: 8,
        shift: 0.5,
        tile_m: TILE_M,
    };
    let (warm, cool, mortar) = (srgb(0xc0a880), srgb(0xa89a84), srgb(0x9a8b72));
    Recipe {
        name: "ashlar",
        size_px: 1024,
        tile_m: TILE_M,
        texel: Box::new(move |uv| {
            let wobble = Vec2::new(
                noise.tiling(uv, IVec2::splat(40)),
                noise.tiling(uv, IVec2::new(41, 39)),
            );
            let stone = bond.find(noise, uv + wobble * 0.0008);
            let face = smoothstep(0.002, 0.012, stone.edge_m);
            let grain = noise.tiling_fbm(uv, IVec2::splat(64), 3);
            let stain = noise.tiling_fbm(uv, IVec2::new(5, 3), 4);
            let pit = noise.cells(uv, IVec2::splat(70));
            let pit = smoothstep(0.16, 0.05, pit.nearest) * smoothstep(0.6, 0.9, pit.id);
            let shade = lerp(0.78, 1.10, stone.ids[0]) * (1.0 + 0.14 * stain + 0.07 * grain);
            let stone_color = warm.lerp(cool, stone.ids[1]) * shade * (1.0 - 0.35 * pit);
            Texel {
                albedo: (mortar * 0.8)
                    .lerp(stone_color, face)
                    .clamp(Vec3::ZERO, Vec3::splat(0.9)),
                height_m: face * (0.006 + 0.002 * stone.ids[1]) + 0.0012 * grain - 0.004 * pit
                    + 0.0015 * noise.tiling(uv, IVec2::splat(17)),
                roughness: lerp(0.95, 0.8 + 0.08 * grain, face).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Old handmade brick, 0.25 × 0.0625 m courses, in wide joints.
#[must_use]
pub fn brick(seed: u64) -> Recipe {
    const TILE_M: f32 = 1.5;
    let noise = Noise::new(seed, "texture brick", 0);
    let bond = Bond {
        across: 6,
        courses: 20,
        shift: 0.5,
        tile_m: TILE_M,
    };
    let (red, pale, mortar) = (srgb(0x7d5244), srgb(0x917260), srgb(0x8d857a));
    Recipe {
        name: "brick",
        size_px: 1024,
        tile_m: TILE_M,
        texel: Box::new(move |uv| {
            let wobble = Vec2::new(
                noise.tiling(uv, IVec2::splat(24)),
                noise.tiling(uv, IVec2::new(25, 31)),
            );
            let stone = bond.find(noise, uv + wobble * 0.0018);
            let face = smoothstep(0.003, 0.010, stone.edge_m);
            let grain = noise.tiling_fbm(uv, IVec2::splat(72), 3);
            let soot = noise.tiling_fbm(uv, IVec2::splat(4), 3);
            let tone = lerp(0.74, 1.04, stone.ids[0]) * (1.0 + 0.16 * grain + 0.12 * soot);
            let color = red.lerp(pale, stone.ids[1] * stone.ids[1]) * tone;
            Texel {
                albedo: (mortar * (0.85 + 0.2 * grain))
                    .lerp(color, face)
                    .clamp(Vec3::ZERO, Vec3::splat(0.9)),
                height_m: face * (0.005 + 0.003 * stone.ids[0]) + 0.0012 * grain,
                roughness: (0.9 + 0.08 * grain).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Every recipe here.
#[must_use]
pub fn all(seed: u64) -> Vec<Recipe> {
    vec![ashlar(seed), brick(seed)]
}
