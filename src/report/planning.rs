//! Questions of power and simulated studies, for a terminal and for machines.

use serde::Serialize;

use super::{Format, ReportError, VERSION, csv, json, text};
use crate::analysis::statistic::Section;
use crate::analysis::table::Table;

/// Version of the JSON layout.
const SCHEMA_VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'a, S> {
    schema_version: u32,
    greyfield_version: &'static str,
    settings: &'a S,
    sections: Vec<json::SectionJson<'a>>,
}

/// The sections as text or JSON, or one table as CSV.
///
/// # Errors
/// [`ReportError`]; none is known to occur.
pub fn render(
    sections: &[Section],
    settings: &impl Serialize,
    table: &Table,
    format: Format,
) -> Result<String, ReportError> {
    match format {
        Format::Csv => csv::render(table),
        Format::Json => {
            let document = Document {
                schema_version: SCHEMA_VERSION,
                greyfield_version: VERSION,
                settings,
                sections: sections.iter().map(json::SectionJson::new).collect(),
            };
            Ok(serde_json::to_string_pretty(&document)? + "\n")
        }
        Format::Text | Format::Html => Ok(text::sections(sections)),
    }
}
