//! Cloth and leather.

use std::f32::consts::TAU;

use glam::{IVec2, Vec2, Vec3};

use super::{Recipe, Texel, srgb};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::{cos, lerp, sin, smoothstep};

/// A plain weave of `threads` a tile each way: height 0 to 1 and which thread is on
/// top (+1 warp, −1 weft).
fn weave(uv: Vec2, threads: f32) -> (f32, f32) {
    let p = uv * threads;
    let over = if ((p.x.floor() + p.y.floor()) as i32).rem_euclid(2) == 0 {
        1.0
    } else {
        -1.0
    };
    let within = p - p.floor();
    let across = if over > 0.0 { within.x } else { within.y };
    let along = if over > 0.0 { within.y } else { within.x };
    let round = (across * (1.0 - across) * 4.0).sqrt();
    (round * (0.55 + 0.45 * sin(along * TAU * 0.5)), over)
}

/// The ogee lattice of a renaissance damask: 1 inside the figure, 0 on the ground.
fn damask(uv: Vec2) -> f32 {
    let p = uv * 4.0;
    // Two interleaved lattices of the same motif.
    let motif = |q: Vec2| {
        let q = q - q.floor() - Vec2::splat(0.5);
        let ogee = q.x.abs() - 0.23 * (1.0 + cos(TAU * q.y)) * 0.5 - 0.06;
        let frame = smoothstep(0.045, 0.03, (ogee - 0.03).abs());
        let petals = 0.13 + 0.05 * cos(5.0 * libm::atan2f(q.y, q.x));
        let flower = smoothstep(0.01, -0.01, q.length() - petals);
        let heart = smoothstep(0.01, -0.01, 0.045 - q.length());
        frame.max(flower * heart)
    };
    motif(Vec2::new(p.x, p.y * 0.5)).max(motif(Vec2::new(p.x + 0.5, p.y * 0.5 + 0.5)))
}

/// Heavy damask for hangings; white, to be dyed by the material's colour.
#[must_use]
pub fn hanging(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture hanging", 0);
    Recipe {
        name: "hanging cloth",
        size_px: 1024,
        tile_m: 1.2,
        texel: Box::new(move |uv| {
            let (height, _) = weave(uv, 256.0);
            let figure = damask(uv);
            let slub = noise.tiling_fbm(uv, IVec2::new(16, 128), 2);
            let fade = noise.tiling_fbm(uv, IVec2::splat(3), 3);
            let shade = lerp(0.62, 0.86, figure) * (1.0 + 0.08 * slub + 0.08 * fade);
            Texel {
                albedo: Vec3::splat((shade * (0.8 + 0.2 * height)).clamp(0.0, 0.9)),
                height_m: 0.0007 * height + 0.0004 * figure + 0.0003 * slub,
                roughness: lerp(0.92, 0.7, figure),
            }
        }),
    }
}

/// Sturdy cotton for clothes; white, to be dyed by the corners' colour.
#[must_use]
pub fn canvas(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture canvas", 0);
    Recipe {
        name: "canvas",
        size_px: 512,
        tile_m: 0.25,
        texel: Box::new(move |uv| {
            let (height, _) = weave(uv, 128.0);
            let slub = noise.tiling_fbm(uv, IVec2::new(48, 12), 2);
            let wear = noise.tiling_fbm(uv, IVec2::splat(3), 4);
            Texel {
                albedo: Vec3::splat(
                    (0.82 * (0.84 + 0.16 * height) * (1.0 + 0.08 * slub + 0.1 * wear))
                        .clamp(0.0, 0.9),
                ),
                height_m: 0.00022 * height + 0.0004 * wear + 0.0001 * slub,
                roughness: (0.9 + 0.06 * slub).clamp(0.4, 1.0),
            }
        }),
    }
}

/// Worn leather; white, to be dyed by the corners' colour.
#[must_use]
pub fn leather(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture leather", 0);
    let scuff = srgb(0xd8d2c8);
    Recipe {
        name: "leather",
        size_px: 512,
        tile_m: 0.2,
        texel: Box::new(move |uv| {
            let bent = uv + Vec2::splat(0.01 * noise.tiling_fbm(uv, IVec2::splat(10), 2));
            let cell = noise.cells(bent, IVec2::splat(56));
            let crease = smoothstep(0.02, 0.28, cell.second - cell.nearest);
            let worn = noise.tiling_fbm(uv, IVec2::splat(4), 4);
            Texel {
                albedo: (scuff * (0.8 + 0.2 * crease) * (0.86 + 0.18 * worn))
                    .clamp(Vec3::ZERO, Vec3::splat(0.9)),
                height_m: 0.00035 * crease + 0.0005 * worn,
                roughness: (0.5 + 0.2 * (1.0 - crease) + 0.15 * worn).clamp(0.2, 1.0),
            }
        }),
    }
}

/// Every recipe here.
#[must_use]
pub fn all(seed: u64) -> Vec<Recipe> {
    vec![hanging(seed), canvas(seed), leather(seed)]
}
