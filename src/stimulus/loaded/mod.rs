//! Images made elsewhere: read, checked, and turned into what the screen takes.
//!
//! ```text
//! file     the formats: decoded within limits, or refused in one message
//! tags     what a PNG or an OpenEXR file says of its colour space
//! icc      whether an embedded profile is sRGB
//! convert  16 bits, or linear light, to 8-bit sRGB
//! ```

mod convert;
mod file;
mod icc;
mod tags;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use self::tags::Tag;
use super::manifest::{Picture, SourceRecord, StimulusError};
use crate::digest;
use crate::scene::ToneMap;

/// What the numbers in a file mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColourSpace {
    /// sRGB: what the screen shows.
    Srgb,
    /// Linear light with the primaries of sRGB (Rec. 709).
    Linear,
}

impl ColourSpace {
    /// As it is written in sets and manifests.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Srgb => "srgb",
            Self::Linear => "linear",
        }
    }
}

/// One image of a set that was made elsewhere, as the set describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedImage {
    /// What trial rows call how it was made.
    pub label: String,
    /// The file, as the set names it.
    pub file: PathBuf,
    /// The file, to be opened.
    pub path: PathBuf,
    /// What the set says its numbers mean; `None` goes by the file.
    pub colour_space: Option<ColourSpace>,
    /// Exposure in stops, for linear values only.
    pub exposure_ev: Option<f32>,
    /// Tone map, for linear values only.
    pub tone_map: Option<ToneMap>,
    /// What the set says about it.
    pub metadata: BTreeMap<String, String>,
}

/// An image made elsewhere, ready to be shown.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// What the screen shows.
    pub picture: Picture,
    /// Where it came from.
    pub source: SourceRecord,
    /// What whoever made the set should know.
    pub warnings: Vec<String>,
}

/// A share of clipped pixels above which it is worth a warning.
const CLIPPING_WORTH_A_WARNING: f64 = 0.001;

impl LoadedImage {
    /// Reads, checks and converts the file. `size_px` is the size it must have, if there is one.
    ///
    /// # Errors
    /// [`StimulusError`] naming the file: not there, damaged, too large, of another size,
    /// transparent, or of a colour space that cannot be shown as it is.
    pub fn load(&self, size_px: Option<(u32, u32)>) -> Result<Loaded, StimulusError> {
        let bytes = file::read(&self.path)?;
        self.convert(&bytes, size_px)
            .map_err(|message| StimulusError::Image {
                path: self.path.clone(),
                message,
            })
    }

    /// SHA-256 of the file as it is now.
    ///
    /// # Errors
    /// [`StimulusError::Unreadable`].
    pub fn sha256(&self) -> Result<String, StimulusError> {
        digest::sha256_file(&self.path).map_err(|source| StimulusError::Unreadable {
            path: self.path.clone(),
            source,
        })
    }

    fn convert(&self, bytes: &[u8], size_px: Option<(u32, u32)>) -> Result<Loaded, String> {
        let decoded = file::decode(bytes, size_px)?;
        let space = self.space(&decoded.tag)?;
        let tone = match space {
            ColourSpace::Srgb => None,
            ColourSpace::Linear => Some((
                self.exposure_ev.unwrap_or(0.0),
                self.tone_map.unwrap_or(ToneMap::None),
            )),
        };
        let shown = match tone {
            None => convert::displayed(decoded.image),
            Some((exposure_ev, tone_map)) => convert::linear(decoded.image, exposure_ev, tone_map),
        }?;
        let source = SourceRecord {
            file: self.file.clone(),
            sha256: digest::sha256_hex(bytes),
            format: decoded.format.name().to_owned(),
            bits_per_channel: decoded.bits_per_channel,
            colour_space: space.name().to_owned(),
            colour_space_declared: self.colour_space.is_some(),
            exposure_ev: tone.map(|(exposure_ev, _)| exposure_ev),
            tone_map: tone.map(|(_, tone_map)| tone_map.to_string()),
            clipped_share: shown.clipped_share,
            metadata: self.metadata.clone(),
        };
        Ok(Loaded {
            warnings: warnings(&self.path, &source),
            picture: shown.picture,
            source,
        })
    }

    /// What the numbers mean, by the set's word or else the file's.
    fn space(&self, tag: &Tag) -> Result<ColourSpace, String> {
        let space = match (self.colour_space, tag) {
            (Some(declared), _) => declared,
            (None, Tag::Srgb | Tag::Untagged) => ColourSpace::Srgb,
            (None, Tag::Linear) => ColourSpace::Linear,
            (None, Tag::Other(what)) => {
                return Err(format!(
                    "{what}; only sRGB can be shown as it is: convert the file to sRGB, or say what its numbers mean with \
                     colour_space = \"srgb\" or \"linear\""
                ));
            }
        };
        let toned = self.exposure_ev.is_some() || self.tone_map.is_some();
        if space == ColourSpace::Srgb && toned {
            return Err(String::from(
                "exposure_ev and tone_map are for linear values, and these are sRGB: leave them out, or declare colour_space = \"linear\"",
            ));
        }
        Ok(space)
    }
}

fn warnings(path: &Path, source: &SourceRecord) -> Vec<String> {
    let path = path.display();
    let mut warnings = Vec::new();
    if source.format == file::Format::Jpeg.name() {
        warnings.push(format!(
            "{path}: a JPEG; its compression differs from image to image and can be seen, which confounds the comparison. Use PNG or EXR"
        ));
    }
    if source.clipped_share > CLIPPING_WORTH_A_WARNING {
        warnings.push(format!(
            "{path}: {:.1} % of the pixels are outside what a screen can show and were clipped; lower exposure_ev or choose a tone_map",
            100.0 * source.clipped_share
        ));
    }
    warnings
}

#[cfg(test)]
mod tests;
