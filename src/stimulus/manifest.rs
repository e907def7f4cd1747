//! `manifest.json`: what each image of a set is and where it came from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::config::ParameterValue;
use crate::digest;
pub use crate::render::{AdapterRecord, PassRecord, Picture};

/// Name of the manifest in a folder of stimuli.
pub const FILE_NAME: &str = "manifest.json";

/// Version of the manifest's layout.
pub const SCHEMA_VERSION: u32 = 1;

/// The manifest of one stimulus set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Id of the set (`thesis-2010`).
    pub set_id: String,
    /// SHA-256 of the set config's text and of the scene configs it names, in order.
    pub config_sha256: String,
    /// Seed of everything random in the set.
    pub seed: u64,
    /// Greyfield's version.
    pub app_version: String,
    /// What rendered it; absent for images made elsewhere.
    pub adapter: Option<AdapterRecord>,
    /// The conditions, in the set's order.
    pub pairs: Vec<PairRecord>,
}

/// One condition: two images that differ in the technique alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairRecord {
    /// Condition id (`sponza-moderate-h1`).
    pub condition: String,
    /// Scene id (`atrium`).
    pub scene: String,
    /// `low`, `moderate`, `high`.
    pub validity: String,
    /// The hypothesis it asks (`H1`), free text.
    pub hypothesis: String,
    /// The image that comes first in the base order.
    pub first: ImageRecord,
    /// The other.
    pub second: ImageRecord,
}

/// One image file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImageRecord {
    /// File name, relative to the manifest.
    pub file: PathBuf,
    /// SHA-256 of the file's bytes.
    pub sha256: String,
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// Technique label as it stands in trial rows (`blizzard24`).
    pub technique: String,
    /// The technique's parameters, resolved, in their units.
    pub parameters: BTreeMap<String, ParameterValue>,
    /// Passes that ran, in order; none for an image made elsewhere.
    pub passes: Vec<PassRecord>,
    /// The file it was converted from; absent for an image that was rendered here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRecord>,
}

/// The file an image made elsewhere came from, and what was done to it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SourceRecord {
    /// The file as the set names it.
    pub file: PathBuf,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// `PNG`, `JPEG` or `OpenEXR`.
    pub format: String,
    /// Bits of one channel of one pixel.
    pub bits_per_channel: u32,
    /// `srgb`: shown as it is, reduced to 8 bits. `linear`: exposed, tone-mapped and encoded.
    pub colour_space: String,
    /// Whether the set said so, against what the file says or does not say.
    pub colour_space_declared: bool,
    /// Exposure in stops; absent for sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exposure_ev: Option<f32>,
    /// The tone map; absent for sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tone_map: Option<String>,
    /// Share of pixels (0 to 1) with a channel outside what can be displayed, which was clipped.
    pub clipped_share: f64,
    /// What the set says about it: renderer, settings, licence, ….
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub metadata: BTreeMap<String, String>,
}

/// A folder of stimuli that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StimulusError {
    /// A file could not be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("{}: cannot be written: {source}; free space or choose another folder with --out", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The manifest is not one.
    #[error("{}: not a manifest of this version: {message}; render the set again with `greyfield render`", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// An image is not the one that was made.
    #[error("{}: {message}", path.display())]
    Image {
        /// The file.
        path: PathBuf,
        /// What was found, what is expected, how to mend it.
        message: String,
    },
}

impl Manifest {
    /// Reads `manifest.json` of a folder.
    ///
    /// # Errors
    /// [`StimulusError`] naming the file.
    pub fn load(folder: &Path) -> Result<Self, StimulusError> {
        let path = folder.join(FILE_NAME);
        let text = std::fs::read_to_string(&path).map_err(|source| StimulusError::Unreadable {
            path: path.clone(),
            source,
        })?;
        let malformed = |message: String| StimulusError::Malformed {
            path: path.clone(),
            message,
        };
        let manifest: Self =
            serde_json::from_str(&text).map_err(|error| malformed(error.to_string()))?;
        if manifest.schema_version != SCHEMA_VERSION {
            return Err(malformed(format!(
                "found schema_version {}, this program reads {SCHEMA_VERSION}",
                manifest.schema_version
            )));
        }
        Ok(manifest)
    }

    /// What ran for a condition's image of one technique; nothing where it is not there.
    #[must_use]
    pub fn passes_of(&self, condition: &str, technique: &str) -> &[PassRecord] {
        self.pairs
            .iter()
            .filter(|pair| pair.condition == condition)
            .flat_map(|pair| [&pair.first, &pair.second])
            .find(|image| image.technique == technique)
            .map_or(&[], |image| &image.passes)
    }

    /// Every image, in the set's order, first before second.
    pub fn images(&self) -> impl Iterator<Item = &ImageRecord> {
        self.pairs
            .iter()
            .flat_map(|pair| [&pair.first, &pair.second])
    }

    /// Checks every image of the folder: there, unchanged, whole, of the size on record.
    ///
    /// # Errors
    /// The first image that is not.
    pub fn verify(&self, folder: &Path) -> Result<(), StimulusError> {
        // Hashing and decoding a set takes a noticeable part of a second on one core.
        let images: Vec<&ImageRecord> = self.images().collect();
        let checked: Vec<_> = images
            .into_par_iter()
            .map(|image| image.load(folder).map(drop))
            .collect();
        checked.into_iter().collect()
    }
}

impl ImageRecord {
    /// Decodes the image and checks it against the record.
    ///
    /// # Errors
    /// [`StimulusError`] if the file is missing, changed, damaged or of another size.
    pub fn load(&self, folder: &Path) -> Result<Picture, StimulusError> {
        let path = folder.join(&self.file);
        let bytes = std::fs::read(&path).map_err(|source| StimulusError::Unreadable {
            path: path.clone(),
            source,
        })?;
        let wrong = |message: String| StimulusError::Image {
            path: path.clone(),
            message,
        };
        let decoded = image::load_from_memory(&bytes).map_err(|error| {
            wrong(format!(
                "damaged or not an image ({error}); render the set again"
            ))
        })?;
        if (decoded.width(), decoded.height()) != (self.width_px, self.height_px) {
            return Err(wrong(format!(
                "the image is {}×{} pixels, the manifest says {}×{}",
                decoded.width(),
                decoded.height(),
                self.width_px,
                self.height_px
            )));
        }
        let found = digest::sha256_hex(&bytes);
        if found != self.sha256 {
            return Err(wrong(format!(
                "the image has changed since it was made: SHA-256 is {found}, the manifest says {}; render the set again",
                self.sha256
            )));
        }
        Ok(Picture {
            width_px: self.width_px,
            height_px: self.height_px,
            rgba8: decoded.to_rgba8().into_raw(),
        })
    }
}
