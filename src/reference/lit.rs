//! The light that an environment sends to points past whatever surrounds them: rays that meet nothing look
//! it up. From the same rays what is open to each point, so that both can be compared.

use glam::Vec3;
use rand_chacha::rand_core::Rng;
use rayon::prelude::*;

use super::bent_cone::Opening;
use super::bright::BrightDirections;
use super::directions::{Weighting, frame_of};
use super::occlusion::Surroundings;
use super::sobol::{Scramble, Sobol};
use crate::scene::Environment;
use crate::scene::environment::Irradiance;
use crate::seed;

/// Independently scrambled series of rays, whose spread tells the error.
const REPLICATES: usize = 16;

/// Points whose rays one thread traces before it asks for more.
const POINTS_AT_ONCE: usize = 64;

/// Rec. 709 luminance of linear RGB.
#[must_use]
pub fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// The light of one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lit {
    /// Irradiance of the environment itself, linear RGB: rays by the cosine and rays by the
    /// environment's brightness, each weighed by how dense both lie about it (Veach and Guibas 1995, the
    /// balance heuristic), as rays by the cosine alone miss lamps.
    pub irradiance: Vec3,
    /// Standard error of its luminance.
    pub standard_error: f32,
    /// Irradiance of the environment's nine coefficients, past the same surroundings: what is left of the
    /// error if the open directions are known one by one.
    pub of_nine: Vec3,
    /// What is open, by the cosine.
    pub cosine: Opening,
    /// What is open, all directions alike.
    pub uniform: Opening,
}

/// Light at every point by `rays` directions by the cosine, as many by the environment's brightness, and as
/// many all alike (rounded up to 16 times a power of two); `None` where there is no surface. Depends on nothing but surroundings,
/// environment, rays and seed. `progress` is told how many points are newly done.
#[must_use]
pub fn light<S: Surroundings>(
    surroundings: &S,
    environment: &Environment,
    (rays, seed): (u32, u64),
    progress: &(dyn Fn(u64) + Sync),
) -> Vec<Option<Lit>> {
    let points = (rays as usize).div_ceil(REPLICATES).next_power_of_two();
    let tracer = Tracer {
        sobol: Sobol::new(points),
        base: seed::generator(seed, "reference-light", 0).next_u64(),
        nine: environment.irradiance(),
        bright: BrightDirections::new(environment),
        environment,
    };
    let mut found = vec![None; surroundings.len()];
    found
        .par_chunks_mut(POINTS_AT_ONCE)
        .enumerate()
        .for_each(|(chunk, found)| {
            for (index, lit) in found.iter_mut().enumerate() {
                *lit = tracer.point(surroundings, chunk * POINTS_AT_ONCE + index);
            }
            progress(found.len() as u64);
        });
    found
}

struct Tracer<'a> {
    sobol: Sobol,
    base: u64,
    nine: Irradiance,
    bright: Option<BrightDirections<'a>>,
    environment: &'a Environment,
}

