//! The plain trial table:
//! `participant,condition,first_technique,second_technique,chosen[,rt_ms][,hypothesis]`.

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
pub const OPTIONAL: &[&str] = &["rt_ms", "hypothesis"];

/// Reads the rows of a file recognised by its header.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read(mut file: CsvFile, trials: &mut Trials) -> Result<Source, InputError> {
    trials.begin_file(file.path());
    let at = |name| file.column(name);
    let (Some(participant), Some(condition), Some(first), Some(second), Some(chosen)) = (
        at("participant"),
        at("condition"),
        at("first_technique"),
        at("second_technique"),
        at("chosen"),
    ) else {
        return Err(super::missing_columns(&file, REQUIRED));
    };
    let (rt_ms, hypothesis) = (at("rt_ms"), at("hypothesis"));
    let mut rows_used = 0;
    while let Some(row) = file.next_row()? {
        trials.add(&Observation {
            participant: row.bytes(participant),
            condition: row.bytes(condition),
            first_technique: row.bytes(first),
            second_technique: row.bytes(second),
            chosen: position(&row, chosen)?,
            response_time_ms: rt_ms.map_or(Ok(None), |at| milliseconds(&row, at))?,
            hypothesis: hypothesis.map(|at| row.text(at)).transpose()?,
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
pub fn position(row: &Row<'_>, column: usize) -> Result<Option<Position>, InputError> {
    match row.bytes(column) {
        b"first" => Ok(Some(Position::First)),
        b"second" => Ok(Some(Position::Second)),
        b"" => Ok(None),
        other => Err(row.error(
            column,
            &format!(
                "found `{}`, allowed is `first`, `second`, or nothing for a missing answer",
                shown(&String::from_utf8_lossy(other))
            ),
        )),
    }
}

/// A time in milliseconds, or nothing.
pub fn milliseconds(row: &Row<'_>, column: usize) -> Result<Option<f32>, InputError> {
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
