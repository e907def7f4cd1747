//! Configurations measured one after another, each on disk before the next.

use super::bench::{BenchOptions, SceneBench};
use super::configuration::Configuration;
use super::measured::Measured;
use super::row::{Common, Row};
use super::store::{SceneRecord, Store};
use super::truth::{Subject, Truth};
use super::{CostError, TruthOptions};
use crate::digest;
use crate::render::{Renderer, Repeats};
use crate::scene::{SceneConfig, SceneError};
use crate::stimulus::progress::Progress;

/// What is measured of one scene.
#[derive(Debug, Clone)]
pub struct SceneSweep {
    /// The scene.
    pub scene: SceneConfig,
    /// Its lighting variants, by name.
    pub lightings: Vec<String>,
    /// What is measured in it.
    pub configurations: Vec<Configuration>,
    /// Distance from which on nothing occludes in the truth, metres.
    pub reach_m: f64,
}

impl SceneSweep {
    /// What `sweep.json` says of it.
    ///
    /// # Errors
    /// [`SceneError`] for a model that cannot be read.
    pub fn record(&self) -> Result<SceneRecord, SceneError> {
        let mut parts = vec![self.scene.text.clone()];
        parts.extend(self.scene.geometry.sha256()?);
        parts.extend(self.scene.environment_sha256().map(str::to_owned));
        Ok(SceneRecord {
            sha256: digest::sha256_hex(parts.join("\0").as_bytes()),
            reach_m: self.reach_m,
        })
    }

    /// What is not measured yet.
    pub fn left<'a>(&'a self, store: &'a Store) -> impl Iterator<Item = &'a Configuration> + 'a {
        let is_left = |c: &&Configuration| !store.has(&self.scene.id, c, &self.lightings);
        self.configurations.iter().filter(is_left)
    }

    /// About what a configuration takes in comparison with others: for the time left.
    #[must_use]
    pub fn weight(configuration: &Configuration) -> u64 {
        // Drawing and comparing images costs about as much as a few dozen samples.
        32 + u64::from(configuration.settings.taps())
    }
}

/// Who waits for a sweep, and takes what is not kept in rows.
pub trait Watch {
    /// Told of steps and of pixels traced.
    fn progress(&self) -> &Progress<'_>;

    /// A scene's truth is there.
    ///
    /// # Errors
    /// Ends the sweep.
    fn opened(&self, sweep: &SceneSweep, bench: &SceneBench<'_>) -> Result<(), CostError>;

    /// Something was measured; its rows are kept after this.
    ///
    /// # Errors
    /// Ends the sweep.
    fn measured(
        &self,
        sweep: &SceneSweep,
        bench: &SceneBench<'_>,
        configuration: &Configuration,
        measured: &Measured,
    ) -> Result<(), CostError>;
}

/// Measures what a scene's sweep has left, into the store.
///
/// # Errors
/// [`CostError`]; what was measured before stays on disk.
pub fn run(
    renderer: &Renderer,
    sweep: &SceneSweep,
    store: &mut Store,
    repeats: Repeats,
    watch: &dyn Watch,
) -> Result<(), CostError> {
    let left: Vec<Configuration> = sweep.left(store).cloned().collect();
    if left.is_empty() {
        return Ok(());
    }
    let (scene, about) = (&sweep.scene, store.record.about.clone());
    (watch.progress().step)(&format!("scene {}", scene.id));
    let geometry = scene.geometry.load()?;
    if geometry.triangles() == 0 {
        return Err(CostError::Input(format!(
            "{}: the scene has no triangle, so that there is no occlusion to measure",
            scene.path.display()
        )));
    }
    let uploaded = renderer.upload(&geometry)?;
    let options = BenchOptions {
        size_px: about.size_px,
        seed: about.seed,
        truth: TruthOptions {
            reach_m: sweep.reach_m,
            error: about.truth_error,
            ..TruthOptions::default()
        },
        repeats,
        pixels_per_degree: about.pixels_per_degree,
    };
    let subject = Subject {
        renderer,
        uploaded: &uploaded,
        scene,
        size_px: about.size_px,
        seed: about.seed,
    };
    let kept = store.path(&format!("truth--{}.exr", scene.id));
    let truth = Truth::find(
        &subject,
        &geometry,
        &options.truth,
        Some(&kept),
        watch.progress(),
    )?;
    drop(geometry);
    let common = Common {
        scene: scene.id.clone(),
        reach_m: sweep.reach_m,
        truth_error: truth.standard_error,
        thickness_m: truth.known.thickness_m,
        size_px: about.size_px,
        adapter: about.adapter,
        run: store.run(),
    };
    let mut bench = SceneBench::new(renderer, &uploaded, scene, &sweep.lightings, truth, options)?;
    watch.opened(sweep, &bench)?;
    for configuration in &left {
        (watch.progress().step)(&format!("{} {}", scene.id, configuration.id()));
        let measured = bench.measure(configuration)?;
        watch.measured(sweep, &bench, configuration, &measured)?;
        store.add(Row::all(&common, configuration, &measured))?;
    }
    Ok(())
}
