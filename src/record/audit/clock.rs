//! The times in the rows: an interval ends after it begins, and what comes later is later.

use std::path::Path;

use time::OffsetDateTime;
use time::format_description::well_known::Rfc3339;

use super::finding::{Findings, Severity};
use crate::record::TrialRow;
use crate::record::read::Rows;

const BROKEN: &str =
    "do not use the times of this trial; the version that wrote it may be at fault";

/// How far a response time may lie from the difference of its two ends: it is written
/// in milliseconds with a finite number of digits.
const ROUNDING_MS: f64 = 1e-3;

/// Checks the times of one data file. `grey_ns` is what the protocol asks for.
pub(super) fn check(path: &Path, rows: &Rows, grey_ns: Option<u64>, findings: &mut Findings) {
    let mut before: Option<&TrialRow> = None;
    for (row, &line) in rows.rows.iter().zip(&rows.lines) {
        let errors = backwards(row).into_iter().chain(response_time(row));
        for message in errors {
            findings.line(Severity::Error, (path, line), message, BROKEN);
        }
        if let Some(message) = grey_ns.and_then(|ns| short_grey(row, ns)) {
            let mend = "the display held up the grey's first frame or the program was suspended; consider leaving the trial out";
            findings.line(Severity::Warning, (path, line), message, mend);
        }
        for message in before.into_iter().flat_map(|before| overtaken(before, row)) {
            let mend = "somebody may have set the computer's clock, or the rows are not in the order they were written";
            findings.line(Severity::Warning, (path, line), message, mend);
        }
        before = Some(row);
    }
}

/// The instants of a trial in the order they must have, by column.
fn instants(row: &TrialRow) -> Vec<(&'static str, u64)> {
    let first = [
        ("first_onset_ns", row.first_onset_ns),
        ("first_offset_ns", row.first_offset_ns),
    ];
    let grey = [
        ("grey_onset_ns", row.grey_onset_ns),
        ("grey_offset_ns", row.grey_offset_ns),
    ];
    // Where images are rated, ranked or compared, the grey stands before them.
    let grey_first = matches!(&*row.procedure, "rating" | "reference" | "rank-order");
    let [one, other] = if grey_first {
        [grey, first]
    } else {
        [first, grey]
    };
    let rest = [
        ("second_onset_ns", row.second_onset_ns),
        ("second_offset_ns", row.second_offset_ns),
        ("question_onset_ns", row.question_onset_ns),
        ("response_ns", row.response_ns),
    ];
    one.into_iter()
        .chain(other)
        .chain(rest)
        .filter_map(|(column, ns)| Some((column, ns?)))
        .collect()
}

fn backwards(row: &TrialRow) -> Option<String> {
    let instants = instants(row);
    let pair = instants.windows(2).find(|pair| pair[1].1 < pair[0].1)?;
    let [(first, first_ns), (second, second_ns)] = [pair[0], pair[1]];
    Some(format!(
        "a negative duration: {second} is {second_ns}, {first} is {first_ns}"
    ))
}

fn response_time(row: &TrialRow) -> Option<String> {
    let told_ms = row.response_time_ms?;
    let (from, to) = (row.question_onset_ns?, row.response_ns?);
    let found_ms = to.checked_sub(from)? as f64 / 1e6;
    ((told_ms - found_ms).abs() > ROUNDING_MS).then(|| {
        format!("response_time_ms is {told_ms}, response_ns minus question_onset_ns is {found_ms}")
    })
}

fn short_grey(row: &TrialRow, planned_ns: u64) -> Option<String> {
    let shown_ns = row.grey_offset_ns?.checked_sub(row.grey_onset_ns?)?;
    // A grey of whole frames may miss the number by a part of one, and so may its times.
    let counted_ms = row.grey_frames.and(row.refresh_period_ms);
    let leeway_ns = counted_ms.map_or(0.0, |period_ms| period_ms * 0.5e6);
    ((shown_ns as f64) + leeway_ns < planned_ns as f64).then(|| {
        format!(
            "the grey stood {} ms, the protocol says {} ms",
            shown_ns as f64 / 1e6,
            planned_ns as f64 / 1e6
        )
    })
}

/// What lies before the row before, though it should lie after.
fn overtaken(before: &TrialRow, row: &TrialRow) -> Vec<String> {
    let mut found = Vec::new();
    let (last, first) = (instants(before).pop(), instants(row).into_iter().next());
    if let (true, Some(last), Some(first)) = (before.segment == row.segment, last, first)
        && first.1 < last.1
    {
        found.push(format!(
            "the trial begins at {} ns, before the answer to the one before at {} ns",
            first.1, last.1
        ));
    }
    let utc = |row: &TrialRow| OffsetDateTime::parse(&row.answered_utc, &Rfc3339).ok();
    match (utc(before), utc(row)) {
        (Some(earlier), Some(later)) if later < earlier => found.push(format!(
            "answered_utc is {}, before {} of the trial before",
            row.answered_utc, before.answered_utc
        )),
        (_, None) => found.push(format!("answered_utc is {:?}: no time", row.answered_utc)),
        _ => {}
    }
    found
}
