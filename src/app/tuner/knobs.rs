//! The settings as the controls hold them. Each technique keeps its own, so that nothing is lost
//! by looking at another.

use crate::config::ParameterValue;
use crate::cost::configuration::of_scene;
use crate::cost::{Configuration, CostError, Grid, Resolution};
use crate::render::technique::{Parameter, Settings, SettingsError, Taps, Technique};
use crate::scene::SceneConfig;

/// Samples a pixel that the slider goes up to; what is set by lines and steps may go on.
const MOST_SAMPLES: u32 = 256;

/// How far lines and steps may leave their proportion for a number of samples.
const SKEW: f64 = 2.0;

/// Widest blur that a scene can have, pixels.
pub const WIDEST_BLUR_PX: u32 = 16;

/// What everything is set to.
#[derive(Debug, Clone)]
pub struct Knobs {
    techniques: Vec<One>,
    chosen: usize,
    /// Half width of the blur, pixels.
    pub blur_radius_px: u32,
    /// The lighting variant.
    pub lighting: String,
}

/// What one technique is set to.
#[derive(Debug, Clone)]
struct One {
    settings: Settings,
    /// As it was opened: what sliders are scaled by.
    opened: Settings,
    /// Lines and steps as they were last set by themselves. The slider of samples keeps to their
    /// proportion, which it would else lose for ever at the first odd number.
    proportion: Settings,
    /// Samples a pixel that the slider offers.
    counts: Vec<u32>,
}

impl Knobs {
    /// Every technique that can be measured, as a scene sets it, with one reach for all.
    ///
    /// # Errors
    /// [`CostError::Input`] for parameters of the scene, or a reach, that a technique does not
    /// take.
    pub fn new(scene: &SceneConfig, lighting: &str, reach_m: f64) -> Result<Self, CostError> {
        let one = |technique: &'static Technique| {
            let settings = of_scene(scene, technique)?.with_reach_m(reach_m)?;
            Ok(One {
                counts: counts(&settings),
                opened: settings.clone(),
                proportion: settings.clone(),
                settings,
            })
        };
        let techniques = Grid::all_techniques()
            .into_iter()
            .map(one)
            .collect::<Result<Vec<_>, SettingsError>>()
            .map_err(|error| CostError::Input(error.message))?;
        // It estimates what the truth is.
        let is_first = |one: &One| one.settings.technique.name == "gtao";
        Ok(Self {
            chosen: techniques.iter().position(is_first).unwrap_or(0),
            techniques,
            blur_radius_px: scene.occlusion.blur_radius_px,
            lighting: lighting.to_owned(),
        })
    }

    fn one(&self) -> &One {
        // `chosen` is only ever set to a technique there is.
        &self.techniques[self.chosen]
    }

    fn one_mut(&mut self) -> &mut One {
        &mut self.techniques[self.chosen]
    }

    /// The techniques, in the registry's order.
    pub fn techniques(&self) -> impl Iterator<Item = &'static Technique> + '_ {
        self.techniques.iter().map(|one| one.settings.technique)
    }

    /// Looks at another technique.
    pub fn choose(&mut self, technique: &str) {
        let mut techniques = self.techniques();
        if let Some(place) = techniques.position(|known| known.name == technique) {
            drop(techniques);
            self.chosen = place;
        }
    }

    /// The chosen technique's settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.one().settings
    }

    /// A parameter as it was when everything was opened.
    #[must_use]
    pub fn opened(&self, parameter: &str) -> f64 {
        self.one().opened.get(parameter)
    }

    /// Samples a pixel that the slider offers, the present ones among them; none for a technique
    /// that takes none.
    #[must_use]
    pub fn counts(&self) -> &[u32] {
        &self.one().counts
    }

    /// Goes to the offered number of samples that is nearest.
    ///
    /// # Errors
    /// [`SettingsError`] if the technique cannot take it; then nothing is changed.
    pub fn set_samples(&mut self, wanted: f64) -> Result<(), SettingsError> {
        let one = self.one_mut();
        let off = |count: &u32| (f64::from(*count) - wanted).abs();
        let nearest = one.counts.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let Some(&nearest) = nearest else {
            return Ok(());
        };
        let mut settings = one.settings.clone();
        for name in lines_of(settings.technique) {
            settings.set(name, one.proportion.get(name))?;
        }
        one.settings = settings.with_taps(nearest)?;
        Ok(())
    }

    /// The next number of samples above or below the present one.
    #[must_use]
    pub fn neighbour(&self, up: bool) -> Option<u32> {
        let (counts, now) = (self.counts(), self.settings().taps());
        match up {
            true => counts.iter().copied().find(|&count| count > now),
            false => counts.iter().copied().rev().find(|&count| count < now),
        }
    }

    /// How far the technique looks, metres, if it has such a distance.
    #[must_use]
    pub fn reach_m(&self) -> Option<f64> {
        let settings = self.settings();
        settings.technique.reach.map(|name| settings.get(name))
    }

    /// Sets how far the technique looks.
    ///
    /// # Errors
    /// [`SettingsError`] for a distance out of range; then nothing is changed.
    pub fn set_reach_m(&mut self, reach_m: f64) -> Result<(), SettingsError> {
        let one = self.one_mut();
        one.settings = one.settings.with_reach_m(reach_m)?;
        Ok(())
    }

    /// Sets a parameter by name.
    ///
    /// # Errors
    /// [`SettingsError`] for a value out of range; then nothing is changed.
    pub fn set(
        &mut self,
        name: &str,
        value: impl Into<ParameterValue>,
    ) -> Result<(), SettingsError> {
        let one = self.one_mut();
        one.settings.set(name, value)?;
        if lines_of(one.settings.technique).contains(&name) {
            one.proportion = one.settings.clone();
            one.counts = counts(&one.settings);
        }
        Ok(())
    }

    /// The parameters that have no control of their own.
    pub fn further(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        let technique = self.settings().technique;
        let has_own = move |name: &str| {
            name == "resolution"
                || technique.reach == Some(name)
                || matches!(technique.taps, Taps::Count(samples) if samples == name)
        };
        technique
            .all_parameters()
            .filter(move |parameter| !has_own(parameter.name))
    }

    /// What is to be measured.
    #[must_use]
    pub fn configuration(&self) -> Configuration {
        let mut settings = self.settings().clone();
        let runs = settings.technique.shader.is_some();
        let mut configuration = Configuration {
            blur_radius_px: if runs { self.blur_radius_px } else { 0 },
            settings: settings.clone(),
        };
        if runs {
            settings.label = format!("{}-{}", settings.technique.name, settings.taps());
            if configuration.resolution() == Resolution::Half {
                settings.label.push_str("-half");
            }
            configuration.settings = settings;
        }
        configuration
    }
}

