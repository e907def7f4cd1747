//! The report for machines: every number with full precision, in a fixed order.

use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Serialize, Serializer};

use super::csv::interval_keys;
use super::{ReportError, VERSION, methods};
use crate::analysis::Analysis;
use crate::analysis::dataset::{Exclusion, Source, StudyFacts};
use crate::analysis::registry;
use crate::analysis::settings::Settings;
use crate::analysis::statistic::{About, Section};
use crate::analysis::table::{Cell, Column, Status, Table};
use crate::analysis::tails::Probability;

/// Version of this layout.
const SCHEMA_VERSION: u32 = 2;

#[derive(Serialize)]
struct Report<'a> {
    schema_version: u32,
    greyfield_version: &'static str,
    settings: &'a Settings,
    conclusion: &'a [String],
    /// One object a condition.
    conditions: Rows<'a>,
    sections: Vec<SectionJson<'a>>,
    study: &'a Option<StudyFacts>,
    exclusions: &'a [Exclusion],
    methods: Vec<String>,
    statistics: Vec<About>,
    inputs: &'a [Source],
    notes: &'a [String],
}

/// One section.
#[derive(Serialize)]
pub struct SectionJson<'a> {
    id: &'static str,
    status: &'static str,
    findings: &'a [String],
    tables: Tables<'a>,
}

impl<'a> SectionJson<'a> {
    /// Of a section.
    pub fn new(section: &'a Section) -> Self {
        Self {
            id: section.id,
            status: section.status.text(),
            findings: &section.findings,
            tables: Tables(section),
        }
    }
}

/// The report, indented.
pub fn render(analysis: &Analysis) -> Result<String, ReportError> {
    let report = Report {
        schema_version: SCHEMA_VERSION,
        greyfield_version: VERSION,
        settings: &analysis.settings,
        conclusion: &analysis.conclusion,
        conditions: Rows(&analysis.conditions),
        sections: analysis.sections.iter().map(SectionJson::new).collect(),
        study: &analysis.data.study,
        exclusions: &analysis.data.exclusions,
        methods: methods::paragraphs(analysis),
        statistics: registry::abouts(),
        inputs: &analysis.data.sources,
        notes: &analysis.data.notes,
    };
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}

/// Tables of a section by their id.
struct Tables<'a>(&'a Section);

impl Serialize for Tables<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.tables.len()))?;
        for part in &self.0.tables {
            map.serialize_entry(part.id, &Rows(&part.table))?;
        }
        map.end()
    }
}

/// A table as a list of objects.
struct Rows<'a>(&'a Table);

impl Serialize for Rows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.0.rows.len()))?;
        for cells in &self.0.rows {
            list.serialize_element(&Row {
                columns: &self.0.columns,
                cells,
            })?;
        }
        list.end()
    }
}

struct Row<'a> {
    columns: &'a [Column],
    cells: &'a [Cell],
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        let mut status = Status::Ok;
        for (column, cell) in self.columns.iter().zip(self.cells) {
            let key = column.key.as_ref();
            if let Cell::Undefined(why) = cell {
                status = status.max(why.status);
            }
            match cell {
                Cell::Text(text) => map.serialize_entry(key, text)?,
                Cell::Count(count) => map.serialize_entry(key, count)?,
                Cell::Number(number) => map.serialize_entry(key, number)?,
                Cell::Probability(p) => probability(&mut map, key, *p)?,
                Cell::Interval(ends) => {
                    let [low, high] = interval_keys(column);
                    map.serialize_entry(&low, &ends.low)?;
                    map.serialize_entry(&high, &ends.high)?;
                }
                Cell::Undefined(why) => {
                    if column.is_interval() {
                        for end in interval_keys(column) {
                            map.serialize_entry(&end, &None::<f64>)?;
                        }
                    } else {
                        map.serialize_entry(key, &None::<f64>)?;
                    }
                    map.serialize_entry(&format!("{key}_status"), why.status.text())?;
                    map.serialize_entry(&format!("{key}_reason"), why.reason)?;
                }
            }
        }
        // A table with a status of its own says it in the same place.
        if !self.columns.iter().any(|column| column.key == "status") {
            map.serialize_entry("status", status.text())?;
        }
        map.end()
    }
}

/// The value, and its logarithm to base 10, which is there also where the value is 0 as a double.
fn probability<M: SerializeMap>(map: &mut M, key: &str, p: Probability) -> Result<(), M::Error> {
    map.serialize_entry(key, &p.value())?;
    map.serialize_entry(&format!("{key}_log10"), &p.log10())
}
