//! The plain tables of ranks and ratings: `participant,condition,technique,rank` and
//! `participant,condition,technique,scale,rating`.

use super::csv_file::{CsvFile, Row, shown};
use super::error::InputError;
use super::judgements::{Judgement, Judgements};
use crate::analysis::dataset::Source;

/// What a table of ranks is called in reports.
pub const RANKS: &str = "rank table";
/// Columns that it must have.
pub const RANKS_REQUIRED: &[&str] = &["participant", "condition", "technique", "rank"];
/// What a table of ratings is called in reports.
pub const RATINGS: &str = "rating table";
/// Columns that it must have.
pub const RATINGS_REQUIRED: &[&str] = &["participant", "condition", "technique", "scale", "rating"];

/// Reads the rows of a table of ranks.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read_ranks(file: CsvFile, ranks: &mut Judgements) -> Result<Source, InputError> {
    let known = |value: f32| value >= 1.0;
    let table = Table {
        kind: RANKS,
        required: RANKS_REQUIRED,
        value: "rank",
        scale: None,
        allowed: "a rank is a number from 1, the best",
        known,
    };
    table.read(file, ranks)
}

/// Reads the rows of a table of ratings.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read_ratings(file: CsvFile, ratings: &mut Judgements) -> Result<Source, InputError> {
    let table = Table {
        kind: RATINGS,
        required: RATINGS_REQUIRED,
        value: "rating",
        scale: Some("scale"),
        allowed: "a rating is a finite number; leave the row out where there is none",
        known: |_| true,
    };
    table.read(file, ratings)
}

struct Table {
    kind: &'static str,
    required: &'static [&'static str],
    value: &'static str,
    scale: Option<&'static str>,
    allowed: &'static str,
    known: fn(f32) -> bool,
}

impl Table {
    fn read(&self, mut file: CsvFile, into: &mut Judgements) -> Result<Source, InputError> {
        into.begin_file(file.path(), 0);
        let at = |name| file.column(name);
        let (Some(participant), Some(condition), Some(technique), Some(value)) = (
            at("participant"),
            at("condition"),
            at("technique"),
            at(self.value),
        ) else {
            return Err(super::layout::missing_columns(&file, self.required));
        };
        let scale = self.scale.and_then(at);
        let mut rows_used = 0;
        while let Some(row) = file.next_row()? {
            let name = scale.map_or(&b""[..], |at| row.bytes(at));
            if let Some(at) = scale
                && name.is_empty()
            {
                return Err(row.error(at, "is empty, a name is needed"));
            }
            into.add(&Judgement {
                participant: row.bytes(participant),
                condition: row.bytes(condition),
                technique: row.bytes(technique),
                scale: name,
                value: self.number(&row, value)?,
                response_time_ms: None,
                line: row.line,
            })?;
            rows_used += 1;
        }
        Ok(Source {
            path: file.path().display().to_string(),
            kind: self.kind,
            sha256: file.sha256(),
            rows_used,
            rows_left_out: 0,
        })
    }

    fn number(&self, row: &Row<'_>, column: usize) -> Result<f32, InputError> {
        let value: f32 = row.number(column, self.allowed)?;
        if value.is_finite() && (self.known)(value) {
            return Ok(value);
        }
        let found = shown(row.text(column)?);
        Err(row.error(column, &format!("found `{found}`, {}", self.allowed)))
    }
}
