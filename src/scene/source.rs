//! Where a scene's geometry comes from.

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
}

impl GeometrySource {
    /// Makes or reads the geometry.
    ///
    /// # Errors
    /// [`SceneError`] naming the file and what is wrong with it.
    pub fn load(&self) -> Result<Geometry, SceneError> {
        match self {
            Self::Generated { generator, seed } => Ok((generator.generate)(*seed)),
        }
    }
}