impl Tracer<'_> {
    fn point<S: Surroundings>(&self, surroundings: &S, point: usize) -> Option<Lit> {
        let (start, normal) = surroundings.start(point)?;
        let frame = frame_of(normal);
        let part = 1.0 / (REPLICATES * self.sobol.len()) as f32;
        let mut openings = [Opening::CLOSED; 2];
        let mut of_nine = Vec3::ZERO;
        let mut sums = [Vec3::ZERO; REPLICATES];
        for (replicate, sum) in sums.iter_mut().enumerate() {
            let scramble = Scramble::new(self.base, point as u64, replicate as u64);
            for index in 0..self.sobol.len() {
                let place = self.sobol.point(index, scramble);
                let weightings = [Weighting::Cosine, Weighting::Uniform];
                for (opening, weighting) in openings.iter_mut().zip(weightings) {
                    let direction = frame * weighting.direction(place);
                    if surroundings.is_blocked(&start, direction, f32::INFINITY) {
                        continue;
                    }
                    *opening = opening.with(direction, part);
                    if weighting == Weighting::Cosine {
                        *sum += self.arriving(direction, normal);
                        of_nine += self.nine.radiance(direction);
                    }
                }
            }
            *sum += self.by_brightness(surroundings, (&start, normal), (point, replicate));
        }
        let per_replicate = 1.0 / self.sobol.len() as f32;
        let means = sums.map(|sum| sum * per_replicate);
        let irradiance = means.iter().sum::<Vec3>() / REPLICATES as f32;
        let spread = (means.iter())
            .map(|mean| luminance(*mean - irradiance).powi(2))
            .sum::<f32>();
        let count = REPLICATES as f32;
        Some(Lit {
            irradiance,
            standard_error: (spread / (count - 1.0) / count).sqrt(),
            of_nine: (of_nine * (std::f32::consts::PI * part)).max(Vec3::ZERO),
            cosine: openings[0],
            uniform: openings[1],
        })
    }

    /// The light along a free ray over the density of all rays about it.
    fn arriving(&self, direction: Vec3, normal: Vec3) -> Vec3 {
        let cosine = direction.dot(normal).max(0.0);
        let by_brightness = (self.bright.as_ref()).map_or(0.0, |bright| bright.density(direction));
        let density = cosine / std::f32::consts::PI + by_brightness;
        self.environment.radiance(direction) * (cosine / density.max(1e-12))
    }

    /// The sum of what arrives along a replicate's rays by brightness.
    fn by_brightness<S: Surroundings>(
        &self,
        surroundings: &S,
        (start, normal): (&S::Start, Vec3),
        (point, replicate): (usize, usize),
    ) -> Vec3 {
        let Some(bright) = &self.bright else {
            return Vec3::ZERO;
        };
        let scramble = Scramble::new(self.base, point as u64, (REPLICATES + replicate) as u64);
        (0..self.sobol.len())
            .map(|index| bright.direction(self.sobol.point(index, scramble)))
            .filter(|direction| direction.dot(normal) > 0.0)
            .filter(|direction| !surroundings.is_blocked(start, *direction, f32::INFINITY))
            .map(|direction| self.arriving(direction, normal))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;
    use crate::reference::{RayTraced, SceneBvh, SurfacePoint};
    use crate::scene::environment::RadianceMap;
    use crate::scene::primitives::{cuboid, of_one_material};
    use crate::scene::{Geometry, Material};

    /// A floor's point at the foot of an endless wall that stands towards −x, and one in the open.
    fn beside_a_wall() -> (Geometry, Vec<Option<SurfacePoint>>) {
        let low = Vec3::new(-1.0, -10.0, -1e4);
        let wall = cuboid("wall", low, Vec3::new(0.0, 1e4, 1e4));
        let at = |x: f32| {
            Some(SurfacePoint {
                position_m: Vec3::new(x, 0.0, 0.0),
                normal: Vec3::Y,
                geometric_normal: Vec3::Y,
                error_m: 0.0,
                triangle: None,
            })
        };
        let points = vec![at(0.01), None, at(-1e3)];
        (of_one_material(Material::default(), vec![wall]), points)
    }

    #[test]
    fn a_wall_takes_half_of_the_light_and_bends_what_is_open_by_its_known_angle() {
        let (geometry, points) = beside_a_wall();
        let bvh = SceneBvh::new(&geometry);
        let surroundings = RayTraced::new(&bvh, points);
        let environment = Environment::from_map(RadianceMap::from_fn(32, |_| Vec3::splat(2.0)));
        let lit = light(&surroundings, &environment, (4096, 7), &|_| {});
        assert!(lit[1].is_none());
        let foot = lit[0].unwrap();
        assert!((foot.irradiance.x - PI).abs() < 0.01, "{foot:?}");
        assert!((foot.of_nine.x - PI).abs() < 0.02, "{foot:?}");
        assert!(foot.standard_error < 0.01);
        for (opening, weighting, tangent) in [
            (foot.uniform, Weighting::Uniform, 1.0),
            (foot.cosine, Weighting::Cosine, 2.0 / PI),
        ] {
            let direction = opening.cone(weighting).unwrap().direction;
            let leans = direction.x.atan2(direction.y);
            assert!((leans - f32::atan(tangent)).abs() < 0.01, "{direction}");
            assert!((opening.share - 0.5).abs() < 5e-3);
        }
        let far = light(&surroundings, &environment, (4096, 7), &|_| {});
        assert_eq!(far, lit, "the same rays again");
    }
}
