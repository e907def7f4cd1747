//! One colour and one mark a technique, the same in every figure.
//!
//! The first colours are those of Okabe & Ito (2008, "Color Universal Design"), which people with
//! any common colour blindness tell apart, with the light ones darkened for lines on white; the
//! rest are from Tol's "muted" scheme (2021, SRON/EPS/TN/09-002, issue 3.2). Ten colours are too many to go by
//! alone, so each has a shape, and every line has its name beside it.

use super::CostReport;
use super::series::is_none;
use crate::report::figure::words::distinct;
use crate::report::svg::Mark;

/// How many colours `figure.css` has.
const COLOURS: usize = 12;

/// What techniques look like.
pub struct Palette<'a> {
    names: Vec<&'a str>,
}

/// What one technique looks like.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Look {
    /// Class that sets its colour.
    pub class: String,
    /// Its mark.
    pub mark: Mark,
}

impl<'a> Palette<'a> {
    /// By first appearance in the rows of the sweep, then in those of growth.
    pub fn of(report: &CostReport<'a>) -> Self {
        let swept = report.rows.iter().map(|row| row.technique.as_str());
        let grown = report.scaling.iter().map(|row| row.technique.as_str());
        let mut names = distinct(swept.chain(grown));
        names.retain(|name| !is_none(name));
        Self { names }
    }

    /// The techniques, without `none`.
    pub fn names(&self) -> &[&'a str] {
        &self.names
    }

    /// Of a technique by its registry name; grey for `none` and for one that is not measured.
    pub fn look(&self, technique: &str) -> Look {
        match self.names.iter().position(|name| *name == technique) {
            Some(place) => Look {
                class: format!("t{}", place % COLOURS),
                // Behind the last colour the shapes go on one further, so that no two are alike.
                mark: Mark::ALL[(place + place / COLOURS) % Mark::ALL.len()],
            },
            None => Look {
                class: String::from("t-none"),
                mark: Mark::Disc,
            },
        }
    }
}
