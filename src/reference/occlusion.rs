//! Occlusion at points, by as many rays as its error asks for.

use glam::{Mat3, Vec3};
use rand_chacha::rand_core::Rng;
use rayon::prelude::*;

use super::ReferenceError;
use super::directions::{Weighting, frame_of};
use super::sobol::{Scramble, Sobol};
use crate::seed;

/// Independently scrambled series of points that each estimate is the mean of. Their spread
/// tells the error, which the points of one low-discrepancy series cannot.
pub(super) const REPLICATES: usize = 16;

/// Points whose rays one thread traces before it asks for more.
pub(super) const POINTS_AT_ONCE: usize = 256;

/// What surrounds the points, and may block their rays.
pub trait Surroundings: Sync {
    /// Where the rays of a point start.
    type Start;

    /// Number of points.
    fn len(&self) -> usize;

    /// Whether there is no point.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The start of a point's rays, and its unit world-space normal for shading; `None` where
    /// there is no surface.
    fn start(&self, point: usize) -> Option<(Self::Start, Vec3)>;

    /// Whether anything is met within `reach_m` along a unit world-space direction.
    fn is_blocked(&self, start: &Self::Start, direction: Vec3, reach_m: f32) -> bool;

    /// The distance of the first that is met within `reach_m`, metres.
    fn nearest_m(&self, start: &Self::Start, direction: Vec3, reach_m: f32) -> Option<f32>;
}

/// What is estimated, and how well.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct OcclusionSettings {
    /// What directions count by.
    pub weighting: Weighting,
    /// `None`: visibility, v = 0 for whatever is met at any distance. Otherwise the obscurance
    /// of Zhukov & Iones 1998, v = ρ(t) = t / d_max for what is met at a distance t up to this
    /// one, metres, and nothing beyond it counts.
    pub d_max_m: Option<f32>,
    /// Standard error at which a point has had rays enough.
    pub error: f64,
    /// Rays a point has at least; rounded up to a power of two, 64 at least.
    pub min_rays: u32,
    /// Rays a point has at most; rounded up likewise.
    pub max_rays: u32,
    /// Seed of the directions.
    pub seed: u64,
}

impl OcclusionSettings {
    /// Cosine-weighted visibility to a standard error of 0.002, with at most 16,384 rays a point.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            weighting: Weighting::Cosine,
            d_max_m: None,
            error: 0.002,
            min_rays: 64,
            max_rays: 16_384,
            seed,
        }
    }

    /// Checks that every setting is in its range.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), ReferenceError> {
        let wrong = |setting, found: String, allowed| {
            Err(ReferenceError {
                setting,
                found,
                allowed,
            })
        };
        if !(1e-5..=0.5).contains(&self.error) {
            return wrong("error", self.error.to_string(), "0.00001 to 0.5");
        }
        if !(64..=1 << 24).contains(&self.max_rays) {
            return wrong("max-rays", self.max_rays.to_string(), "64 to 16777216");
        }
        if self.min_rays > self.max_rays {
            return wrong(
                "min-rays",
                self.min_rays.to_string(),
                "no more than max-rays",
            );
        }
        match self.d_max_m {
            Some(d_max_m) if !(d_max_m > 0.0 && d_max_m.is_finite()) => wrong(
                "distance-m",
                d_max_m.to_string(),
                "a distance above 0 metres",
            ),
            _ => Ok(()),
        }
    }
}

/// How many rays of each replicate make so many in all, a power of two.
pub(super) fn points_a_replicate(rays: u32) -> usize {
    (rays as usize)
        .div_ceil(REPLICATES)
        .next_power_of_two()
        .max(4)
}

/// Estimates at every point.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimates {
    /// The coefficient, 0 (closed) to 1 (open); 1 where there is no surface.
    pub occlusion: Vec<f32>,
    /// Its standard error; 0 where there is no surface.
    pub standard_error: Vec<f32>,
    /// Rays in all.
    pub rays: u64,
    /// Points with a surface.
    pub surfaces: u64,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Estimate {
    pub value: f64,
    pub standard_error: f64,
    pub rays: u64,
}

