//! What the browser looks at: a folder of stimuli, and the set they were made from where it is
//! known.

use std::path::{Path, PathBuf};

use crate::config;
use crate::stimulus::manifest::{ImageRecord, Manifest, PairRecord};
use crate::stimulus::{StimulusError, StimulusSet};

/// A folder of stimuli.
#[derive(Debug, Clone)]
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// What it says it holds.
    pub manifest: Manifest,
    /// The set; frame plans and buffers need it.
    pub set: Option<StimulusSet>,
    /// Why there is no set, or what is odd about it, in words.
    pub note: Option<String>,
}

impl Folder {
    /// Opens the stimuli of a set config (`….toml`), or a folder of them.
    ///
    /// # Errors
    /// What cannot be read, and how to mend it.
    pub fn open(path: &Path) -> Result<Self, String> {
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let set = StimulusSet::load(path).map_err(|error| error.to_string())?;
            let folder = set.default_folder();
            return Self::with(&folder, Some(set)).map_err(|error| {
                format!(
                    "{error}; make the images with `greyfield render {}`",
                    path.display()
                )
            });
        }
        // A set's folder stands beside its config and is named like it.
        let mut beside = path.as_os_str().to_owned();
        beside.push(".toml");
        let beside = PathBuf::from(beside);
        let set = config::read(&beside)
            .ok()
            .and_then(|text| StimulusSet::parse(&beside, &text).ok());
        Self::with(path, set).map_err(|error| error.to_string())
    }

    /// A folder, with the set it was made from where that is known.
    ///
    /// # Errors
    /// The manifest cannot be read.
    pub fn with(path: &Path, set: Option<StimulusSet>) -> Result<Self, StimulusError> {
        let manifest = Manifest::load(path)?;
        let (set, note) = match set {
            None => (
                None,
                Some(String::from(
                    "The set is not known, so there are no frame plans and no buffers: open the set's .toml file instead of the folder.",
                )),
            ),
            Some(set) if set.sha256 != manifest.config_sha256 => (
                None,
                Some(format!(
                    "{} has changed since these images were made, so there are no frame plans and no buffers.",
                    set.path.display()
                )),
            ),
            Some(set) => (Some(set), None),
        };
        Ok(Self {
            path: path.to_owned(),
            manifest,
            set,
            note,
        })
    }

    /// The pair of a condition by its place.
    #[must_use]
    pub fn pair(&self, index: usize) -> Option<&PairRecord> {
        self.manifest.pairs.get(index)
    }
}

/// The two images of a pair, in the base order.
#[must_use]
pub fn images(pair: &PairRecord) -> [&ImageRecord; 2] {
    [&pair.first, &pair.second]
}
