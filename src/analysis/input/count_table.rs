//! The count table: `condition,technique_a,technique_b,votes_a,votes_b[,hypothesis][,scene]
//! [,published_chi_square][,published_p]`.

use std::ops::RangeInclusive;

use super::csv_file::{CsvFile, Row, shown};
use super::error::InputError;
use super::files::Files;
use super::lookalikes;
use super::names::Names;
use crate::analysis::dataset::{ConditionData, Dataset, Published, Source, Votes};

/// What the file is called in reports.
pub const KIND: &str = "count table";
/// Columns that must be there.
pub const REQUIRED: &[&str] = &[
    "condition",
    "technique_a",
    "technique_b",
    "votes_a",
    "votes_b",
];
/// Columns that may be.
pub const OPTIONAL: &[&str] = &["hypothesis", "scene", "published_chi_square", "published_p"];

/// Most votes for one technique; two of them and the sums over conditions stay exact.
const MOST_VOTES: u32 = 1_000_000_000;

/// Conditions gathered from count tables.
#[derive(Default)]
pub struct Counts {
    conditions: Vec<ConditionData>,
    ids: Names,
    techniques: Names,
    files: Files,
}

impl Counts {
    /// Whether nothing was gathered.
    pub fn is_empty(&self) -> bool {
        self.conditions.is_empty()
    }

    /// The conditions in the order read.
    pub fn finish(self) -> Dataset {
        Dataset {
            notes: [("condition", &self.ids), ("technique", &self.techniques)]
                .into_iter()
                .flat_map(|(kind, names)| lookalikes::notes(kind, names, &self.files))
                .collect(),
            conditions: self.conditions,
            ..Dataset::default()
        }
    }

    /// Reads the rows of a file recognised by its header.
    ///
    /// # Errors
    /// [`InputError`] with file and line.
    pub fn read(&mut self, mut file: CsvFile) -> Result<Source, InputError> {
        let at = |name| file.column(name);
        let (Some(id), Some(a), Some(b), Some(votes_a), Some(votes_b)) = (
            at("condition"),
            at("technique_a"),
            at("technique_b"),
            at("votes_a"),
            at("votes_b"),
        ) else {
            return Err(super::layout::missing_columns(&file, REQUIRED));
        };
        let (hypothesis, scene) = (at("hypothesis"), at("scene"));
        let (chi_square, p) = (at("published_chi_square"), at("published_p"));
        self.files.begin(file.path(), 0);
        let path = file.path().display().to_string();
        let mut rows_used = 0;
        while let Some(row) = file.next_row()? {
            let condition = ConditionData {
                id: name(&row, id)?,
                technique_a: name(&row, a)?,
                technique_b: name(&row, b)?,
                hypothesis: optional(&row, hypothesis)?,
                scene: optional(&row, scene)?,
                published: Published {
                    chi_square: printed(&row, chi_square, 0.0..=f64::MAX, "0 or more")?,
                    p: printed(&row, p, 0.0..=1.0, "from 0 to 1")?,
                },
                votes: Votes {
                    a: votes(&row, votes_a)?,
                    b: votes(&row, votes_b)?,
                },
                ..ConditionData::default()
            };
            if condition.technique_a == condition.technique_b {
                return Err(row.row_error(format!(
                    "both techniques are `{}`; a pair needs two",
                    condition.technique_a
                )));
            }
            let here = self.files.here(row.line);
            for technique in [&condition.technique_a, &condition.technique_b] {
                self.techniques.number(technique.as_bytes(), here);
            }
            let number = self.ids.number(condition.id.as_bytes(), here);
            if let Some(before) = number.map(|it| it as usize)
                && before < self.conditions.len()
            {
                return Err(row.row_error(format!(
                    "condition {} stands here a second time; the first is {}. Remove one of them",
                    condition.id,
                    self.files.shown(self.ids.place(before)),
                )));
            }
            self.conditions.push(condition);
            rows_used += 1;
        }
        Ok(Source {
            path,
            kind: KIND,
            sha256: file.sha256(),
            rows_used,
            rows_left_out: 0,
        })
    }
}

fn name(row: &Row<'_>, column: usize) -> Result<String, InputError> {
    match row.text(column)? {
        "" => Err(row.error(column, "is empty, a name is needed")),
        text => Ok(text.to_owned()),
    }
}

/// A text, where the column is there and not empty.
fn optional(row: &Row<'_>, column: Option<usize>) -> Result<Option<String>, InputError> {
    let text = column.map(|at| row.text(at)).transpose()?;
    Ok(text.filter(|text| !text.is_empty()).map(str::to_owned))
}

/// A number as it was printed, digit for digit.
fn printed(
    row: &Row<'_>,
    column: Option<usize>,
    range: RangeInclusive<f64>,
    allowed: &str,
) -> Result<Option<String>, InputError> {
    let (Some(at), Some(text)) = (column, optional(row, column)?) else {
        return Ok(None);
    };
    match text.parse::<f64>() {
        Ok(value) if range.contains(&value) => Ok(Some(text)),
        _ => Err(row.error(
            at,
            &format!(
                "found `{}`, a number {allowed} as it was printed is needed, or nothing",
                shown(&text)
            ),
        )),
    }
}

fn votes(row: &Row<'_>, column: usize) -> Result<u32, InputError> {
    let allowed = format!("a whole number from 0 to {MOST_VOTES} is needed");
    let votes: u32 = row.number(column, &allowed)?;
    if votes > MOST_VOTES {
        return Err(row.error(column, &format!("found `{votes}`, {allowed}")));
    }
    Ok(votes)
}
