//! Light that reaches a point over any number of diffuse bounces, from a sky of the same radiance
//! everywhere, by following paths backwards through the scene.
//!
//! ```text
//! E/E₀ = Σ_k E_k/E₀,   E_k = the light that arrives after k bounces, each times the albedo it meets
//! ```
//!
//! Directions are spread by the cosine, so that a path that reaches the sky carries the product of
//! the albedos on its way and nothing else; the mean over paths is E/E₀. Paths that end otherwise
//! carry nothing. That is exact but for two things: a path that has made the most bounces that are
//! allowed is given up ([`InterReflections::given_up`] bounds what that loses), and a surface that was
//! drawn where the scene has none sends nothing back to itself.

use glam::Vec3;
use rand_chacha::rand_core::Rng;
use rayon::prelude::*;

use super::ReferenceError;
use super::albedo::Albedos;
use super::directions::{Weighting, frame_of};
use super::occlusion::{POINTS_AT_ONCE, REPLICATES, points_a_replicate, summary};
use super::ray_traced::{RayTraced, SurfacePoint};
use super::sobol::{Scramble, Sobol, mix};
use crate::seed;

/// Share of the light below which paths are drawn by lot: of those that carry x of it, x goes on
/// and carries this much. What is expected of a path stays the same.
const LOT_BELOW: f32 = 0.125;

/// How far light is followed, and how well.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct InterReflectionSettings {
    /// Standard error at which a point has had paths enough, in each channel.
    pub error: f64,
    /// Paths a point has at least; rounded up to a power of two, 64 at least.
    pub min_paths: u32,
    /// Paths a point has at most; rounded up likewise.
    pub max_paths: u32,
    /// Bounces after which a path is given up.
    pub bounces: u32,
    /// Seed of the directions.
    pub seed: u64,
}

impl InterReflectionSettings {
    /// To a standard error of 0.005, with at most 16,384 paths a point and 20 bounces.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            error: 0.005,
            min_paths: 64,
            max_paths: 16_384,
            bounces: 20,
            seed,
        }
    }

    /// Checks that every setting is in its range.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), ReferenceError> {
        let (setting, found, allowed) = if !(1e-5..=0.5).contains(&self.error) {
            ("error", self.error.to_string(), "0.00001 to 0.5")
        } else if !(64..=1 << 24).contains(&self.max_paths) {
            ("max-paths", self.max_paths.to_string(), "64 to 16777216")
        } else if self.min_paths > self.max_paths {
            (
                "min-paths",
                self.min_paths.to_string(),
                "no more than max-paths",
            )
        } else if self.bounces > 1000 {
            ("bounces", self.bounces.to_string(), "0 to 1000")
        } else {
            return Ok(());
        };
        Err(ReferenceError {
            setting,
            found,
            allowed,
        })
    }
}

/// What arrives at every point.
#[derive(Debug, Clone, PartialEq)]
pub struct InterReflections {
    /// E/E₀ in red, green and blue, 0 (dark) to 1 (as in the open); 1 where there is no surface.
    pub irradiance: Vec<[f32; 3]>,
    /// Its standard errors; 0 where there is no surface.
    pub standard_error: Vec<[f32; 3]>,
    /// What of it arrives without a bounce, the same in every channel: cosine-weighted openness k_A,
    /// along the same paths; 1 where there is no surface.
    pub direct: Vec<f32>,
    /// Share of the light that a point's paths still carried when they were given up, of the most
    /// in any channel: so much E/E₀ may be too low, and no more. 0 where there is no surface.
    pub given_up: Vec<f32>,
    /// Paths in all.
    pub paths: u64,
    /// Points with a surface.
    pub surfaces: u64,
}

/// What was found at one point.
#[derive(Debug, Clone, Copy)]
struct Found {
    irradiance: [f64; 3],
    standard_error: [f64; 3],
    direct: f64,
    given_up: f64,
    paths: u64,
}

/// Follows light to every point, on all cores of the current thread pool. The result depends on
/// nothing but points, albedos and settings, the number of threads included. `progress` is told how
/// many points are newly done.
///
/// # Errors
/// [`ReferenceError`] for settings out of range.
pub fn follow(
    points: &RayTraced<'_>,
    albedos: &Albedos<'_>,
    settings: &InterReflectionSettings,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<InterReflections, ReferenceError> {
    settings.check()?;
    let follower = Follower::new(points, albedos, settings);
    let mut found = vec![None; points.points().len()];
    found
        .par_chunks_mut(POINTS_AT_ONCE)
        .enumerate()
        .for_each(|(chunk, found)| {
            for (index, here) in found.iter_mut().enumerate() {
                *here = follower.point(chunk * POINTS_AT_ONCE + index);
            }
            progress(found.len() as u64);
        });
    let colours = |of: fn(&Found) -> [f64; 3], without: f32| -> Vec<[f32; 3]> {
        let all = found.iter().map(|found| found.as_ref().map(of));
        all.map(|colour| colour.map_or([without; 3], |colour| colour.map(|c| c as f32)))
            .collect()
    };
    let numbers = |of: fn(&Found) -> f64, without: f32| -> Vec<f32> {
        let all = found.iter().map(|found| found.as_ref().map(of));
        all.map(|number| number.map_or(without, |number| number as f32))
            .collect()
    };
    Ok(InterReflections {
        irradiance: colours(|found| found.irradiance, 1.0),
        standard_error: colours(|found| found.standard_error, 0.0),
        direct: numbers(|found| found.direct, 1.0),
        given_up: numbers(|found| found.given_up, 0.0),
        paths: found.iter().flatten().map(|found| found.paths).sum(),
        surfaces: found.iter().flatten().count() as u64,
    })
}

/// What the paths of all points share.
struct Follower<'a> {
    points: &'a RayTraced<'a>,
    albedos: &'a Albedos<'a>,
    settings: &'a InterReflectionSettings,
    sobol: Sobol,
    /// What every point's first directions are derived from.
    base: u64,
    /// And what the rest of its paths.
    lots_base: u64,
}

