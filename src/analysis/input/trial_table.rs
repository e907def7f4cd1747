//! The plain trial table:
//! `participant,condition,first_technique,second_technique,chosen[,rt_ms][,hypothesis][,scene]`.

use super::csv_file::{CsvFile, Row, shown};
use super::error::InputError;
use super::trials::{Observation, Trials};
use crate::analysis::dataset::Source;
use crate::protocol::Position;

/// What the file is called in reports.
pub const KIND: &str = "trial table";
/// Columns that must be there.
pub const REQUIRED: &[&str] = &[
    "participant",
    "condition",
    "first_technique",
    "second_technique",
    "chosen",
];
/// Columns that may be.
pub const OPTIONAL: &[&str] = &["rt_ms", "hypothesis", "scene"];

/// Reads the rows of a file recognised by its header.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read(mut file: CsvFile, trials: &mut Trials) -> Result<Source, InputError> {
    trials.begin_file(file.path(), 0);
    let at = |name| file.column(name);
    let (Some(participant), Some(condition), Some(first), Some(second), Some(chosen)) = (
        at("participant"),
        at("condition"),
        at("first_technique"),
        at("second_technique"),
        at("chosen"),
    ) else {
        return Err(super::layout::missing_columns(&file, REQUIRED));
    };
    let (rt_ms, hypothesis, scene) = (at("rt_ms"), at("hypothesis"), at("scene"));
    let mut rows_used = 0;
    while let Some(row) = file.next_row()? {
        trials.add(&Observation {
            participant: row.bytes(participant),
            condition: row.bytes(condition),
            first_technique: row.bytes(first),
            second_technique: row.bytes(second),
            chosen: position(&row, chosen, first, second)?,
            response_time_ms: rt_ms.map_or(Ok(None), |at| milliseconds(&row, at))?,
            hypothesis: hypothesis.map(|at| row.text(at)).transpose()?,
            scene: scene.map_or(&[], |at| row.bytes(at)),
            line: row.line,
        })?;
        rows_used += 1;
    }
    Ok(Source {
        path: file.path().display().to_string(),
        kind: KIND,
        sha256: file.sha256(),
        rows_used,
        rows_left_out: 0,
    })
}

/// `first`, `second`, or empty for a trial without an answer.
fn position(
    row: &Row<'_>,
    column: usize,
    first: usize,
    second: usize,
) -> Result<Option<Position>, InputError> {
    match row.bytes(column) {
        b"first" => Ok(Some(Position::First)),
        b"second" => Ok(Some(Position::Second)),
        b"" => Ok(None),
        other => {
            let meant = if other == row.bytes(first) {
                "; that technique was shown first here, so `first` is meant"
            } else if other == row.bytes(second) {
                "; that technique was shown second here, so `second` is meant"
            } else {
                ""
            };
            Err(row.error(
                column,
                &format!(
                    "found `{}`, allowed is `first`, `second`, or nothing for a missing answer{meant}",
                    shown(&String::from_utf8_lossy(other))
                ),
            ))
        }
    }
}

/// A time in milliseconds, or nothing.
fn milliseconds(row: &Row<'_>, column: usize) -> Result<Option<f32>, InputError> {
    const ALLOWED: &str = "a time in milliseconds, 0 or more, or nothing is needed";
    if row.bytes(column).is_empty() {
        return Ok(None);
    }
    let value: f32 = row.number(column, ALLOWED)?;
    if value.is_finite() && value >= 0.0 {
        Ok(Some(value))
    } else {
        Err(row.error(column, &format!("found `{value}`, {ALLOWED}")))
    }
}
