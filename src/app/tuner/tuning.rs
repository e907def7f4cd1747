//! What the cost panel is opened on, checked before there is a window.

use super::knobs::Knobs;
use crate::cost::configuration::reach_m;
use crate::cost::{BenchOptions, CostError, TruthOptions};
use crate::render::Repeats;
use crate::scene::SceneConfig;
use crate::stimulus::flip::Viewing;

/// Seed of kernels, noise and rays: that of a cost sweep where nothing else is said.
const SEED: u64 = 2010;

/// What is asked for beside the scene; `None` leaves it to the scene.
#[derive(Debug, Clone)]
pub struct Wishes {
    /// The lighting variant to start with.
    pub lighting: Option<String>,
    /// Size of the images, pixels.
    pub size_px: (u32, u32),
    /// Distance from which on nothing occludes, metres.
    pub radius_m: Option<f64>,
    /// Part of the name of the adapter that is to be measured.
    pub adapter: Option<String>,
}

/// A scene to turn the knobs of.
#[derive(Debug, Clone)]
pub struct Tuning {
    /// The scene.
    pub scene: SceneConfig,
    /// The lighting variant to start with.
    pub lighting: String,
    /// Size of the images, pixels.
    pub size_px: (u32, u32),
    /// Seed of kernels, noise and rays.
    pub seed: u64,
    /// The scene's reach: distance from which on nothing occludes in the truth, metres.
    pub reach_m: f64,
    /// Part of the name of the adapter that is to be measured.
    pub adapter: Option<String>,
}

impl Tuning {
    /// Checks that everything named is there.
    ///
    /// # Errors
    /// [`CostError::Input`] for a lighting variant that the scene does not have, a radius out of
    /// range, or parameters of the scene that a technique does not take.
    pub fn new(scene: SceneConfig, wishes: Wishes) -> Result<Self, CostError> {
        let file = scene.path.display();
        let lighting = match wishes.lighting {
            Some(lighting) => lighting,
            None => scene.lightings.keys().next().cloned().ok_or_else(|| {
                CostError::Input(format!("{file} has no lighting variant; add one"))
            })?,
        };
        scene.lighting(&lighting).map_err(CostError::Input)?;
        let reach_m = match wishes.radius_m {
            Some(radius_m) => radius_m,
            None => reach_m(&scene).map_err(|error| CostError::Input(error.message))?,
        };
        if !(reach_m > 0.0 && reach_m <= 100_000.0) {
            return Err(CostError::Input(format!(
                "--radius: found {reach_m}, allowed is above 0 to 100000 m"
            )));
        }
        Knobs::new(&scene, &lighting, reach_m)?;
        Ok(Self {
            scene,
            lighting,
            size_px: wishes.size_px,
            seed: SEED,
            reach_m,
            adapter: wishes.adapter,
        })
    }

    /// What the truth is.
    pub(super) fn truth(&self, reach_m: f64) -> TruthOptions {
        TruthOptions {
            reach_m,
            ..TruthOptions::default()
        }
    }

    /// How it is measured: fast, because somebody moves a slider meanwhile.
    pub(super) fn bench(&self, reach_m: f64) -> BenchOptions {
        BenchOptions {
            size_px: self.size_px,
            seed: self.seed,
            truth: self.truth(reach_m),
            repeats: Repeats {
                frames: 6,
                at_least: 3,
                within_s: 0.3,
                wall_clock: false,
            },
            pixels_per_degree: Viewing::default().pixels_per_degree(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn tuning(lighting: Option<&str>, radius_m: Option<f64>) -> Result<Tuning, CostError> {
        let scene = SceneConfig::load(Path::new("stimuli/scenes/atrium.toml")).unwrap();
        let wishes = Wishes {
            lighting: lighting.map(str::to_owned),
            size_px: (64, 36),
            radius_m,
            adapter: None,
        };
        Tuning::new(scene, wishes)
    }

    #[test]
    fn the_scene_says_what_nobody_else_says() {
        let tuning = tuning(None, None).unwrap();
        assert_eq!((tuning.lighting.as_str(), tuning.reach_m), ("high", 2.0));
    }

    #[test]
    fn nonsense_is_refused_before_there_is_a_window() {
        let message = tuning(Some("dusk"), None).unwrap_err().to_string();
        assert!(
            message.contains("dusk") && message.contains("moderate"),
            "{message}"
        );
        for radius_m in [0.0, -1.0, f64::NAN, 1e9] {
            assert!(tuning(None, Some(radius_m)).is_err(), "{radius_m}");
        }
    }
}
