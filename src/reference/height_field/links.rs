//! What every ray of every texel has met.

use glam::Vec3;
use rayon::prelude::*;

use super::directions::Directions;
use super::field::HeightField;
use super::march::Met;
use crate::reference::bent_cone::Opening;
use crate::reference::directions::{Weighting, frame_of};

/// A link to nothing: the sky.
const SKY: u32 = u32::MAX;

/// Texels whose rays one thread casts before it asks for more.
const TEXELS_AT_ONCE: usize = 64;

/// How links are cast.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct LinkSettings {
    /// Rays a texel, a power of two.
    pub rays: usize,
    /// Seed of their directions.
    pub seed: u64,
}

/// Where the rays of a field's texels end.
#[derive(Debug)]
pub struct Links {
    directions: Directions,
    rays: usize,
    texels: usize,
    kept: Kept,
}

/// Whether links are kept or found again for every bounce.
#[derive(Debug)]
enum Kept {
    /// Texel by texel, ray by ray: the texel met, or [`SKY`].
    All(Vec<u32>),
    /// Nothing but the field.
    None(HeightField),
}

impl Links {
    /// Bytes that the links of a field need where they are kept.
    #[must_use]
    pub fn bytes(texels: usize, rays: usize) -> u64 {
        4 * texels as u64 * rays as u64
    }

    /// Casts the rays of every texel over its whole hemisphere, and keeps where they end.
    /// `progress` is told how many texels are newly done.
    #[must_use]
    pub fn cast(
        field: &HeightField,
        settings: &LinkSettings,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Self {
        let rays = settings.rays.next_power_of_two();
        let directions = Directions::new(rays, settings.seed);
        let mut met = vec![SKY; field.len() * rays];
        met.par_chunks_mut(TEXELS_AT_ONCE * rays)
            .enumerate()
            .for_each(|(chunk, met)| {
                for (index, met) in met.chunks_exact_mut(rays).enumerate() {
                    let texel = chunk * TEXELS_AT_ONCE + index;
                    cast_one(field, &directions, texel, met);
                }
                progress((met.len() / rays) as u64);
            });
        Self {
            directions,
            rays,
            texels: field.len(),
            kept: Kept::All(met),
        }
    }

    /// The same links, cast again whenever they are asked for: no memory, and as many times the
    /// work as there are bounces.
    #[must_use]
    pub fn recast(field: &HeightField, settings: &LinkSettings) -> Self {
        let rays = settings.rays.next_power_of_two();
        Self {
            directions: Directions::new(rays, settings.seed),
            rays,
            texels: field.len(),
            kept: Kept::None(field.clone()),
        }
    }

    /// Rays a texel.
    #[must_use]
    pub fn rays(&self) -> usize {
        self.rays
    }

    /// Number of texels.
    #[must_use]
    pub fn texels(&self) -> usize {
        self.texels
    }

    /// The uniform openness of a texel, the share of its rays that meet nothing (the notes' α, 0
    /// closed to 1 open), and its direct irradiance under a sky of unit radiance, 0 to about π:
    /// (2π/N) Σ_free cosθ.
    #[must_use]
    pub fn sky(&self, texel: usize) -> (f32, f32) {
        self.with(texel, |met| {
            let rays = met.iter().zip(self.directions.cosines(texel));
            let free = rays.filter(|(met, _)| **met == SKY);
            let (count, sum) = free.fold((0_u32, 0.0_f32), |(count, sum), (_, cosine)| {
                (count + 1, sum + cosine)
            });
            let rays = self.rays as f32;
            (count as f32 / rays, std::f32::consts::TAU * sum / rays)
        })
    }

    /// What is open to a texel of the field that the links were cast on, by a weighting: from its rays that
    /// meet nothing. Axes are the field's own, z up.
    #[must_use]
    pub fn opening(&self, field: &HeightField, texel: usize, weighting: Weighting) -> Opening {
        let frame = frame_of(field.normal(texel % field.width(), texel / field.width()));
        self.with(texel, |met| {
            let rays = met.iter().zip(self.directions.turned(texel));
            let free = rays.filter(|(met, _)| **met == SKY);
            let sum = free.fold(Opening::CLOSED, |opening, (_, direction)| {
                // The rays are spread alike. By the cosine each counts by twice its own, of mean ½.
                let part = match weighting {
                    Weighting::Uniform => 1.0,
                    Weighting::Cosine => 2.0 * direction.z,
                };
                opening.with(frame * direction, part)
            });
            sum.scaled(1.0 / self.rays as f32)
        })
    }

    /// Gathers what a texel's neighbours send along its links: (2/N) Σ_blocked sent(x′) cosθ, with
    /// `sent` the irradiance times the albedo.
    #[must_use]
    pub fn gathered(&self, texel: usize, sent: &[f32]) -> f32 {
        self.with(texel, |met| {
            let rays = met.iter().zip(self.directions.cosines(texel));
            let blocked = rays.filter(|(met, _)| **met != SKY);
            let sum: f32 = blocked
                .map(|(met, cosine)| sent[*met as usize] * cosine)
                .sum();
            2.0 * sum / self.rays as f32
        })
    }

    fn with<T>(&self, texel: usize, read: impl FnOnce(&[u32]) -> T) -> T {
        match &self.kept {
            Kept::All(met) => read(&met[texel * self.rays..(texel + 1) * self.rays]),
            Kept::None(field) => {
                let mut met = vec![SKY; self.rays];
                cast_one(field, &self.directions, texel, &mut met);
                read(&met)
            }
        }
    }
}

fn cast_one(field: &HeightField, directions: &Directions, texel: usize, met: &mut [u32]) {
    let (x, y) = (texel % field.width(), texel / field.width());
    let frame = frame_of(field.normal(x, y));
    for (met, direction) in met.iter_mut().zip(directions.turned(texel)) {
        let direction: Vec3 = frame * direction;
        *met = match field.meets((x, y), direction) {
            Met::Sky => SKY,
            Met::Texel(other) => other,
        };
    }
}
