//! Cavity shading painted into colours, as a texture artist bakes it: wide hollows from
//! the distance field (Quilez, "Ambient occlusion" from distances), fine ones from
//! curvature, and a little dirt where both meet.

use glam::{IVec3, Vec3};
use rayon::prelude::*;

use super::person::{Layer, Stuff};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::smoothstep;
use crate::scene::modelling::sculpture::Sculpture;
use crate::scene::modelling::surface::Surface;

const CELL_M: f32 = 0.018;
/// How far the volume reaches beyond the figure, metres.
const MARGIN_M: f32 = 0.12;

/// The distance to the whole figure on a coarse grid.
pub(super) struct Volume {
    low_m: Vec3,
    across: IVec3,
    distances_m: Vec<f32>,
}

impl Volume {
    pub fn new<'a>(layers: impl Iterator<Item = &'a Sculpture>) -> Self {
        let layers: Vec<&Sculpture> = layers.collect();
        let boxes: Vec<(Vec3, Vec3)> = layers.iter().map(|layer| layer.bounds_m()).collect();
        let (low, high) = boxes.iter().fold(
            (Vec3::splat(f32::MAX), Vec3::splat(f32::MIN)),
            |(low, high), &(a, b)| (low.min(a), high.max(b)),
        );
        let low_m = low - Vec3::splat(MARGIN_M);
        let across = ((high + Vec3::splat(MARGIN_M) - low_m) / CELL_M)
            .ceil()
            .as_ivec3()
            + IVec3::ONE;
        let count = across.x * across.y * across.z;
        let distances_m = (0..count)
            .into_par_iter()
            .with_min_len(1024)
            .map(|i| {
                let at = IVec3::new(
                    i % across.x,
                    i / across.x % across.y,
                    i / (across.x * across.y),
                );
                let p = low_m + at.as_vec3() * CELL_M;
                // A layer whose box is further away than what is found already cannot count.
                layers
                    .iter()
                    .zip(&boxes)
                    .fold(f32::MAX, |so_far, (layer, &(low, high))| {
                        let outside = (low - p).max(p - high).max(Vec3::ZERO);
                        if outside.length() >= so_far {
                            return so_far;
                        }
                        so_far.min(layer.distance_m(p))
                    })
            })
            .collect();
        Self {
            low_m,
            across,
            distances_m,
        }
    }

    /// Distance at `p`, trilinear, metres.
    fn at(&self, p: Vec3) -> f32 {
        let q = ((p - self.low_m) / CELL_M)
            .clamp(Vec3::ZERO, (self.across - IVec3::splat(2)).as_vec3());
        let base = q.floor();
        let (cell, f) = (base.as_ivec3(), q - base);
        let pick = |x: i32, y: i32, z: i32| {
            let c = cell + IVec3::new(x, y, z);
            let index = (c.z * self.across.y + c.y) * self.across.x + c.x;
            self.distances_m[index.cast_unsigned() as usize]
        };
        let along_x = |y, z| pick(0, y, z) + (pick(1, y, z) - pick(0, y, z)) * f.x;
        let along_y = |z| along_x(0, z) + (along_x(1, z) - along_x(0, z)) * f.y;
        along_y(0) + (along_y(1) - along_y(0)) * f.z
    }

    /// 0 in a deep hollow to 1 in the open: how far the surroundings stay back, seen
    /// along the normal over the next 10 cm.
    fn openness(&self, p: Vec3, n: Vec3) -> f32 {
        let mut hidden = 0.0;
        for (step_m, weight) in [(0.015, 0.9), (0.03, 0.8), (0.055, 0.65), (0.1, 0.5)] {
            let short = (step_m - self.at(p + n * step_m)) / step_m;
            hidden += weight * short.clamp(0.0, 1.0) * 0.45;
        }
        (1.0 - hidden).clamp(0.0, 1.0)
    }
}

/// The colour of every corner of a layer's surface.
pub(super) fn colors(surface: &Surface, layer: &Layer, volume: &Volume, noise: Noise) -> Vec<Vec3> {
    let (wide, fine, edge) = match layer.stuff {
        Stuff::Cloth => (0.75, 0.5, 0.16),
        Stuff::Leather => (0.7, 0.45, 0.3),
        Stuff::Skin => (0.45, 0.25, 0.0),
        Stuff::Hair => (0.6, 0.6, 0.2),
        Stuff::Metal => (0.6, 0.4, 0.2),
    };
    (0..surface.positions_m.len())
        .into_par_iter()
        .map(|i| {
            let (p, n) = (surface.positions_m[i], surface.normals[i]);
            let curvature = surface.curvatures_per_m[i];
            let open = volume.openness(p, n);
            let groove = smoothstep(0.0, -160.0, curvature);
            let ridge = smoothstep(60.0, 320.0, curvature);
            let worn = 0.5 + 0.5 * noise.fbm(p * 9.0, 3);
            let shade =
                (1.0 - wide * (1.0 - open)) * (1.0 - fine * groove) * (1.0 + edge * ridge * worn);
            let base = (layer.paint)(p, n);
            // Hollows of skin turn red, not grey: light has gone through it.
            let tint = if layer.stuff == Stuff::Skin {
                Vec3::new(shade, shade * shade.sqrt(), shade * shade.sqrt())
            } else {
                Vec3::splat(shade)
            };
            let mottle = 1.0 + 0.10 * noise.fbm(p * 5.0, 3);
            (base * tint * mottle).clamp(Vec3::ZERO, Vec3::ONE)
        })
        .collect()
}
