//! Whether a folder of stimuli is what its manifest and its set say, and whether two renderings
//! of one set are the same to the eye.

use std::path::Path;

use rayon::prelude::*;

use super::difference::{Difference, difference_picture};
use super::manifest::{ImageRecord, Manifest, PairRecord, Picture, StimulusError};
use super::set::{ImageSource, StimulusSet};
use super::{files, pair_check};

/// Two adapters may round differently: a pixel within this many levels of 255 is the same.
pub const SAME_WITHIN_LEVELS: u8 = 1;
/// Share of pixels that must be the same.
pub const SAME_SHARE: f64 = 0.999;

/// Every image of a folder that is not as the manifest says.
#[must_use]
pub fn changed_images(manifest: &Manifest, folder: &Path) -> Vec<StimulusError> {
    let images: Vec<&ImageRecord> = manifest.images().collect();
    images
        .into_par_iter()
        .filter_map(|image| image.load(folder).err())
        .collect()
}

/// What is worth a look in pairs that are as they were made.
///
/// # Errors
/// The first image that cannot be read.
pub fn doubtful_pairs(manifest: &Manifest, folder: &Path) -> Result<Vec<String>, StimulusError> {
    let mut doubts: Vec<String> = manifest
        .pairs
        .iter()
        .filter_map(pair_check::identical)
        .collect();
    let made_elsewhere = |pair: &&PairRecord| pair.first.source.is_some();
    for pair in manifest.pairs.iter().filter(made_elsewhere) {
        let (first, second) = (pair.first.load(folder)?, pair.second.load(folder)?);
        let found = pair_check::compare(&first, &second).unwrap_or_else(|sizes| vec![sizes]);
        let named = |doubt| format!("condition \"{}\": {doubt}", pair.condition);
        doubts.extend(found.into_iter().map(named));
    }
    Ok(doubts)
}

/// How a manifest falls short of its set as it is now; empty if it does not.
#[must_use]
pub fn against_set(manifest: &Manifest, set: &StimulusSet) -> Vec<String> {
    let mut problems = Vec::new();
    if manifest.set_id != set.id {
        problems.push(format!(
            "the images are of the set \"{}\", this is \"{}\"",
            manifest.set_id, set.id
        ));
    }
    if manifest.config_sha256 != set.sha256 {
        problems.push(String::from(
            "the set or one of its scenes has changed since the images were made; make them again with `greyfield render`",
        ));
    }
    for condition in &set.conditions {
        let pair = manifest.pairs.iter().find(|p| p.condition == condition.id);
        let Some(pair) = pair else {
            problems.push(format!("condition \"{}\" has no images", condition.id));
            continue;
        };
        let labels = [&pair.first.technique, &pair.second.technique];
        if labels != condition.labels() {
            problems.push(format!(
                "condition \"{}\" shows {labels:?}, the set asks for {:?}",
                condition.id,
                condition.labels()
            ));
        }
        if let ImageSource::Loaded(images) = &condition.images {
            for (image, record) in [(&images.first, &pair.first), (&images.second, &pair.second)] {
                let recorded = record.source.as_ref().map(|source| source.sha256.as_str());
                match image.sha256() {
                    Ok(found) if Some(found.as_str()) == recorded => {}
                    Ok(_) => problems.push(format!(
                        "{}: the file has changed since it was converted; run `greyfield render` again",
                        image.path.display()
                    )),
                    Err(error) => problems.push(error.to_string()),
                }
            }
        }
    }
    for pair in &manifest.pairs {
        if !set.conditions.iter().any(|c| c.id == pair.condition) {
            problems.push(format!(
                "condition \"{}\" is not in the set",
                pair.condition
            ));
        }
    }
    problems
}

/// One image in two renderings.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The condition.
    pub condition: String,
    /// The technique's label.
    pub technique: String,
    /// How far the two are apart.
    pub difference: Difference,
}

impl Comparison {
    /// Whether the two are the same but for rounding.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.difference.share_within(SAME_WITHIN_LEVELS) >= SAME_SHARE
    }
}

/// Two folders that cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// An image cannot be used.
    #[error(transparent)]
    Stimulus(#[from] StimulusError),
    /// One folder lacks what the other has.
    #[error("{0}")]
    Missing(String),
    /// Two images of different size.
    #[error("condition \"{condition}\", {technique}: {sizes}")]
    Sizes {
        /// The condition.
        condition: String,
        /// The technique's label.
        technique: String,
        /// Both.
        sizes: super::difference::SizesDiffer,
    },
}

/// Compares every image of `ours` with that of the same condition and technique in `theirs`;
/// the amplified differences go to `diff_folder`, if there is one, as PNG files.
///
/// # Errors
/// [`CompareError`].
pub fn compare_folders(
    ours: (&Manifest, &Path),
    theirs: (&Manifest, &Path),
    diff_folder: Option<&Path>,
    progress: &mut dyn FnMut(&str),
) -> Result<Vec<Comparison>, CompareError> {
    let mut comparisons = Vec::new();
    for pair in &ours.0.pairs {
        for image in [&pair.first, &pair.second] {
            progress(&format!("{} {}", pair.condition, image.technique));
            let other = counterpart(theirs.0, &pair.condition, &image.technique)?;
            let (a, b) = (image.load(ours.1)?, other.load(theirs.1)?);
            let difference = Difference::between(&a, &b).map_err(|sizes| CompareError::Sizes {
                condition: pair.condition.clone(),
                technique: image.technique.clone(),
                sizes,
            })?;
            if let Some(folder) = diff_folder {
                write_difference(&a, &b, &folder.join(&image.file))?;
            }
            comparisons.push(Comparison {
                condition: pair.condition.clone(),
                technique: image.technique.clone(),
                difference,
            });
        }
    }
    Ok(comparisons)
}

fn counterpart<'a>(
    manifest: &'a Manifest,
    condition: &str,
    technique: &str,
) -> Result<&'a ImageRecord, CompareError> {
    manifest
        .pairs
        .iter()
        .filter(|pair| pair.condition == condition)
        .flat_map(|pair| [&pair.first, &pair.second])
        .find(|image| image.technique == technique)
        .ok_or_else(|| {
            CompareError::Missing(format!(
                "only one of the two folders has condition \"{condition}\" with {technique}"
            ))
        })
}

/// How much difference images are amplified: one level of 255 becomes visible.
const DIFF_GAIN: u32 = 16;

fn write_difference(a: &Picture, b: &Picture, path: &Path) -> Result<(), StimulusError> {
    // Sizes were compared before.
    if let Ok(picture) = difference_picture(a, b, DIFF_GAIN) {
        files::write_whole(path, &files::encode_png(path, &picture)?)?;
    }
    Ok(())
}
