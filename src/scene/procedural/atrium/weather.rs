//! What weather and use have left on the masonry, as colours of its corners: the
//! textures repeat every few metres, and these stains do not.

use glam::Vec3;

use super::arcade::Storey;
use super::{COURT_DROP_M, HALF_WIDTH_M};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::smoothstep;

/// Walls are cut into pieces of this size, metres, so that they can carry stains.
pub(super) const STAIN_STEP_M: f32 = 0.3;

/// The stains of one scene.
#[derive(Clone, Copy)]
pub(super) struct Weather {
    noise: Noise,
}

impl Weather {
    pub fn new(seed: u64) -> Self {
        Self {
            noise: Noise::new(seed, "atrium weather", 0),
        }
    }

    /// Factor on the albedo of stone and brick at a point with this normal.
    pub fn stone(self, p: Vec3, n: Vec3) -> Vec3 {
        let warmth = self.noise.fbm(p * 0.22 + Vec3::splat(3.7), 3);
        let mottle = self.noise.fbm(p * Vec3::new(1.3, 1.9, 1.3), 3);
        let tone = Vec3::ONE + Vec3::new(0.14, 0.02, -0.14) * warmth + Vec3::splat(0.27 * mottle);
        tone * self.damp(p, n) * self.runs(p, n) * self.dust(p, n)
    }

    /// Factor on the albedo of plaster: broader patches, ochre where the wash has gone.
    pub fn plaster(self, p: Vec3, n: Vec3) -> Vec3 {
        let patch = self
            .noise
            .fbm(p * Vec3::new(0.5, 0.7, 0.5) + Vec3::splat(9.1), 4);
        let worn = smoothstep(0.05, 0.55, patch);
        let wash = Vec3::ONE.lerp(Vec3::new(0.86, 0.72, 0.55), 0.75 * worn);
        let clouds = 1.0 + 0.10 * self.noise.fbm(p * 0.9, 3);
        wash * clouds * self.damp(p, n) * self.runs(p, n)
    }

    /// Factor on the albedo of what is walked on: paths worn pale, dirt at the edges.
    pub fn floor(self, p: Vec3) -> Vec3 {
        let dirt = self.noise.fbm(Vec3::new(p.x * 0.7, 6.3, p.z * 0.7), 4);
        let from_edge = HALF_WIDTH_M - 0.85 - p.z.abs();
        let corner = smoothstep(0.9, 0.0, from_edge.abs()) * (0.5 + 0.5 * dirt);
        let grey = 0.32 * smoothstep(-0.15, 0.55, dirt) + 0.30 * corner;
        Vec3::ONE.lerp(Vec3::new(0.42, 0.38, 0.33), grey.clamp(0.0, 1.0))
    }

    /// Water that rises in walls from the floor they stand on, with a ragged upper edge.
    fn damp(self, p: Vec3, n: Vec3) -> Vec3 {
        let upper = Storey::upper().floor_m;
        let floor = if p.y > upper - 0.02 {
            upper
        } else {
            -COURT_DROP_M
        };
        let ragged = self.noise.fbm(Vec3::new(p.x * 1.6, 0.4, p.z * 1.6), 3);
        let reach = 0.75 + 0.55 * ragged;
        let wet = smoothstep(reach, reach - 0.6, p.y - floor) * smoothstep(0.8, 0.4, n.y.abs());
        Vec3::ONE.lerp(Vec3::new(0.66, 0.64, 0.56), 0.95 * wet)
    }

    /// Dark runs below the ledges, where rain drips off.
    fn runs(self, p: Vec3, n: Vec3) -> Vec3 {
        let below = [Storey::lower(), Storey::upper()]
            .map(|storey| storey.top_m - p.y)
            .into_iter()
            .filter(|&drop| drop > -0.1)
            .fold(f32::MAX, f32::min);
        if below > 3.0 || n.y.abs() > 0.6 {
            return Vec3::ONE;
        }
        let column = Vec3::new(p.x * 2.4, p.y * 0.16, p.z * 2.4);
        let run = self.noise.fbm(column, 2);
        let length = 1.1 + 1.6 * self.noise.gradient(Vec3::new(p.x * 0.9, 2.5, p.z * 0.9));
        let wet = smoothstep(0.05, 0.5, run) * smoothstep(length.max(0.3), 0.0, below);
        Vec3::ONE.lerp(Vec3::new(0.50, 0.47, 0.42), 0.85 * wet)
    }

    /// What settles on ledges, and soot under soffits.
    fn dust(self, p: Vec3, n: Vec3) -> Vec3 {
        let patch = 0.6 + 0.4 * self.noise.fbm(p * 2.6, 2);
        let settled = smoothstep(0.6, 0.95, n.y) * patch;
        let soot = smoothstep(-0.5, -0.95, n.y) * patch;
        Vec3::ONE - Vec3::new(0.22, 0.24, 0.28) * settled - Vec3::new(0.18, 0.19, 0.20) * soot
    }
}
