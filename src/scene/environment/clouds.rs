//! Soft cumulus before a sky: a picture of clouds, not a simulation of them.
//!
//! A thin spherical shell of fractal noise, opaque where the noise is above a threshold, lit by the
//! sun through its own thickness (Beer's law along one step towards the sun) and by the
//! sky. What matters for the experiment is that the background is believable, and
//! that its light is part of the same map that lights the scene.

use glam::Vec3;

use super::sky::{ClearSky, Sky};
use crate::scene::modelling::math::{self, smoothstep};
use crate::scene::modelling::noise::Noise;

/// Radius of the shell over its height: less than the Earth's, so that clouds near the horizon
/// crowd but do not shrink to lines.
const RADIUS: f32 = 40.0;

/// Features of the largest octave a unit of the shell's height.
const FREQUENCY: f32 = 0.55;

pub(super) struct Clouds {
    noise: Noise,
    threshold: f32,
    towards_sun: Vec3,
    sun: Vec3,
    sky: Vec3,
}

impl Clouds {
    pub(super) fn new(sky: &Sky, air: &ClearSky) -> Self {
        let sun = sky.sunlight();
        // The light of the sky on a cloud: the mean of a few directions well above the horizon.
        let ring = (0..8).map(|i| {
            let around = math::on_circle(i as f32 * std::f32::consts::FRAC_PI_4);
            air.radiance(Vec3::new(0.6 * around.x, 0.8, 0.6 * around.y))
        });
        Self {
            noise: Noise::new(sky.seed, "clouds", 0),
            // From above the noise's highest values to below its lowest.
            threshold: math::lerp(0.75, -0.75, sky.clouds),
            towards_sun: sun.towards,
            sun: sun.irradiance,
            sky: ring.sum::<Vec3>() / 8.0,
        }
    }

    /// The sky behind with the clouds before it.
    pub(super) fn over(&self, clear: Vec3, towards: Vec3) -> Vec3 {
        // Where the ray leaves a sphere of RADIUS + 1 round a centre RADIUS below the eye.
        let drop = RADIUS * towards.y;
        let distance = (drop * drop + 2.0 * RADIUS + 1.0).sqrt() - drop;
        let place = towards * distance * FREQUENCY;
        let thickness = self.thickness(place);
        if thickness <= 0.0 {
            return clear;
        }
        let shade = self.thickness(place + self.towards_sun * 0.35) + 0.4 * thickness;
        let from_sun = self.sun * math::exp(-1.6 * shade) * self.phase(towards);
        let own = from_sun + self.sky * (1.0 - 0.35 * thickness.min(1.0));
        let cover = 1.0 - math::exp(-4.0 * thickness);
        // Air between: far clouds take the colour of the horizon.
        let seen = math::exp(-0.05 * distance.max(1.0)) * smoothstep(0.0, 0.06, towards.y);
        clear.lerp(own, cover * seen)
    }

    /// 0 outside clouds, about 1 in their middle.
    fn thickness(&self, place: Vec3) -> f32 {
        let shape = self.noise.fbm(place, 5) * 1.1;
        smoothstep(self.threshold, self.threshold + 0.7, shape) * 1.2
    }

    /// Share of the sun's irradiance that becomes radiance: brighter towards the sun (forward
    /// scattering), the rest as from a white matte surface.
    fn phase(&self, towards: Vec3) -> f32 {
        let forward = math::pow(towards.dot(self.towards_sun).max(0.0), 6.0);
        (0.6 + 0.5 * forward) / std::f32::consts::PI
    }
}