/// The parameters whose product is a technique's number of samples.
fn lines_of(technique: &Technique) -> Vec<&'static str> {
    match technique.taps {
        Taps::Lines { count, steps, .. } => vec![count, steps],
        Taps::None | Taps::Count(_) => Vec::new(),
    }
}

/// Numbers of samples near which lines and steps keep about their proportion, and the present
/// number.
fn counts(settings: &Settings) -> Vec<u32> {
    let now = settings.taps();
    let is_offered = |taps: &u32| {
        *taps == now
            || settings
                .with_taps(*taps)
                .is_ok_and(|set| skew(&set, settings) <= SKEW + 1e-9)
    };
    let last = MOST_SAMPLES.max(now);
    (1..=last)
        .filter(|taps| *taps <= MOST_SAMPLES || *taps == now)
        .filter(is_offered)
        .collect()
}

/// By which factor lines against steps are off from what they are in `wanted`.
fn skew(settings: &Settings, wanted: &Settings) -> f64 {
    let [lines, steps] = lines_of(settings.technique)[..] else {
        return 1.0;
    };
    let proportion = |settings: &Settings| settings.get(lines) / settings.get(steps);
    let off = proportion(settings) / proportion(wanted);
    off.max(1.0 / off)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn knobs() -> Knobs {
        let path = Path::new("stimuli/scenes/atrium.toml");
        let scene = SceneConfig::load(path).unwrap();
        Knobs::new(&scene, "low", 2.0).unwrap()
    }

    #[test]
    fn the_slider_offers_what_can_be_taken() {
        let mut knobs = knobs();
        for technique in Grid::all_techniques() {
            knobs.choose(technique.name);
            assert_eq!(knobs.settings().technique.name, technique.name);
            assert_eq!(knobs.counts().is_empty(), technique.shader.is_none());
            for count in knobs.counts().to_vec() {
                knobs.set_samples(f64::from(count)).unwrap();
                assert_eq!(knobs.settings().taps(), count, "{}", technique.name);
            }
        }
    }

    #[test]
    fn lines_and_steps_find_back_to_their_proportion() {
        let mut knobs = knobs();
        let of = |knobs: &Knobs| ["slices", "steps"].map(|name| knobs.settings().get(name));
        assert_eq!(of(&knobs), [3.0, 3.0]);
        for count in [30.0, 2.0, 256.0, 18.0] {
            knobs.set_samples(count).unwrap();
        }
        assert_eq!(of(&knobs), [3.0, 3.0]);
        knobs.set("slices", 9.0).unwrap();
        assert!(knobs.counts().contains(&54));
        knobs.set_samples(6.0).unwrap();
        knobs.set_samples(54.0).unwrap();
        assert_eq!(of(&knobs), [9.0, 3.0]);
    }

    #[test]
    fn a_technique_keeps_its_settings() {
        let mut knobs = knobs();
        knobs.set_reach_m(0.7).unwrap();
        knobs.set("resolution", "half").unwrap();
        knobs.choose("crytek");
        assert_eq!(knobs.reach_m(), None);
        assert_eq!(knobs.configuration().settings.label, "crytek-24");
        knobs.choose("gtao");
        assert_eq!(knobs.reach_m(), Some(0.7));
        assert_eq!(knobs.configuration().settings.label, "gtao-18-half");
        assert!(knobs.set_reach_m(-1.0).is_err());
        assert_eq!(knobs.reach_m(), Some(0.7));
    }

    #[test]
    fn the_neighbours_are_offered_too() {
        let mut knobs = knobs();
        knobs.choose("crytek");
        assert_eq!(
            [true, false].map(|up| knobs.neighbour(up)),
            [Some(32), Some(16)]
        );
        knobs.set_samples(0.0).unwrap();
        assert_eq!(knobs.neighbour(false), None);
    }

    #[test]
    fn nothing_is_blurred_where_nothing_runs() {
        let mut knobs = knobs();
        assert_eq!(knobs.configuration().blur_radius_px, 4);
        knobs.choose("none");
        let configuration = knobs.configuration();
        assert_eq!(configuration.blur_radius_px, 0);
        assert_eq!(configuration.settings.label, "none");
    }
}
