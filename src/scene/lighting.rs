//! How a scene is lit: one of the variants (validity levels) of its config.

use glam::Vec3;

use super::Environment;
use super::geometry::ModelLights;

/// Light from everywhere, the part that occlusion takes away.
#[derive(Debug, Clone, PartialEq)]
pub enum Ambient {
    /// The same radiance from every direction (thesis eq. 5, L_A), linear RGB.
    Constant(Vec3),
    /// Irradiance of the scene's environment.
    Environment,
}

/// What stands where there is no surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// One linear RGB colour.
    Colour(Vec3),
    /// The environment's own radiance.
    Environment,
}

/// A directional light.
#[derive(Debug, Clone, PartialEq)]
pub struct Sun {
    /// Unit vector towards the light.
    pub towards: Vec3,
    /// Linear RGB irradiance on a surface that faces it.
    pub irradiance: Vec3,
    /// Whether surfaces cast shadows.
    pub casts_shadows: bool,
}

/// A light from one point, all round or in a cone.
#[derive(Debug, Clone, PartialEq)]
pub struct PointLight {
    /// Where it is, metres.
    pub position_m: Vec3,
    /// Linear RGB radiant intensity: irradiance on a surface that faces it at 1 m.
    pub intensity: Vec3,
    /// For a spot light, where it shines; `None` shines all round.
    pub cone: Option<Cone>,
}

/// The cone of a spot light, with the smooth edge of `KHR_lights_punctual`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Unit vector from the light along the axis.
    pub along: Vec3,
    /// Half angle within which the light is whole, radians.
    pub inner_rad: f32,
    /// Half angle beyond which there is none, radians; more than `inner_rad`.
    pub outer_rad: f32,
}

/// How linear radiance becomes a value to display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToneMap {
    /// Values above 1 are clipped; for scenes that have none.
    None,
    /// Reinhard et al. 2002, eq. 4, on luminance; `white` is the luminance that
    /// becomes 1.
    ReinhardExtended {
        /// Linear luminance that maps to display white.
        white: f32,
    },
    /// Narkowicz 2016's rational fit of the ACES filmic curve, a channel at a time.
    Aces,
}

/// One lighting variant of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    /// The ambient term.
    pub ambient: Ambient,
    /// Where no surface is.
    pub background: Background,
    /// Whether surfaces mirror the environment, by their roughness.
    pub reflections: bool,
    /// A directional light, if there is one.
    pub sun: Option<Sun>,
    /// Lights from points.
    pub points: Vec<PointLight>,
    /// What the model's own lights are multiplied by; `None` leaves them dark.
    pub model_lights: Option<f32>,
    /// Light from all round; present where `ambient` or `background` use it.
    pub environment: Option<Environment>,
    /// Exposure in stops: radiance is multiplied by 2 to this power before the tone map.
    pub exposure_ev: f32,
    /// The tone map.
    pub tone_map: ToneMap,
}

impl ToneMap {
    /// Linear radiance, exposed, to a linear value to display; what lies above 1 is for the
    /// caller to clip. The same curves as `render/shaders/tone_map/`.
    #[must_use]
    pub fn apply(self, radiance: Vec3) -> Vec3 {
        match self {
            Self::None => radiance,
            Self::ReinhardExtended { white } => {
                let luminance = radiance.dot(Vec3::new(0.2126, 0.7152, 0.0722));
                radiance * ((1.0 + luminance / (white * white)) / (1.0 + luminance))
            }
            Self::Aces => {
                let x = radiance;
                (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
            }
        }
    }
}

impl std::fmt::Display for ToneMap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::ReinhardExtended { white } => write!(f, "reinhard-extended, white {white}"),
            Self::Aces => f.write_str("aces"),
        }
    }
}

impl Lighting {
    /// The same radiance from everywhere and behind everything, and nothing else: the low level of
    /// validity of 2010.
    #[must_use]
    pub fn constant(radiance: Vec3) -> Self {
        Self {
            ambient: Ambient::Constant(radiance),
            background: Background::Colour(radiance),
            reflections: false,
            sun: None,
            points: Vec::new(),
            model_lights: None,
            environment: None,
            exposure_ev: 0.0,
            tone_map: ToneMap::None,
        }
    }

    /// This lighting with the model's own lights in it, in the scene's units, where the
    /// variant asks for them.
    ///
    /// A scene has one sun: the variant's own, or else the brightest of the model's. What
    /// comes back asks for no model's lights any more.
    #[must_use]
    pub fn with_model_lights(&self, lights: &ModelLights) -> Self {
        let mut lit = self.clone();
        let Some(factor) = lit.model_lights.take() else {
            return lit;
        };
        let brightness = |sun: &Sun| sun.irradiance.element_sum();
        let brightest = lights
            .suns
            .iter()
            .max_by(|a, b| brightness(a).total_cmp(&brightness(b)));
        lit.sun = lit.sun.or_else(|| {
            brightest.map(|sun| Sun {
                irradiance: sun.irradiance * factor,
                ..sun.clone()
            })
        });
        lit.points
            .extend(lights.points.iter().map(|light| PointLight {
                intensity: light.intensity * factor,
                ..light.clone()
            }));
        lit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reinhard's white becomes 1 and small values stay; both curves rise.
    #[test]
    fn tone_maps_have_their_fixed_points() {
        let reinhard = ToneMap::ReinhardExtended { white: 4.0 };
        assert!((reinhard.apply(Vec3::splat(4.0)) - Vec3::ONE).length() < 1e-5);
        assert!((reinhard.apply(Vec3::splat(1e-3)).x - 1e-3).abs() < 2e-6);
        // Narkowicz's fit passes 0.8 at an input of 1 (2.54 / 3.16).
        assert!((ToneMap::Aces.apply(Vec3::ONE).x - 2.54 / 3.16).abs() < 1e-6);
        for map in [reinhard, ToneMap::Aces] {
            let values: Vec<f32> = (0..50)
                .map(|i| map.apply(Vec3::splat(i as f32 * 0.1)).y)
                .collect();
            assert!(values.is_sorted_by(|a, b| a < b), "{map}");
        }
    }

    fn sun(irradiance: f32) -> Sun {
        Sun {
            towards: Vec3::Y,
            irradiance: Vec3::splat(irradiance),
            casts_shadows: true,
        }
    }

    #[test]
    fn model_lights_shine_only_where_they_are_asked_for() {
        let lights = ModelLights {
            suns: vec![sun(100.0), sun(300.0), sun(200.0)],
            points: vec![PointLight {
                position_m: Vec3::ONE,
                intensity: Vec3::new(50.0, 100.0, 0.0),
                cone: None,
            }],
        };
        let dark = Lighting::constant(Vec3::ONE);
        assert_eq!(dark.with_model_lights(&lights), dark);
        let asking = Lighting {
            model_lights: Some(0.01),
            ..dark
        };
        let lit = asking.with_model_lights(&lights);
        assert_eq!(lit.sun, Some(sun(3.0)));
        assert_eq!(lit.points[0].intensity, Vec3::new(0.5, 1.0, 0.0));
        let own = Lighting {
            sun: Some(sun(7.0)),
            ..asking
        };
        assert_eq!(own.with_model_lights(&lights).sun, Some(sun(7.0)));
    }
}
