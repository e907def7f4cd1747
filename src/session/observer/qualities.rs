//! How good the images of a set are to an observer that looks at them.
//!
//! A session never touches a pixel: which image is compared with which is decided here from the
//! manifest, and the distances are asked of whoever starts the session.

use std::collections::BTreeMap;
use std::fmt;

use crate::protocol::exhibit::{Exhibits, ImageOf};
use crate::protocol::{Exhibit, Protocol};
use crate::session::start;
use crate::stimulus::manifest::PairRecord;
use crate::stimulus::{ImageRecord, Manifest};

/// Label of an image that is the truth of its view.
const TRUTH_LABEL: &str = "ray-traced";

/// A parameter that images of the technique `ray-traced` have on record, and no others: it tells
/// them where the set gave them a label of its own.
const TRUTH_PARAMETER: &str = "max_rays";

/// How far two images are apart; the names are those of the option `metric`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Metric {
    /// Mean FLIP, 0 to 1.
    Flip,
    /// Root of the mean squared difference of lightness (CIE L*), 0 to 100.
    Error,
}

/// Gives the distance of each two images, in the order asked.
pub type Distances<'a> = dyn Fn(Metric, &[[&ImageRecord; 2]]) -> Result<Vec<f64>, String> + 'a;

/// What an observer may ask for while it is made.
#[derive(Clone, Copy)]
pub struct Needs<'a> {
    /// The protocol it will sit.
    pub protocol: &'a Protocol,
    /// The images it will see, by name.
    pub manifest: &'a Manifest,
    /// Compares images; takes as long as that takes, so only who needs it calls it.
    pub distances: &'a Distances<'a>,
}

impl fmt::Debug for Needs<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let set = &self.manifest.set_id;
        f.debug_struct("Needs")
            .field("set", set)
            .finish_non_exhaustive()
    }
}

/// Condition and technique.
type Key = (String, String);

/// Quality of every image that a protocol shows: minus its distance to the truth.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Qualities {
    /// By condition and technique.
    table: BTreeMap<Key, f64>,
}

impl Qualities {
    /// A table as it is.
    #[cfg(test)]
    pub(super) fn new(entries: &[(&str, &str, f64)]) -> Self {
        let entry = |&(condition, technique, quality): &(&str, &str, f64)| {
            ((condition.to_owned(), technique.to_owned()), quality)
        };
        Self {
            table: entries.iter().map(entry).collect(),
        }
    }

    /// Compares every image with its truth: the reference where the procedure shows one; else
    /// the view's image labelled `truth`; without a label, the one the technique `ray-traced`
    /// made. In a view without such an image the second image of the pair in the set's base
    /// order stands for it, as sets name the more accurate technique second (of the view's last
    /// pair, where images are not shown as pairs).
    ///
    /// # Errors
    /// What the set lacks, or why images cannot be compared.
    pub fn measure(needs: &Needs<'_>, metric: Metric, truth: Option<&str>) -> Result<Self, String> {
        let manifest = needs.manifest;
        check_label(manifest, truth)?;
        let exhibits =
            start::exhibits(needs.protocol, manifest).map_err(|error| error.to_string())?;
        let mut asked: Vec<[&ImageRecord; 2]> = Vec::new();
        // Where each entry's distance is found; images of the same bytes have none.
        let mut entries: Vec<(Key, Option<usize>)> = Vec::new();
        for exhibit in &exhibits {
            for (&at, technique) in exhibit.images.iter().zip(&exhibit.condition.techniques) {
                let compared = compared(needs, exhibit, at, truth)
                    .ok_or_else(|| format!("images of {}", exhibit.condition.id))?;
                let known = |known: &[&ImageRecord; 2]| sha256(known) == sha256(&compared);
                let place = (compared[0].sha256 != compared[1].sha256).then(|| {
                    asked.iter().position(known).unwrap_or_else(|| {
                        asked.push(compared);
                        asked.len() - 1
                    })
                });
                entries.push(((exhibit.condition.id.clone(), technique.clone()), place));
            }
        }
        let distances = (needs.distances)(metric, &asked)?;
        let quality = |place: Option<usize>| match place {
            None => Ok(0.0),
            Some(place) => (distances.get(place).map(|&distance| -distance))
                .filter(|quality| quality.is_finite())
                .ok_or_else(|| "a distance for every image".to_owned()),
        };
        let entry = |(key, place)| Ok((key, quality(place)?));
        Ok(Self {
            table: entries
                .into_iter()
                .map(entry)
                .collect::<Result<_, String>>()?,
        })
    }

    /// Quality of a condition's image of one technique; 0 for one that is not in the table.
    #[must_use]
    pub fn of(&self, condition: &str, technique: &str) -> f64 {
        let key = (condition.to_owned(), technique.to_owned());
        self.table.get(&key).copied().unwrap_or(0.0)
    }

    /// The lowest and the highest quality.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        let values = self.table.values().copied();
        let lowest = values.clone().fold(f64::INFINITY, f64::min);
        (lowest, values.fold(f64::NEG_INFINITY, f64::max))
    }
}

fn sha256<'a>(images: &[&'a ImageRecord; 2]) -> [&'a str; 2] {
    images.map(|image| &*image.sha256)
}

/// A label that no image has is a slip of the pen.
fn check_label(manifest: &Manifest, truth: Option<&str>) -> Result<(), String> {
    let Some(label) = truth else {
        return Ok(());
    };
    let mut labels: Vec<&str> = manifest.images().map(|image| &*image.technique).collect();
    if labels.contains(&label) {
        return Ok(());
    }
    labels.sort_unstable();
    labels.dedup();
    Err(format!(
        "an image of the set for truth={label}; the labels in the set are {}",
        labels.join(", ")
    ))
}

/// An image of an exhibit and what it is compared with.
fn compared<'a>(
    needs: &Needs<'a>,
    exhibit: &Exhibit,
    at: ImageOf,
    truth: Option<&str>,
) -> Option<[&'a ImageRecord; 2]> {
    let manifest = needs.manifest;
    let image = start::image(manifest, at)?;
    if let Some(reference) = exhibit.reference {
        return Some([image, start::image(manifest, reference)?]);
    }
    let pair = manifest.pairs.get(at.pair)?;
    let view: Vec<&PairRecord> = (manifest.pairs.iter())
        .filter(|known| (&known.scene, &known.validity) == (&pair.scene, &pair.validity))
        .collect();
    let stand_in = match needs.protocol.procedure.exhibits {
        Exhibits::Pairs | Exhibits::PairsWithReference => pair,
        Exhibits::Singles | Exhibits::Versions => view.last()?,
    };
    Some([image, truth_of(&view, truth).unwrap_or(&stand_in.second)])
}

fn truth_of<'a>(view: &[&'a PairRecord], label: Option<&str>) -> Option<&'a ImageRecord> {
    let mut images = view.iter().flat_map(|pair| [&pair.first, &pair.second]);
    let labelled = |label: &str| images.clone().find(|image| image.technique == label);
    if let Some(label) = label {
        return labelled(label);
    }
    if let Some(found) = labelled(TRUTH_LABEL) {
        return Some(found);
    }
    let is_traced = |image: &&ImageRecord| image.parameters.contains_key(TRUTH_PARAMETER);
    let found = images.find(is_traced)?;
    // Two different traced images, and nobody can say which of them is meant.
    let same = |other: &ImageRecord| other.sha256 == found.sha256;
    images.filter(is_traced).all(same).then_some(found)
}

#[cfg(test)]
pub(super) mod tests;
