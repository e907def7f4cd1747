//! Light that comes from all round: radiance as a function of direction, however it was made.
//!
//! `docs/light.md` says what is modelled, from which source, and in which unit.

pub mod clouds;
pub mod file;
pub mod irradiance;
pub mod map;
pub mod prefilter;
pub mod sky;

use std::sync::{Arc, OnceLock};

use glam::Vec3;

pub use file::{EnvironmentFileError, LoadedMap};
pub use irradiance::Irradiance;
pub use map::RadianceMap;
pub use sky::{Sky, Sunlight};

use crate::scene::modelling::math;

/// Radiance from far away, by direction.
///
/// A clone shares the map and all that was made of it. What is made (the map of a sky, its
/// prefiltered levels) is made when it is first asked for, so that reading a config costs nothing.
#[derive(Debug, Clone)]
pub struct Environment {
    shared: Arc<Shared>,
    about_y_rad: f32,
    intensity: f32,
}

#[derive(Debug)]
struct Shared {
    source: Source,
    map: OnceLock<RadianceMap>,
    irradiance: OnceLock<Irradiance>,
    prefiltered: OnceLock<Vec<RadianceMap>>,
}

#[derive(Debug, PartialEq)]
enum Source {
    /// Linear RGB radiance seen along +x, −x, +y, −y, +z, −z.
    Axes([Vec3; 6]),
    Sky(Sky),
    /// With the SHA-256 of its file, if it came from one.
    Map(Option<String>),
}

/// Rows of the maps made of six axes: half a texel is 0.7°.
const AXES_HEIGHT_PX: usize = 128;

impl Environment {
    fn new(source: Source) -> Self {
        Self {
            shared: Arc::new(Shared {
                source,
                map: OnceLock::new(),
                irradiance: OnceLock::new(),
                prefiltered: OnceLock::new(),
            }),
            about_y_rad: 0.0,
            intensity: 1.0,
        }
    }

    /// Six linear RGB radiances, seen along +x, −x, +y, −y, +z, −z.
    ///
    /// Between the axes the radiances are weighted by the squared direction cosines
    /// (the "ambient cube" of McTaggart 2004): smooth, and enough to say that the sky
    /// is blue above, the floor warm below and one wall brighter than the other.
    #[must_use]
    pub fn from_axes(axes: [Vec3; 6]) -> Self {
        Self::new(Source::Axes(axes))
    }

    /// A daylight sky over a matte ground.
    #[must_use]
    pub fn sky(sky: Sky) -> Self {
        Self::new(Source::Sky(sky))
    }

    /// A map that was made or measured.
    #[must_use]
    pub fn from_map(map: RadianceMap) -> Self {
        Self::holding(map, None)
    }

    /// A map that was read from a file.
    #[must_use]
    pub fn from_file(loaded: LoadedMap) -> Self {
        Self::holding(loaded.map, Some(loaded.sha256))
    }

    fn holding(map: RadianceMap, sha256: Option<String>) -> Self {
        let environment = Self::new(Source::Map(sha256));
        // The cell was made a line above: it is empty.
        let _ = environment.shared.map.set(map);
        environment
    }

    /// The same environment turned by a right-handed angle about +Y: what was seen straight ahead
    /// (−Z) is, after a quarter turn, seen on the left (−X).
    #[must_use]
    pub fn turned(&self, about_y_rad: f32) -> Self {
        Self {
            about_y_rad: self.about_y_rad + about_y_rad,
            ..self.clone()
        }
    }

    /// The same environment, `factor` times as bright.
    #[must_use]
    pub fn scaled(&self, factor: f32) -> Self {
        Self {
            intensity: self.intensity * factor,
            ..self.clone()
        }
    }

    /// Angle about +Y by which what [`map`](Self::map) holds is turned, radians.
    #[must_use]
    pub fn about_y_rad(&self) -> f32 {
        self.about_y_rad
    }

    /// What the radiances of [`map`](Self::map) are multiplied by.
    #[must_use]
    pub fn intensity(&self) -> f32 {
        self.intensity
    }

    /// The map, neither turned nor scaled.
    #[must_use]
    pub fn map(&self) -> &RadianceMap {
        self.shared.map.get_or_init(|| match &self.shared.source {
            Source::Axes(axes) => {
                RadianceMap::from_fn(AXES_HEIGHT_PX, |towards| blend_axes(axes, towards))
            }
            Source::Sky(sky) => sky.map(),
            // Set when it was made; were it not, no light is the only thing that can be said.
            Source::Map(_) => RadianceMap::from_fn(1, |_| Vec3::ZERO),
        })
    }

