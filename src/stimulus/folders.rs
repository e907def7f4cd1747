//! Where what is made of a set is put.

use std::path::Path;

use super::manifest::StimulusError;

/// Where a set's files go.
#[derive(Debug, Clone, Copy)]
pub struct Folders<'a> {
    /// The images and their manifest.
    pub images: &'a Path,
    /// The occlusion of each rendered image, if it is wanted: a 16-bit grey PNG of the same name.
    pub occlusion: Option<&'a Path>,
}

impl<'a> Folders<'a> {
    /// Images alone.
    #[must_use]
    pub fn images(images: &'a Path) -> Self {
        Self {
            images,
            occlusion: None,
        }
    }

    /// Makes what is not there.
    pub(super) fn create(&self) -> Result<(), StimulusError> {
        for folder in [Some(self.images), self.occlusion].into_iter().flatten() {
            std::fs::create_dir_all(folder).map_err(|source| StimulusError::Unwritable {
                path: folder.to_owned(),
                source,
            })?;
        }
        Ok(())
    }
}