/// Where a path ended.
enum End {
    /// In the sky, after so many bounces and with what is left of the light.
    Sky { bounces: u32, light: Vec3 },
    /// Nowhere, by lot or by black surfaces.
    Nowhere,
    /// It was given up with this light left.
    GivenUp { light: Vec3 },
}

/// Sums of the replicates.
#[derive(Default)]
struct Sums {
    irradiance: [[f64; REPLICATES]; 3],
    direct: f64,
    given_up: Vec3,
}

impl Sums {
    fn add(&mut self, replicate: usize, end: &End) {
        match end {
            End::Sky { bounces, light } => {
                for (channel, sums) in self.irradiance.iter_mut().enumerate() {
                    sums[replicate] += f64::from(light[channel]);
                }
                self.direct += f64::from(u8::from(*bounces == 0));
            }
            End::Nowhere => {}
            End::GivenUp { light } => self.given_up += *light,
        }
    }

    fn found(&self, points: usize) -> Found {
        let paths = (REPLICATES * points) as u64;
        let channels = [0, 1, 2].map(|channel| summary(&self.irradiance[channel], points));
        Found {
            irradiance: channels.map(|channel| channel.value),
            standard_error: channels.map(|channel| channel.standard_error),
            direct: self.direct / paths as f64,
            given_up: f64::from(self.given_up.max_element()) / paths as f64,
            paths,
        }
    }
}

impl<'a> Follower<'a> {
    fn new(
        points: &'a RayTraced<'a>,
        albedos: &'a Albedos<'a>,
        settings: &'a InterReflectionSettings,
    ) -> Self {
        let mut rng = seed::generator(settings.seed, "reference-inter-reflection", 0);
        Self {
            points,
            albedos,
            settings,
            sobol: Sobol::new(points_a_replicate(settings.max_paths)),
            base: rng.next_u64(),
            lots_base: rng.next_u64(),
        }
    }

    /// Doubles the paths of every replicate until the error is small enough.
    fn point(&self, point: usize) -> Option<Found> {
        let start = self.points.points()[point].as_ref()?;
        let frame = frame_of(start.normal);
        let scrambles: [Scramble; REPLICATES] =
            std::array::from_fn(|k| Scramble::new(self.base, point as u64, k as u64));
        let mut sums = Sums::default();
        let least = points_a_replicate(self.settings.min_paths);
        let (mut done, mut target) = (0, least.min(self.sobol.len()));
        loop {
            for (replicate, &scramble) in scrambles.iter().enumerate() {
                for index in done..target {
                    let place = self.sobol.point(index, scramble);
                    let direction = frame * Weighting::Cosine.direction(place);
                    let series = (point as u64) << 8 | replicate as u64;
                    let mut lots = Lots::new(self.lots_base, series, index as u64);
                    sums.add(replicate, &self.path(start, direction, &mut lots));
                }
            }
            done = target;
            let found = sums.found(done);
            let error = found.standard_error.into_iter().fold(0.0, f64::max);
            if error <= self.settings.error || done == self.sobol.len() {
                return Some(found);
            }
            target = 2 * done;
        }
    }

    /// Follows one path from a point to where it ends.
    fn path(&self, start: &SurfacePoint, mut direction: Vec3, lots: &mut Lots) -> End {
        let bvh = self.points.bvh();
        let (mut at, mut light) = (*start, Vec3::ONE);
        for bounces in 0.. {
            // A direction of a shading normal's hemisphere may point below the surface itself, which
            // then is what it meets: at once.
            if direction.dot(at.geometric_normal) > 0.0 {
                let origin_m = at.position_m + at.geometric_normal * at.error_m;
                let Some(hit) = bvh.nearest(origin_m, direction, f32::INFINITY) else {
                    return End::Sky { bounces, light };
                };
                let (eye_m, along) = (origin_m.as_dvec3(), direction.as_dvec3());
                let Some(met) = SurfacePoint::met(&hit, eye_m, along, 0.0, f64::INFINITY) else {
                    return End::Nowhere;
                };
                at = met;
            }
            let Some(triangle) = at.triangle else {
                return End::Nowhere;
            };
            light *= self.albedos.at(triangle, at.position_m);
            let most = light.max_element();
            if most <= 0.0 {
                return End::Nowhere;
            }
            if bounces == self.settings.bounces {
                return End::GivenUp { light };
            }
            if most < LOT_BELOW {
                if lots.next() * LOT_BELOW >= most {
                    return End::Nowhere;
                }
                light *= LOT_BELOW / most;
            }
            let place = [lots.next(), lots.next()];
            direction = frame_of(at.geometric_normal) * Weighting::Cosine.direction(place);
        }
        End::Nowhere
    }
}

/// The random numbers of one path beyond its first direction: a counter through the finaliser of
/// `SplitMix64`, from a start of its own.
struct Lots {
    state: u64,
}

impl Lots {
    fn new(base: u64, series: u64, index: u64) -> Self {
        Self {
            state: mix(mix(base ^ mix(series)).wrapping_add(index)),
        }
    }

    /// Even in [0, 1).
    fn next(&mut self) -> f32 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mix(self.state) >> 40) as f32 / (1_u32 << 24) as f32
    }
}