    /// SHA-256 of the file that the map came from: part of what a picture was made of, which the
    /// scene config only names.
    #[must_use]
    pub fn file_sha256(&self) -> Option<&str> {
        match &self.shared.source {
            Source::Map(sha256) => sha256.as_deref(),
            _ => None,
        }
    }

    /// Linear RGB radiance that arrives from unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Vec3 {
        let turned_back = math::rotation(Vec3::Y, -self.about_y_rad) * towards;
        self.map().at(turned_back) * self.intensity
    }

    /// Irradiance by normal, without the ringing of small bright sources
    /// ([`Irradiance::without_ringing`]).
    #[must_use]
    pub fn irradiance(&self) -> Irradiance {
        self.shared
            .irradiance
            .get_or_init(|| Irradiance::of(self.map()).without_ringing())
            .turned(self.about_y_rad)
            .scaled(self.intensity)
    }

    /// The map blurred for reflections, from a mirror's to the roughest, neither turned nor scaled;
    /// see [`prefilter::levels`].
    #[must_use]
    pub fn prefiltered(&self) -> &[RadianceMap] {
        self.shared
            .prefiltered
            .get_or_init(|| prefilter::levels(self.map()))
    }

    /// The sun that belongs to the environment and is not in its map: direction and irradiance,
    /// turned and scaled. Only a sky knows it.
    #[must_use]
    pub fn sun(&self) -> Option<Sunlight> {
        let Source::Sky(sky) = &self.shared.source else {
            return None;
        };
        let sun = sky.sunlight();
        Some(Sunlight {
            towards: math::rotation(Vec3::Y, self.about_y_rad) * sun.towards,
            irradiance: sun.irradiance * self.intensity,
        })
    }
}

impl PartialEq for Environment {
    fn eq(&self, other: &Self) -> bool {
        let same_light = Arc::ptr_eq(&self.shared, &other.shared)
            || (self.shared.source == other.shared.source
                && (!matches!(self.shared.source, Source::Map(_)) || self.map() == other.map()));
        same_light && self.about_y_rad == other.about_y_rad && self.intensity == other.intensity
    }
}

fn blend_axes(axes: &[Vec3; 6], towards: Vec3) -> Vec3 {
    let weight = towards * towards;
    let pick = |axis: usize, component: f32| axes[2 * axis + usize::from(component < 0.0)];
    pick(0, towards.x) * weight.x + pick(1, towards.y) * weight.y + pick(2, towards.z) * weight.z
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [Vec3; 6] = [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
    ];

    fn six() -> Environment {
        Environment::from_axes([1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(Vec3::splat))
    }

    #[test]
    fn axes_are_seen_along_themselves() {
        for (axis, direction) in AXES.into_iter().enumerate() {
            let found = six().radiance(direction).x;
            // The nearest texels are half a texel off the axis: sin² 0.7° of the others.
            assert!(
                (found - (axis + 1) as f32).abs() < 2e-3,
                "{direction}: {found}"
            );
        }
    }

    #[test]
    fn a_quarter_turn_brings_ahead_to_the_left() {
        let turned = six().turned(std::f32::consts::FRAC_PI_2).scaled(2.0);
        assert!((turned.radiance(Vec3::NEG_X).x - 12.0).abs() < 1e-2);
        assert!((turned.radiance(Vec3::Y).x - 6.0).abs() < 1e-2);
    }

    /// The environment's turn, its irradiance and its sun agree.
    #[test]
    fn all_that_is_derived_turns_alike() {
        let sky = Environment::sky(Sky::default());
        let turned = sky.turned(1.1).scaled(0.5);
        let turn = math::rotation(Vec3::Y, 1.1);
        for direction in AXES {
            let (before, after) = (sky.radiance(direction), turned.radiance(turn * direction));
            assert!((before * 0.5 - after).length() < 1e-3 * before.length());
            let before = sky.irradiance().at(direction);
            let after = turned.irradiance().at(turn * direction);
            assert!((before * 0.5 - after).length() < 1e-3 * before.length());
        }
        let (before, after) = (sky.sun().unwrap(), turned.sun().unwrap());
        assert!((turn * before.towards - after.towards).length() < 1e-6);
        assert_eq!(before.irradiance * 0.5, after.irradiance);
        assert!(six().sun().is_none());
    }

    #[test]
    fn equal_recipes_are_equal() {
        assert_eq!(six(), six());
        assert_ne!(six(), six().turned(0.1));
        let map = |value| Environment::from_map(RadianceMap::from_fn(2, |_| Vec3::splat(value)));
        assert_eq!(map(1.0), map(1.0));
        assert_ne!(map(1.0), map(2.0));
    }
}
