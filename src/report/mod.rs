//! Results for people and machines: terminal tables, CSV, JSON, one self-contained HTML page.
//!
//! The same analysis gives the same bytes: nothing here reads a clock, and the order of everything
//! is that of the registry and of the data.

pub mod bounces;
pub mod canvas;
pub mod colour_map;
pub mod cost;
mod csv;
pub mod document;
pub mod error_picture;
mod figure;
mod files;
mod html;
mod json;
mod markup;
mod methods;
pub mod number;
pub mod planning;
pub mod raster;
pub mod study_figures;
mod svg;
mod text;

pub use files::{ReportFile, files};

use crate::analysis::Analysis;
use crate::analysis::table::Table;

/// How to write a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Aligned tables for a terminal.
    Text,
    /// Everything, with full precision.
    Json,
    /// The table of conditions, with full precision.
    Csv,
    /// One page with figures that needs nothing from the network.
    Html,
}

/// A report that could not be written out.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The CSV writer gave up.
    #[error("the CSV table cannot be written: {0}")]
    Csv(#[from] ::csv::Error),
    /// A figure could not be made into pixels.
    #[error("the figure cannot be drawn as pixels: {0}")]
    Figure(String),
    /// The JSON writer gave up.
    #[error("the JSON report cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

/// The report, UTF-8, ending in a line feed.
///
/// # Errors
/// [`ReportError`]; none is known to occur for a result of [`analyse`](crate::analysis::analyse).
pub fn render(analysis: &Analysis, format: Format) -> Result<String, ReportError> {
    match format {
        Format::Text => Ok(text::render(analysis)),
        Format::Json => json::render(analysis),
        Format::Csv => csv::render(main_table(analysis)),
        Format::Html => Ok(html::render(analysis)),
    }
}

/// The table of conditions; of ratings and rankings, which have none, the first of their section.
fn main_table(analysis: &Analysis) -> &Table {
    let tables = analysis.sections.iter().flat_map(|section| &section.tables);
    let of_judgements = || tables.map(|part| &part.table).next();
    match analysis.conditions.rows.is_empty() {
        true => of_judgements().unwrap_or(&analysis.conditions),
        false => &analysis.conditions,
    }
}

/// Greyfield's version, as it stands in reports.
const VERSION: &str = env!("CARGO_PKG_VERSION");
