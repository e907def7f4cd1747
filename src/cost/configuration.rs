//! One point of a sweep: a technique with its samples, resolution and blur.

use serde::{Deserialize, Serialize};

use super::CostError;
use crate::render::technique::{
    INTER_REFLECTION, Settings, SettingsError, TECHNIQUES, Technique, find,
};
use crate::scene::SceneConfig;

/// At which resolution a technique runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Resolution {
    /// One estimate a pixel.
    Full,
    /// One estimate for 2 × 2 pixels.
    Half,
}

impl Resolution {
    /// As in configs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Half => "half",
        }
    }
}

/// A technique as it is measured.
#[derive(Debug, Clone)]
pub struct Configuration {
    /// The technique and its parameters; the label names them in rows and file names.
    pub settings: Settings,
    /// Half width of the blur, pixels; 0 for none.
    pub blur_radius_px: u32,
}

impl Configuration {
    /// At which resolution it runs.
    #[must_use]
    pub fn resolution(&self) -> Resolution {
        match self.settings.is("resolution", "half") {
            true => Resolution::Half,
            false => Resolution::Full,
        }
    }

    /// What no other configuration of a sweep is called: `gtao-16-full-b4`.
    #[must_use]
    pub fn id(&self) -> String {
        let (label, resolution) = (&self.settings.label, self.resolution().name());
        match self.settings.technique.shader {
            None => label.clone(),
            Some(_) => format!("{label}-{resolution}-b{}", self.blur_radius_px),
        }
    }

    /// Its parameters by name, as text: `radius_m=2 slices=3 steps=3`.
    #[must_use]
    pub fn parameters(&self) -> String {
        let values = self.settings.values();
        let pairs = values.iter().map(|(name, value)| format!("{name}={value}"));
        pairs.collect::<Vec<_>>().join(" ")
    }
}

/// What a sweep goes through.
#[derive(Debug, Clone)]
pub struct Grid {
    /// The techniques, by registry name.
    pub techniques: Vec<&'static Technique>,
    /// Samples a pixel: looks at the scene for one estimate.
    pub samples: Vec<u32>,
    /// Resolutions.
    pub resolutions: Vec<Resolution>,
    /// Half widths of the blur, pixels; `None` is the scene's own and 0.
    pub blurs_px: Option<Vec<u32>>,
    /// How far occluders count, metres.
    pub reach_m: f64,
}

/// The configurations of a scene, and what was left out and why.
#[derive(Debug, Clone, Default)]
pub struct Configurations {
    /// What is measured, in order; each technique's cheapest first.
    pub list: Vec<Configuration>,
    /// One sentence each.
    pub left_out: Vec<String>,
}

impl Grid {
    /// The techniques that a sweep compares where nothing else is said: all that run a pass, and
    /// none.
    #[must_use]
    pub fn all_techniques() -> Vec<&'static Technique> {
        let is_compared = |technique: &&Technique| !technique.is_handed_in();
        TECHNIQUES.iter().copied().filter(is_compared).collect()
    }

    /// Techniques by their names.
    ///
    /// # Errors
    /// [`CostError::Input`] that lists what there is.
    pub fn techniques(names: &[String]) -> Result<Vec<&'static Technique>, CostError> {
        let known = Self::all_techniques();
        let of = |name: &String| {
            find(name)
                .filter(|technique| !technique.is_handed_in())
                .ok_or_else(|| {
                    let known: Vec<&str> = known.iter().map(|technique| technique.name).collect();
                    CostError::Input(format!(
                        "there is no technique \"{name}\" to measure; there are {}",
                        known.join(", ")
                    ))
                })
        };
        names.iter().map(of).collect()
    }

    /// What the grid is on a scene: the scene's own parameters, with the grid's samples and
    /// reach.
    ///
    /// # Errors
    /// [`CostError::Input`] for parameters of the scene that a technique does not take.
    pub fn on(&self, scene: &SceneConfig) -> Result<Configurations, CostError> {
        let mut found = Configurations::default();
        let own = scene.occlusion.blur_radius_px;
        let mut blurs = self.blurs_px.clone().unwrap_or_else(|| vec![own, 0]);
        // The widest first: its timing tells the unblurred one, too.
        blurs.sort_unstable_by(|a, b| b.cmp(a));
        blurs.dedup();
        let mut samples = self.samples.clone();
        samples.sort_unstable();
        samples.dedup();
        for technique in &self.techniques {
            let settings = of_scene(scene, technique)
                .and_then(|settings| settings.with_reach_m(self.reach_m))
                .map_err(|error| CostError::Input(error.message))?;
            if technique.shader.is_none() {
                found.list.push(Configuration {
                    settings,
                    blur_radius_px: 0,
                });
                continue;
            }
            for &samples in &samples {
                match settings.with_taps(samples) {
                    Ok(settings) => self.variants(&settings, samples, &blurs, &mut found.list)?,
                    Err(error) => found.left_out.push(error.message),
                }
            }
        }
        Ok(found)
    }

    fn variants(
        &self,
        settings: &Settings,
        samples: u32,
        blurs_px: &[u32],
        list: &mut Vec<Configuration>,
    ) -> Result<(), CostError> {
        let mut resolutions = self.resolutions.clone();
        resolutions.sort();
        resolutions.dedup();
        for resolution in resolutions {
            let mut settings = settings.clone();
            settings.label = format!("{}-{samples}", settings.technique.name);
            settings
                .set("resolution", resolution.name())
                .map_err(|error| CostError::Input(error.message))?;
            list.extend(blurs_px.iter().map(|&blur_radius_px| Configuration {
                settings: settings.clone(),
                blur_radius_px,
            }));
        }
        Ok(())
    }
}

