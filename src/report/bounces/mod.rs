//! Light between the points of height fields, for people: figures, one self-contained page, tables.
//!
//! ```text
//! look         colours, keys, style            cut        lines kept inside their panel
//! models       the models beside each other    layout     panels in rows and columns
//! curves       every bounce over openness      decay      the same as a surface, seen from aside
//! term         direct light and first bounce   sum        all bounces together
//! family       models over all albedos         residuals  what they miss
//! saturation   what bounces do to colours      pictures   what models make of a map
//! sweep        amplitudes                      page, tables, methods
//! ```
//!
//! Everything here is a pure function of a [`Study`]: the same study gives the same bytes.

mod curves;
mod cut;
mod decay;
mod family;
mod layout;
mod look;
mod methods;
mod models;
mod page;
mod pictures;
mod residuals;
mod saturation;
mod sum;
mod sweep;
mod tables;
mod term;
#[cfg(test)]
mod tests;

use crate::reference::bounce_fit::{StudiedMap, Study, Term};

pub use page::page;

/// A drawing that stands alone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name of its file, without extension.
    pub stem: String,
    /// What it shows, one line.
    pub title: String,
    /// The file: SVG with its captions, which loads nothing.
    pub svg: String,
}

/// Every figure that the study allows, in the order of the page.
#[must_use]
pub fn figures(study: &Study) -> Vec<Figure> {
    let Some(first) = study.maps.first() else {
        return Vec::new();
    };
    let mut found: Vec<Figure> = study.maps.iter().map(curves::figure).collect();
    found.push(decay::figure(first));
    found.push(term::figure(study, first, Term::Direct));
    found.push(term::figure(study, first, Term::FirstBounce));
    found.push(sum::figure(study, first));
    found.extend(family::figures(study));
    found.extend(residuals::figures(study));
    found.push(saturation::figure(study));
    found.extend(pictures::figure(study));
    found.extend(sweep::figure(study));
    found
}

impl Figure {
    fn new(stem: impl Into<String>, title: &str, svg: String) -> Self {
        Self {
            stem: stem.into(),
            title: title.to_owned(),
            svg,
        }
    }
}

/// A map's name as part of a file's.
fn stem_of(map: &StudiedMap) -> String {
    let plain = |c: char| match c {
        c if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') => c,
        _ => '-',
    };
    map.name.chars().map(plain).collect()
}
