//! Surfaces without a pattern of their own: plaster, carved stone, wood, clay, concrete.

use glam::{IVec2, Vec2, Vec3};

use super::{Recipe, Texel, srgb};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::{lerp, sin, smoothstep};

fn limit(albedo: Vec3) -> Vec3 {
    albedo.clamp(Vec3::ZERO, Vec3::splat(0.9))
}

/// Lime plaster, trowelled, with a wash of ochre and a few hair cracks.
#[must_use]
pub fn plaster(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture plaster", 0);
    let (pale, ochre) = (srgb(0xe3d5b8), srgb(0xcfb488));
    Recipe {
        name: "plaster",
        size_px: 512,
        tile_m: 4.0,
        texel: Box::new(move |uv| {
            let wash = noise.tiling_fbm(uv, IVec2::splat(3), 5);
            let trowel = noise.tiling_fbm(uv, IVec2::new(20, 34), 3);
            let sand = noise.tiling(uv, IVec2::splat(128));
            let bent = uv + Vec2::splat(0.02 * noise.tiling_fbm(uv, IVec2::splat(12), 3));
            let cell = noise.cells(bent, IVec2::splat(5));
            let shown = smoothstep(0.1, 0.35, noise.tiling(uv, IVec2::splat(4)));
            let crack = smoothstep(0.012, 0.003, cell.second - cell.nearest) * shown;
            let patch = smoothstep(-0.6, 0.7, wash);
            let shade = 1.0 + 0.06 * trowel + 0.03 * sand - 0.35 * crack;
            Texel {
                albedo: limit(pale.lerp(ochre, 0.6 * patch) * shade),
                height_m: 0.004 * trowel + 0.0006 * sand - 0.003 * crack,
                roughness: (0.9 + 0.05 * trowel).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Carved limestone of columns and mouldings: fine grain, faint beds, small pits.
#[must_use]
pub fn carved_stone(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture carved stone", 0);
    let (light, warm) = (srgb(0xb5ada0), srgb(0xa59880));
    Recipe {
        name: "carved stone",
        size_px: 512,
        tile_m: 1.6,
        texel: Box::new(move |uv| {
            let bend = 0.05 * noise.tiling_fbm(uv, IVec2::splat(4), 3);
            let bed = noise.tiling_fbm(Vec2::new(uv.x, uv.y + bend), IVec2::new(2, 9), 4);
            let grain = noise.tiling_fbm(uv, IVec2::splat(64), 2);
            let pit = noise.cells(uv, IVec2::splat(48));
            let pit = smoothstep(0.22, 0.08, pit.nearest) * smoothstep(0.7, 0.95, pit.id);
            Texel {
                albedo: limit(
                    light.lerp(warm, (0.5 + 0.6 * bed).clamp(0.0, 1.0))
                        * (1.0 + 0.06 * grain - 0.3 * pit),
                ),
                height_m: 0.0012 * grain + 0.001 * bed - 0.003 * pit,
                roughness: (0.72 + 0.1 * grain + 0.1 * bed).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Polished limestone of slabs, worn by feet: clouds, thin veins, fossils. Pale, to be
/// tinted slab by slab.
#[must_use]
pub fn paving(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture paving", 0);
    Recipe {
        name: "paving",
        size_px: 1024,
        tile_m: 2.4,
        texel: Box::new(move |uv| {
            let bend = 0.03 * noise.tiling_fbm(uv, IVec2::splat(8), 3);
            let cloud = noise.tiling_fbm(uv + Vec2::splat(bend), IVec2::new(7, 5), 5);
            let ridge = noise.tiling_fbm(uv + Vec2::new(bend, -bend), IVec2::splat(6), 4);
            let vein = smoothstep(0.05, 0.0, ridge.abs()) * smoothstep(-0.2, 0.4, cloud);
            let fossil = noise.cells(uv, IVec2::splat(44));
            let fossil = smoothstep(0.2, 0.12, fossil.nearest) * smoothstep(0.8, 0.95, fossil.id);
            let grain = noise.tiling_fbm(uv, IVec2::splat(96), 2);
            let worn = noise.tiling_fbm(uv, IVec2::splat(9), 4);
            let shade = 0.80 * (1.0 + 0.20 * cloud + 0.06 * grain) * (1.0 - 0.10 * fossil);
            Texel {
                albedo: limit(Vec3::new(1.0, 0.985, 0.96) * shade * (1.0 - 0.22 * vein)),
                height_m: 0.0006 * worn + 0.00025 * grain - 0.0008 * fossil,
                roughness: (0.46 + 0.16 * worn + 0.05 * grain + 0.1 * vein).clamp(0.2, 1.0),
            }
        }),
    }
}

/// Oak boards, 0.2 m wide, running down the image.
#[must_use]
pub fn wood(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture wood", 0);
    let (light, dark) = (srgb(0x8a6440), srgb(0x4c3220));
    Recipe {
        name: "wood",
        size_px: 512,
        tile_m: 1.0,
        texel: Box::new(move |uv| {
            let board = (uv.x * 5.0).floor();
            let within_m = (uv.x * 5.0 - board) * 0.2;
            let gap = smoothstep(0.001, 0.006, within_m.min(0.2 - within_m));
            let place = Vec2::new(uv.x, uv.y + 0.37 * board);
            let ring = noise.tiling_fbm(place, IVec2::new(14, 2), 3);
            let fibre = noise.tiling_fbm(place, IVec2::new(128, 6), 2);
            let grain = 0.5 + 0.5 * sin(ring * 16.0);
            let shade = 0.85 + 0.3 * noise.at(glam::IVec3::new(board as i32, 0, 9));
            Texel {
                albedo: limit(
                    dark.lerp(light, 0.35 + 0.28 * grain + 0.3 * fibre)
                        .max(Vec3::ZERO)
                        * shade
                        * lerp(0.35, 1.0, gap),
                ),
                height_m: 0.005 * gap + 0.0008 * fibre + 0.0004 * grain,
                roughness: (0.62 + 0.2 * fibre).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Thrown and fired clay.
#[must_use]
pub fn terracotta(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture terracotta", 0);
    let (clay, bloom) = (srgb(0xb1694a), srgb(0xc9a284));
    Recipe {
        name: "terracotta",
        size_px: 512,
        tile_m: 1.0,
        texel: Box::new(move |uv| {
            let lime = smoothstep(0.0, 0.6, noise.tiling_fbm(uv, IVec2::splat(4), 4));
            let throwing = noise.tiling(uv, IVec2::new(2, 60));
            let grain = noise.tiling_fbm(uv, IVec2::splat(90), 2);
            Texel {
                albedo: limit(
                    clay.lerp(bloom, 0.4 * lime) * (1.0 + 0.08 * grain + 0.05 * throwing),
                ),
                height_m: 0.0008 * throwing + 0.0006 * grain,
                roughness: (0.8 + 0.1 * lime).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Cast concrete that has stood in the weather.
#[must_use]
pub fn concrete(seed: u64) -> Recipe {
    let noise = Noise::new(seed, "texture concrete", 0);
    let (grey, dark) = (srgb(0xa7a39b), srgb(0x77736b));
    Recipe {
        name: "concrete",
        size_px: 1024,
        tile_m: 3.0,
        texel: Box::new(move |uv| {
            let stain = noise.tiling_fbm(uv, IVec2::splat(3), 5);
            let grain = noise.tiling_fbm(uv, IVec2::splat(110), 2);
            let pit = noise.cells(uv, IVec2::splat(60));
            let pit = smoothstep(0.2, 0.07, pit.nearest) * smoothstep(0.75, 0.95, pit.id);
            let bent = uv + Vec2::splat(0.03 * noise.tiling_fbm(uv, IVec2::splat(9), 4));
            let cell = noise.cells(bent, IVec2::splat(3));
            let shown = smoothstep(0.0, 0.3, noise.tiling(uv, IVec2::splat(3)));
            let crack = smoothstep(0.010, 0.002, cell.second - cell.nearest) * shown;
            let shade = (1.0 + 0.12 * grain) * (1.0 - 0.4 * pit) * (1.0 - 0.55 * crack);
            Texel {
                albedo: limit(grey.lerp(dark, smoothstep(-0.3, 0.6, stain)) * shade),
                height_m: 0.001 * grain + 0.002 * stain - 0.003 * pit - 0.005 * crack,
                roughness: (0.88 + 0.08 * stain).clamp(0.3, 1.0),
            }
        }),
    }
}

/// Every recipe here.
#[must_use]
pub fn all(seed: u64) -> Vec<Recipe> {
    vec![
        plaster(seed),
        carved_stone(seed),
        paving(seed),
        wood(seed),
        terracotta(seed),
        concrete(seed),
    ]
}