/// A technique as a scene sets it.
///
/// # Errors
/// [`SettingsError`] for parameters of the scene that the technique does not take.
pub fn of_scene(scene: &SceneConfig, technique: &Technique) -> Result<Settings, SettingsError> {
    let mut settings = Settings::from_label(technique.name)?;
    let values = scene.occlusion.techniques.get(technique.name);
    for (parameter, value) in values.into_iter().flatten() {
        settings.set(parameter, value.get_ref().clone())?;
    }
    if let Some(model) = &scene.occlusion.inter_reflection
        && !values.is_some_and(|values| values.contains_key(INTER_REFLECTION))
    {
        settings.take_inter_reflection(model.get_ref())?;
    }
    Ok(settings)
}

/// How far occluders count in a scene where nothing else is said: as far as the scene lets
/// `gtao` look, which estimates what the truth is.
///
/// # Errors
/// As [`of_scene`].
pub fn reach_m(scene: &SceneConfig) -> Result<f64, SettingsError> {
    let name = "gtao";
    match find(name) {
        Some(technique) => Ok(of_scene(scene, technique)?.get("radius_m")),
        None => Err(SettingsError {
            parameter: None,
            message: format!("there is no technique {name}"),
        }),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::embedded;

    fn atrium() -> SceneConfig {
        let name = "stimuli/scenes/atrium.toml";
        let (_, text) = embedded::FILES
            .iter()
            .find(|(file, _)| *file == name)
            .unwrap();
        SceneConfig::parse(Path::new(name), text).unwrap()
    }

    fn grid(samples: &[u32]) -> Grid {
        Grid {
            techniques: Grid::all_techniques(),
            samples: samples.to_vec(),
            resolutions: vec![Resolution::Half, Resolution::Full, Resolution::Full],
            blurs_px: None,
            reach_m: 1.5,
        }
    }

    #[test]
    fn every_technique_looks_equally_far_and_often() {
        let scene = atrium();
        let found = grid(&[16, 8, 16]).on(&scene).unwrap();
        assert!(found.left_out.is_empty());
        // Nine techniques, two counts, two resolutions, two blurs; and none.
        assert_eq!(found.list.len(), 1 + 9 * 8);
        let mut ids: Vec<String> = found.list.iter().map(Configuration::id).collect();
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), found.list.len(), "no two are called alike");
        for configuration in &found.list {
            let settings = &configuration.settings;
            assert!(
                [0, 8, 16].contains(&settings.taps()),
                "{}",
                configuration.id()
            );
            if let (Some(reach), Some(_)) = (settings.technique.reach, settings.technique.shader) {
                assert_eq!(settings.get(reach), 1.5, "{}", configuration.id());
            }
        }
    }

    #[test]
    fn what_cannot_be_is_left_out_and_said() {
        let found = grid(&[5]).on(&atrium()).unwrap();
        let said = found.left_out.join("\n");
        for name in ["crytek", "gtao", "vbao"] {
            assert!(said.contains(name), "{name}: {said}");
        }
        assert!(found.list.iter().any(|c| c.settings.label == "alchemy-5"));
    }
}
