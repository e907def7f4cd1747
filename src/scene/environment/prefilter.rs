//! The environment as a rough surface reflects it: one map a level of roughness.
//!
//! The first sum of Karis 2013, "Real Shading in Unreal Engine 4" (the second is
//! [`crate::scene::brdf::EnvironmentTable`]): radiance averaged over GGX half vectors
//! about the direction of a mirror's reflection, with view and normal along it, each sample
//! weighted by its cosine. Samples are a fixed Hammersley set, read from smaller copies of the map
//! the thinner they are sown (Křivánek and Colbert 2008, "Real-time Shading with Filtered Importance
//! Sampling"), so that a few give a smooth answer and a bright spot does not speckle.

use glam::Vec3;

use super::RadianceMap;
use crate::scene::brdf;
use crate::scene::modelling::math;

/// Number of levels: roughness 0, 0.2, … 1.
pub const LEVELS: usize = 6;

/// Rows of the first level; each further level has half as many.
pub const HEIGHT_PX: usize = 256;

/// Samples of the second level; each further level, with a quarter of the texels and a wider lobe, has twice
/// as many.
const SAMPLES: u32 = 64;

/// The roughness that a level is for.
#[must_use]
pub fn roughness(level: usize) -> f32 {
    level as f32 / (LEVELS - 1) as f32
}

/// The map at every level. The first is the map itself at most [`HEIGHT_PX`] rows high; each has half the
/// columns and rows of the one before (as the mips of a texture), which is more than its blur needs.
#[must_use]
pub fn levels(map: &RadianceMap) -> Vec<RadianceMap> {
    let mut first = map.clone();
    while first.height_px() > HEIGHT_PX {
        first = first.halved();
    }
    let mut smaller = vec![first];
    while let Some(last) = smaller.last().filter(|last| last.height_px() > 2) {
        smaller.push(last.halved());
    }
    let mut levels = vec![smaller[0].clone()];
    for level in 1..LEVELS {
        let height_px = (smaller[0].height_px() >> level).max(1);
        let lobe = lobe(roughness(level), SAMPLES << (level - 1), &smaller[0]);
        levels.push(RadianceMap::from_fn(height_px, |reflected| {
            average(&lobe, &smaller, reflected)
        }));
    }
    levels
}

/// One direction of a lobe about +Z.
struct Sample {
    towards: Vec3,
    weight: f32,
    /// How many times the map it reads is halved; between two, both are read.
    halvings: f32,
}

fn lobe(roughness: f32, count: u32, map: &RadianceMap) -> Vec<Sample> {
    let texel = 4.0 * std::f32::consts::PI / (map.width_px() * map.height_px()) as f32;
    let samples = (0..count).filter_map(|i| {
        let half = brdf::sample_half_vector(brdf::hammersley(i, count), roughness);
        let towards = 2.0 * half.z * half - Vec3::Z;
        (towards.z > 0.0).then(|| {
            // With view = normal the density of reflected directions is D/4.
            let density = brdf::distribution(half.z, roughness) / 4.0;
            let share = 1.0 / (count as f32 * density.max(1e-6));
            Sample {
                towards,
                weight: towards.z,
                halvings: (0.5 * (share / texel).log2()).max(0.0),
            }
        })
    });
    let mut samples: Vec<Sample> = samples.collect();
    let total: f32 = samples.iter().map(|sample| sample.weight).sum();
    for sample in &mut samples {
        sample.weight /= total;
    }
    samples
}

fn average(lobe: &[Sample], smaller: &[RadianceMap], reflected: Vec3) -> Vec3 {
    let frame = math::Frame::along(Vec3::ZERO, reflected, math::perpendicular(reflected));
    let (x, y, z) = (frame.axes.x_axis, frame.axes.z_axis, frame.axes.y_axis);
    lobe.iter()
        .map(|sample| {
            let towards = x * sample.towards.x + y * sample.towards.y + z * sample.towards.z;
            let last = (smaller.len() - 1) as f32;
            let halvings = sample.halvings.min(last);
            let fine = smaller[halvings as usize].at(towards);
            let coarse = smaller[(halvings as usize + 1).min(last as usize)].at(towards);
            fine.lerp(coarse, halvings.fract()) * sample.weight
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::environment::Sky;

    #[test]
    fn constant_light_stays_constant_at_every_level() {
        let map = RadianceMap::from_fn(64, |_| Vec3::new(0.5, 1.0, 2.0));
        let levels = levels(&map);
        assert_eq!(levels.len(), LEVELS);
        for level in levels {
            for texel in level.texels() {
                let off = (*texel - Vec3::new(0.5, 1.0, 2.0)).abs().max_element();
                assert!(off < 1e-5, "{texel}");
            }
        }
    }

    #[test]
    fn a_mirror_sees_the_map() {
        let map = RadianceMap::from_fn(32, |d| d.abs());
        assert_eq!(levels(&map)[0], map);
    }

    /// Blurring moves light and makes none: the mean over the sphere stays.
    #[test]
    fn every_level_keeps_the_energy() {
        let map = Sky::default().map();
        let mean = map.mean();
        for (level, filtered) in levels(&map).into_iter().enumerate() {
            let ratio = filtered.mean() / mean;
            assert!(
                (ratio - 1.0).abs().max_element() < 0.02,
                "level {level}: {ratio}"
            );
        }
    }

    /// A hemisphere of light seen by a lobe about its pole is whole; about its horizon, half.
    #[test]
    fn half_the_lobe_sees_half_the_light() {
        let map = RadianceMap::from_fn(
            HEIGHT_PX,
            |d| if d.y > 0.0 { Vec3::ONE } else { Vec3::ZERO },
        );
        for (level, filtered) in levels(&map).into_iter().enumerate() {
            let at_horizon = filtered.at(Vec3::X).x;
            assert!(
                (at_horizon - 0.5).abs() < 0.05,
                "level {level}: {at_horizon}"
            );
            let (up, down) = (filtered.at(Vec3::Y).x, filtered.at(Vec3::NEG_Y).x);
            // Within the width of a texel and of the copies that wide lobes read.
            assert!(up > 0.97 && down < 0.03, "level {level}: {up} {down}");
        }
    }

    /// Each level is blurrier than the one before: a small bright patch spreads.
    #[test]
    fn roughness_spreads_a_highlight() {
        let patch = Vec3::new(0.3, 0.5, -0.8).normalize();
        let map = RadianceMap::from_fn(128, |d| Vec3::splat(f32::from(d.dot(patch) > 0.98)));
        let peaks: Vec<f32> = levels(&map).iter().map(|level| level.at(patch).x).collect();
        assert!(
            peaks.windows(2).all(|pair| pair[1] < pair[0] + 1e-4),
            "{peaks:?}"
        );
        assert!(peaks[LEVELS - 1] < 0.2, "{peaks:?}");
    }
}