/// Estimates the occlusion at every point, on all cores of the current thread pool. The result
/// depends on nothing but surroundings and settings, the number of threads included.
/// `progress` is told how many points are newly done.
///
/// # Errors
/// [`ReferenceError`] for settings out of range.
pub fn estimate<S: Surroundings>(
    surroundings: &S,
    settings: &OcclusionSettings,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Estimates, ReferenceError> {
    settings.check()?;
    let sampler = Sampler::new(settings);
    let mut found = vec![None; surroundings.len()];
    found
        .par_chunks_mut(POINTS_AT_ONCE)
        .enumerate()
        .for_each(|(chunk, found)| {
            for (index, estimate) in found.iter_mut().enumerate() {
                *estimate = sampler.estimate(surroundings, chunk * POINTS_AT_ONCE + index);
            }
            progress(found.len() as u64);
        });
    let of = |number: fn(&Estimate) -> f64, without: f32| -> Vec<f32> {
        let numbers = found.iter().map(|estimate| estimate.as_ref().map(number));
        numbers
            .map(|number| number.map_or(without, |number| number as f32))
            .collect()
    };
    Ok(Estimates {
        occlusion: of(|estimate| estimate.value, 1.0),
        standard_error: of(|estimate| estimate.standard_error, 0.0),
        rays: found.iter().flatten().map(|estimate| estimate.rays).sum(),
        surfaces: found.iter().flatten().count() as u64,
    })
}

/// What the estimates of all points share.
struct Sampler<'a> {
    settings: &'a OcclusionSettings,
    sobol: Sobol,
    /// What every point's scrambling is derived from.
    base: u64,
}

impl<'a> Sampler<'a> {
    fn new(settings: &'a OcclusionSettings) -> Self {
        let most = points_a_replicate(settings.max_rays);
        Self {
            settings,
            sobol: Sobol::new(most),
            base: seed::generator(settings.seed, "reference-occlusion", 0).next_u64(),
        }
    }

    /// Doubles the rays of every replicate until the error is small enough.
    fn estimate<S: Surroundings>(&self, surroundings: &S, point: usize) -> Option<Estimate> {
        let (start, normal) = surroundings.start(point)?;
        let frame = frame_of(normal);
        let least = points_a_replicate(self.settings.min_rays);
        let scrambles: [Scramble; REPLICATES] =
            std::array::from_fn(|k| Scramble::new(self.base, point as u64, k as u64));
        let mut sums = [0.0_f64; REPLICATES];
        let (mut done, mut target) = (0, least.min(self.sobol.len()));
        loop {
            for (sum, &scramble) in sums.iter_mut().zip(&scrambles) {
                for index in done..target {
                    let place = self.sobol.point(index, scramble);
                    *sum += self.openness(surroundings, &start, &frame, place);
                }
            }
            done = target;
            let estimate = summary(&sums, done);
            if estimate.standard_error <= self.settings.error || done == self.sobol.len() {
                return Some(estimate);
            }
            target = 2 * done;
        }
    }

    /// v of one ray.
    #[inline]
    fn openness<S: Surroundings>(
        &self,
        surroundings: &S,
        start: &S::Start,
        frame: &Mat3,
        place: [f32; 2],
    ) -> f64 {
        let direction = *frame * self.settings.weighting.direction(place);
        match self.settings.d_max_m {
            None => f64::from(!surroundings.is_blocked(start, direction, f32::INFINITY)),
            Some(d_max_m) => surroundings
                .nearest_m(start, direction, d_max_m)
                .map_or(1.0, |met_m| f64::from(met_m / d_max_m).min(1.0)),
        }
    }
}

/// The mean of the replicates' means, and its standard error from their spread. With few rays
/// all replicates may agree by chance, so that the error is not below one ray's weight.
pub(super) fn summary(sums: &[f64; REPLICATES], points: usize) -> Estimate {
    let count = REPLICATES as f64;
    let means = sums.map(|sum| sum / points as f64);
    let value = means.iter().sum::<f64>() / count;
    let squares: f64 = means.iter().map(|mean| (mean - value).powi(2)).sum();
    let rays = (REPLICATES * points) as u64;
    Estimate {
        value,
        standard_error: (squares / (count - 1.0) / count)
            .sqrt()
            .max(1.0 / rays as f64),
        rays,
    }
}
