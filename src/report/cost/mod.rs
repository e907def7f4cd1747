//! Accuracy beside its cost, for people: figures, one self-contained page, tables of what grows
//! and of what people chose.
//!
//! ```text
//! palette   one colour and mark a technique    series     rows as lines, the front
//! sheet     captions with provenance           words      sentences
//! plane, estimator, scaling, preferences       one figure each
//! page      the page                           tables     its tables
//! knee      where the front bends              table      CSV for other programs
//! ```
//!
//! Everything here is a pure function of a [`CostReport`]: the same rows give the same bytes.

mod estimator;
mod knee;
mod methods;
mod page;
mod palette;
mod plane;
mod preferences;
mod scaling;
mod series;
mod sheet;
mod table;
mod tables;
#[cfg(test)]
mod tests;
mod words;

use crate::cost::row::Row;
use crate::cost::scaling::{Exponent, ScalingRow};
use crate::cost::store::SweepRecord;
use crate::cost::votes::Preference;
use crate::report::figure::words::distinct;

pub use estimator::estimator;
pub use knee::knee;
pub use page::page;
pub use plane::{flip_plane, plane};
pub use preferences::preferences;
pub use scaling::scaling;
pub use table::{exponents_csv, preferences_csv, scaling_csv};

/// What a report on cost is made from. All but the sweep may be empty.
#[derive(Debug, Clone, Copy)]
pub struct CostReport<'a> {
    /// What was measured, and by which runs.
    pub record: &'a SweepRecord,
    /// What was found, in the order of the sweep; techniques get their colours in this order.
    pub rows: &'a [Row],
    /// How time grows.
    pub scaling: &'a [ScalingRow],
    /// Exponents of that growth.
    pub exponents: &'a [Exponent],
    /// People's choices beside the costs of the images.
    pub preferences: &'a [Preference],
    /// Whose votes they are: "votes of the 36 participants of 2010 on the images of 2010".
    pub votes_source: &'a str,
    /// Images for the page, in the order in which they are shown.
    pub pictures: &'a [PagePicture],
}

/// An image for the page, kept inside it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PagePicture {
    /// Id of the scene it belongs to.
    pub scene: String,
    /// The configuration that it shows: pictures of one stand together.
    pub subject: String,
    /// What it shows.
    pub caption: String,
    /// Media type: `image/png`.
    pub mime: &'static str,
    /// The file's bytes.
    pub bytes: Vec<u8>,
}

impl<'a> CostReport<'a> {
    /// A report on a sweep alone.
    #[must_use]
    pub fn of(record: &'a SweepRecord, rows: &'a [Row]) -> Self {
        Self {
            record,
            rows,
            scaling: &[],
            exponents: &[],
            preferences: &[],
            votes_source: "",
            pictures: &[],
        }
    }

    /// Every figure that the data allows, each with a name for its file (no extension): one
    /// `plane--SCENE` and `flip--SCENE` a scene, `estimator`, `scaling--SCENE`, `preferences`.
    #[must_use]
    pub fn figures(&self) -> Vec<(String, String)> {
        let mut found = Vec::new();
        for scene in self.scenes() {
            found.push((format!("plane--{scene}"), plane(self, scene)));
            found.push((format!("flip--{scene}"), flip_plane(self, scene)));
        }
        if !self.rows.is_empty() {
            found.push((String::from("estimator"), estimator(self)));
        }
        for scene in self.scaling_scenes() {
            found.push((format!("scaling--{scene}"), scaling(self, scene)));
        }
        if !self.preferences.is_empty() {
            found.push((String::from("preferences"), preferences(self)));
        }
        found
    }

    /// Scenes of the sweep, in the order of the rows.
    fn scenes(&self) -> Vec<&'a str> {
        distinct(self.rows.iter().map(|row| row.scene.as_str()))
    }

    /// Scenes whose growth was measured.
    fn scaling_scenes(&self) -> Vec<&'a str> {
        distinct(self.scaling.iter().map(|row| row.scene.as_str()))
    }
}
