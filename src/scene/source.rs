//! Where a scene's geometry comes from.

use std::path::PathBuf;

use super::model::{self, ModelOptions};
use super::procedural::Generator;
use super::{Geometry, SceneError};

/// What makes a scene's geometry.
#[derive(Debug, Clone)]
pub enum GeometrySource {
    /// A procedural scene.
    Generated {
        /// What makes it.
        generator: &'static Generator,
        /// From which seed.
        seed: u64,
    },
    /// A model.
    File {
        /// Its file.
        path: PathBuf,
        /// How it is put into the scene.
        options: ModelOptions,
    },
}

impl GeometrySource {
    /// Makes or reads the geometry, and logs what is to be said about a model.
    ///
    /// # Errors
    /// [`SceneError`] naming the file and what is wrong with it.
    pub fn load(&self) -> Result<Geometry, SceneError> {
        match self {
            Self::Generated { generator, seed } => Ok((generator.generate)(*seed)),
            Self::File { path, options } => {
                let model = model::load(path, options)?;
                let (file, report) = (path.display(), &model.report);
                tracing::info!("{file}: {}", report.size_line());
                for warning in &report.warnings {
                    tracing::warn!("{file}: {warning}");
                }
                Ok(model.geometry)
            }
        }
    }

    /// SHA-256 of what the geometry is made of beyond the scene's config: of the model's
    /// files, if it is a model.
    ///
    /// # Errors
    /// [`SceneError`] for a file that cannot be read.
    pub fn sha256(&self) -> Result<Option<String>, SceneError> {
        match self {
            Self::Generated { .. } => Ok(None),
            Self::File { path, .. } => Ok(Some(model::sha256(path)?)),
        }
    }
}
