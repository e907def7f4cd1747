//! Pictures of a sweep: what a setting draws, where its occlusion is wrong, and where that is
//! seen.

use super::PicturesArg;
use crate::cost::sweep::SceneSweep;
use crate::cost::{Configuration, CostError, Measured, Resolution, SceneBench, Store};
use crate::render::{AdapterRecord, Picture};
use crate::report::error_picture::{self, Scale};
use crate::stimulus::files::{encode_occlusion, encode_png, write_whole};
use crate::stimulus::manifest::StimulusError;

/// Folder of the pictures, in the sweep's.
pub const FOLDER: &str = "pictures";

/// What stands for a configuration in the names of the truth's pictures.
pub const TRUTH: &str = "truth";

/// Error of the occlusion coefficient at the ends of the scale.
const LARGEST_ERROR: f32 = 0.5;

/// FLIP at the end of the scale: all there is would leave the rest dark.
const LARGEST_FLIP: f32 = 0.5;

/// Samples near which a technique's picture is taken.
const SAMPLES: f64 = 16.0;

/// Where pictures go, and of what.
pub struct Pictures {
    which: PicturesArg,
    folder: std::path::PathBuf,
    adapter: AdapterRecord,
}

impl Pictures {
    /// Makes the folder, if there are to be any.
    ///
    /// # Errors
    /// [`CostError::Files`].
    pub fn new(which: PicturesArg, store: &Store) -> Result<Self, CostError> {
        let folder = store.path(FOLDER);
        if which != PicturesArg::None {
            std::fs::create_dir_all(&folder).map_err(|source| StimulusError::Unwritable {
                path: folder.clone(),
                source,
            })?;
        }
        Ok(Self {
            which,
            folder,
            adapter: store.record.about.adapter.clone(),
        })
    }

    /// The truth of a scene.
    ///
    /// # Errors
    /// [`CostError::Files`].
    pub fn truth(&self, sweep: &SceneSweep, bench: &SceneBench<'_>) -> Result<(), CostError> {
        if self.which == PicturesArg::None {
            return Ok(());
        }
        let scene = &sweep.scene.id;
        for (lighting, picture) in bench.true_pictures() {
            self.image(&format!("{scene}--{TRUTH}--{lighting}"), picture)?;
        }
        let truth = &bench.truth().occlusion;
        let path = self.folder.join(format!("{scene}--{TRUTH}--occlusion.png"));
        let size_px = (truth.width_px, truth.height_px);
        Ok(write_whole(
            &path,
            &encode_occlusion(&path, &truth.values, size_px)?,
        )?)
    }

    /// What was measured, if pictures of it are wanted.
    ///
    /// # Errors
    /// [`CostError::Files`].
    pub fn measured(
        &self,
        sweep: &SceneSweep,
        bench: &SceneBench<'_>,
        configuration: &Configuration,
        measured: &Measured,
    ) -> Result<(), CostError> {
        let is_wanted = match self.which {
            PicturesArg::None => false,
            PicturesArg::All => true,
            PicturesArg::Some => is_typical(sweep, configuration),
        };
        if !is_wanted {
            return Ok(());
        }
        let (scene, id) = (&sweep.scene.id, configuration.id());
        let name = format!("{scene}--{id}");
        let error = bench.truth().error_map(&measured.occlusion);
        let title = format!(
            "{scene}, {id}: occlusion minus truth, RMSE {:.3}, bias {:+.3}",
            measured.error.rmse, measured.error.bias
        );
        self.map(
            &format!("{name}--occlusion-error"),
            &error,
            Scale::Signed(LARGEST_ERROR),
            &title,
            bench,
        )?;
        for image in &measured.images {
            let lighting = &image.lighting;
            let title = format!(
                "{scene}, {lighting}, {id}: FLIP against the image with true occlusion, mean {:.4}",
                image.flip.mean()
            );
            let values = &image.flip.values;
            self.map(
                &format!("{name}--{lighting}--flip"),
                values,
                Scale::Size(LARGEST_FLIP),
                &title,
                bench,
            )?;
            self.image(&format!("{name}--{lighting}"), &image.picture)?;
        }
        Ok(())
    }

    fn image(&self, name: &str, picture: &Picture) -> Result<(), CostError> {
        let path = self.folder.join(format!("{name}.png"));
        Ok(write_whole(&path, &encode_png(&path, picture)?)?)
    }

    fn map(
        &self,
        name: &str,
        values: &[f32],
        scale: Scale,
        title: &str,
        bench: &SceneBench<'_>,
    ) -> Result<(), CostError> {
        let truth = &bench.truth().occlusion;
        let adapter = format!("{}; {}", self.adapter.name, self.adapter.driver);
        let said = |error: error_picture::ErrorPictureError| CostError::Input(error.to_string());
        let size_px = (truth.width_px, truth.height_px);
        let canvas =
            error_picture::draw(values, size_px, scale, &[title, &adapter]).map_err(said)?;
        let bytes = error_picture::encode(&canvas).map_err(said)?;
        Ok(write_whole(
            &self.folder.join(format!("{name}.png")),
            &bytes,
        )?)
    }
}

/// Whether this is the setting of its technique whose samples are nearest to [`SAMPLES`], at full
/// resolution and with the widest blur.
fn is_typical(sweep: &SceneSweep, configuration: &Configuration) -> bool {
    if configuration.settings.technique.shader.is_none() {
        return true;
    }
    let key = |c: &Configuration| {
        let off = (f64::from(c.settings.taps().max(1)) / SAMPLES).ln().abs();
        (
            c.resolution() != Resolution::Full,
            off,
            u32::MAX - c.blur_radius_px,
        )
    };
    let name = configuration.settings.technique.name;
    let alike = sweep
        .configurations
        .iter()
        .filter(|c| c.settings.technique.name == name);
    let best = alike.min_by(|a, b| {
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    best.is_some_and(|best| best.id() == configuration.id())
}
