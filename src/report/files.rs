//! The whole report as files: the page, the text, the numbers, every table, every figure.

use super::study_figures::FIGURES;
use super::{Format, ReportError, csv, raster, render};
use crate::analysis::Analysis;

/// One file of the report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportFile {
    /// Where it belongs, relative to the report's folder, with `/` between the parts.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// `report.html`, `report.txt`, `report.json`, `tables/….csv`, `figures/….svg` and `.png`. The same
/// analysis gives the same bytes.
///
/// # Errors
/// [`ReportError`]; none is known to occur for a result of [`analyse`](crate::analysis::analyse).
pub fn files(analysis: &Analysis) -> Result<Vec<ReportFile>, ReportError> {
    let mut files = Vec::new();
    let mut add = |path: String, bytes: Vec<u8>| files.push(ReportFile { path, bytes });
    for (path, format) in [
        ("report.html", Format::Html),
        ("report.txt", Format::Text),
        ("report.json", Format::Json),
    ] {
        add(path.to_owned(), render(analysis, format)?.into_bytes());
    }
    if !analysis.conditions.rows.is_empty() {
        let table = csv::render(&analysis.conditions)?;
        add("tables/conditions.csv".to_owned(), table.into_bytes());
    }
    for section in &analysis.sections {
        for part in &section.tables {
            let path = format!("tables/{}--{}.csv", section.id, part.id);
            add(path, csv::render(&part.table)?.into_bytes());
        }
    }
    for figure in FIGURES {
        if let Some(drawing) = (figure.draw)(analysis) {
            let svg = drawing.alone();
            add(format!("figures/{}.png", figure.id), raster::png(&svg)?);
            add(format!("figures/{}.svg", figure.id), svg.into_bytes());
        }
    }
    Ok(files)
}
