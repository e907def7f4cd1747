//! What figures of cost have below them: where the numbers come from.

use super::CostReport;
use super::words::provenance;
use crate::cost::row::Row;
use crate::report::figure::sheet::Sheet;

/// The figure as a file: notes, then where the numbers come from, below what is drawn.
pub fn finish(sheet: Sheet, report: &CostReport, rows: &[&Row], notes: &[&str], y: f64) -> String {
    let notes = notes.iter().map(|note| (*note).to_owned());
    let captions: Vec<String> = notes.chain(provenance(report, rows)).collect();
    sheet.finish("cost", &captions, y, "")
}
