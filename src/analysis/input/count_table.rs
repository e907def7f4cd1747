//! The count table: `condition,technique_a,technique_b,votes_a,votes_b[,hypothesis]`.

use std::collections::HashMap;

use super::csv_file::{CsvFile, Row};
use super::error::InputError;
use crate::analysis::dataset::{ConditionData, Source, Votes};

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
pub const OPTIONAL: &[&str] = &["hypothesis"];

/// Most votes for one technique; two of them and the sums over conditions stay exact.
const MOST_VOTES: u32 = 1_000_000_000;

/// Conditions gathered from count tables.
#[derive(Default)]
pub struct Counts {
    conditions: Vec<ConditionData>,
    /// Where each id was read.
    places: HashMap<String, String>,
}

impl Counts {
    /// Whether nothing was gathered.
    pub fn is_empty(&self) -> bool {
        self.conditions.is_empty()
    }

    /// The conditions in the order read.
    pub fn into_conditions(self) -> Vec<ConditionData> {
        self.conditions
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
            return Err(super::missing_columns(&file, REQUIRED));
        };
        let hypothesis = at("hypothesis");
        let path = file.path().display().to_string();
        let mut rows_used = 0;
        while let Some(row) = file.next_row()? {
            let condition = ConditionData {
                id: name(&row, id)?,
                technique_a: name(&row, a)?,
                technique_b: name(&row, b)?,
                hypothesis: hypothesis
                    .map(|at| row.text(at))
                    .transpose()?
                    .filter(|text| !text.is_empty())
                    .map(str::to_owned),
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
            let here = format!("{path}:{}", row.line);
            if let Some(before) = self.places.insert(condition.id.clone(), here) {
                return Err(row.row_error(format!(
                    "condition {} stands here a second time; the first is {before}. Remove one of them",
                    condition.id
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

fn votes(row: &Row<'_>, column: usize) -> Result<u32, InputError> {
    let allowed = format!("a whole number from 0 to {MOST_VOTES} is needed");
    let votes: u32 = row.number(column, &allowed)?;
    if votes > MOST_VOTES {
        return Err(row.error(column, &format!("found `{votes}`, {allowed}")));
    }
    Ok(votes)
}
