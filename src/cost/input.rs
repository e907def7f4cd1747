//! What a sweep is asked for: scene configs, or stimulus sets, whose own settings are measured
//! beside the grid.

use std::path::{Path, PathBuf};

use super::CostError;
use super::configuration::{self, Configuration, Grid};
use super::sweep::SceneSweep;
use crate::config;
use crate::render::technique::Settings;
use crate::scene::SceneConfig;
use crate::stimulus::StimulusSet;

/// What is asked for beside the files; `None` leaves it to the scene.
#[derive(Debug, Clone, Default)]
pub struct Wishes {
    /// Lighting variants; of a set, those that it shows, of a scene, all.
    pub lightings: Option<Vec<String>>,
    /// Distance from which on nothing occludes, metres.
    pub reach_m: Option<f64>,
}

/// What is to be measured, and what of the grid was left out and why.
#[derive(Debug, Default)]
pub struct Asked {
    /// Scene by scene.
    pub sweeps: Vec<SceneSweep>,
    /// One sentence each.
    pub left_out: Vec<String>,
    /// Size of the images of a set, if one was named that says so.
    pub size_px: Option<(u32, u32)>,
    /// Its seed.
    pub seed: Option<u64>,
}

impl Asked {
    /// Reads scene configs and stimulus sets. `grid.reach_m` is set for each scene.
    ///
    /// # Errors
    /// [`CostError::Input`] naming file, field and what is allowed.
    pub fn read(files: &[PathBuf], grid: &Grid, wishes: &Wishes) -> Result<Self, CostError> {
        let mut asked = Self::default();
        for file in files {
            if is_set(file)? {
                let set = StimulusSet::load(file).map_err(said)?;
                asked.size_px = asked.size_px.or(set.size_px);
                asked.seed = asked.seed.or(Some(set.seed));
                asked.set(&set, grid, wishes)?;
            } else {
                let scene = SceneConfig::load(file).map_err(said)?;
                let lightings = scene.lightings.keys().cloned().collect();
                asked.scene(scene, lightings, grid, wishes)?;
            }
        }
        asked.left_out.sort();
        asked.left_out.dedup();
        Ok(asked)
    }

    fn set(&mut self, set: &StimulusSet, grid: &Grid, wishes: &Wishes) -> Result<(), CostError> {
        if set.scenes.is_empty() {
            return Err(CostError::Input(format!(
                "{}: its images were made elsewhere, so that there is no scene to measure",
                set.path.display()
            )));
        }
        for (index, scene) in set.scenes.iter().enumerate() {
            let pairs = || {
                set.rendered()
                    .filter(|(_, pair)| pair.scene == index)
                    .map(|(_, p)| p)
            };
            let mut lightings: Vec<String> = pairs().map(|pair| pair.lighting.clone()).collect();
            lightings.sort();
            lightings.dedup();
            self.scene(scene.clone(), lightings, grid, wishes)?;
            let Some(sweep) = self
                .sweeps
                .iter_mut()
                .find(|sweep| sweep.scene.id == scene.id)
            else {
                continue;
            };
            for settings in pairs().flat_map(|pair| [&pair.first, &pair.second]) {
                sweep.add(settings);
            }
        }
        Ok(())
    }

    fn scene(
        &mut self,
        scene: SceneConfig,
        lightings: Vec<String>,
        grid: &Grid,
        wishes: &Wishes,
    ) -> Result<(), CostError> {
        let lightings = wishes.lightings.clone().unwrap_or(lightings);
        for lighting in &lightings {
            scene.lighting(lighting).map_err(CostError::Input)?;
        }
        if let Some(known) = self.sweeps.iter().find(|sweep| sweep.scene.id == scene.id) {
            let (this, that) = (scene.path.display(), known.scene.path.display());
            return Err(CostError::Input(format!(
                "two scenes are called \"{}\": {this} and {that}; measure them in two sweeps",
                scene.id
            )));
        }
        let reach_m = match wishes.reach_m {
            Some(reach_m) => reach_m,
            None => configuration::reach_m(&scene).map_err(|e| CostError::Input(e.message))?,
        };
        let grid = Grid {
            reach_m,
            ..grid.clone()
        };
        let mut found = grid.on(&scene)?;
        self.left_out.append(&mut found.left_out);
        self.sweeps.push(SceneSweep {
            scene,
            lightings,
            configurations: found.list,
            reach_m,
        });
        Ok(())
    }
}

impl SceneSweep {
    /// Adds a technique as a set has it, if it can be measured and is not there.
    fn add(&mut self, settings: &Settings) {
        let configuration = Configuration {
            settings: settings.clone(),
            blur_radius_px: match settings.technique.shader {
                Some(_) => self.scene.occlusion.blur_radius_px,
                None => 0,
            },
        };
        let is_known = (self.configurations.iter()).any(|known| known.id() == configuration.id());
        if !is_known && !settings.technique.is_handed_in() {
            self.configurations.push(configuration);
        }
    }
}

/// Whether a file is a stimulus set: it has conditions, which a scene config has not.
///
/// # Errors
/// [`CostError::Input`] for a file that cannot be read.
pub fn is_set(file: &Path) -> Result<bool, CostError> {
    let text = config::read(file).map_err(said)?;
    // A file that does not parse is read as a scene, whose reader says where it is wrong.
    Ok(text
        .parse::<toml::Table>()
        .is_ok_and(|table| table.contains_key("condition")))
}

fn said(error: impl std::fmt::Display) -> CostError {
    CostError::Input(error.to_string())
}
