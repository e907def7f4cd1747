//! Greyfield's own results: a folder with `study.json` and `data/…_data.csv`, or one such file.

use std::path::{Path, PathBuf};

use super::csv_file::CsvFile;
use super::error::InputError;
use super::trial_table::{milliseconds, position};
use super::trials::{Observation, Trials};
use super::{Options, csv_files_in};
use crate::analysis::dataset::Source;
use crate::record::StudyIdentity;

/// What a data file is called in reports.
pub const KIND: &str = "session file";
/// Columns by which a session file is recognised.
pub const REQUIRED: &[&str] = &[
    "participant_id",
    "condition",
    "technique_first",
    "technique_second",
    "response",
    "phase",
    "pilot",
];

/// Rows that do not count, by reason.
#[derive(Debug, Default, Clone, Copy)]
pub struct LeftOut {
    /// Practice trials.
    pub practice: u64,
    /// Attention checks.
    pub catch: u64,
    /// Trials of a pilot.
    pub pilot: u64,
    /// Trials a scripted observer answered; they are used, and reported.
    pub scripted: u64,
}

/// Whether a folder is a results folder.
pub fn is_results_folder(folder: &Path) -> bool {
    folder.join("study.json").is_file() || folder.join("data").is_dir()
}

/// The data files of a results folder, sorted by name. The study's base orders are declared first.
///
/// # Errors
/// [`InputError`] for a folder that cannot be read or has no data files.
pub fn data_files(folder: &Path, trials: &mut Trials) -> Result<Vec<PathBuf>, InputError> {
    let study = folder.join("study.json");
    if study.is_file() {
        let text = std::fs::read_to_string(&study)
            .map_err(|error| InputError::unreadable(&study, error))?;
        let identity: StudyIdentity = serde_json::from_str(&text)
            .map_err(|error| InputError::whole(&study, format!("not a study: {error}")))?;
        trials.declare(&study, &identity.conditions)?;
    }
    let data = folder.join("data");
    let files = if data.is_dir() {
        csv_files_in(&data)?
    } else {
        Vec::new()
    };
    if files.is_empty() {
        return Err(InputError::whole(
            folder,
            "the results folder has no data files under data/ yet; run a session first",
        ));
    }
    Ok(files)
}

/// Reads one session file.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read(
    mut file: CsvFile,
    trials: &mut Trials,
    options: Options,
    left_out: &mut LeftOut,
) -> Result<Source, InputError> {
    trials.begin_file(file.path());
    let at = |name| file.column(name);
    let (Some(participant), Some(condition), Some(first), Some(second), Some(response)) = (
        at("participant_id"),
        at("condition"),
        at("technique_first"),
        at("technique_second"),
        at("response"),
    ) else {
        return Err(super::missing_columns(&file, REQUIRED));
    };
    let (Some(phase), Some(pilot)) = (at("phase"), at("pilot")) else {
        return Err(super::missing_columns(&file, REQUIRED));
    };
    let (time, device) = (at("response_time_ms"), at("input_device"));
    let (mut rows_used, mut rows_left_out) = (0, 0);
    while let Some(row) = file.next_row()? {
        let reason = match (row.bytes(phase), row.bytes(pilot)) {
            (b"practice", _) => Some(&mut left_out.practice),
            (b"catch", _) => Some(&mut left_out.catch),
            (b"main", b"true") if !options.include_pilot => Some(&mut left_out.pilot),
            (b"main", b"true" | b"false") => None,
            (b"main", _) => {
                return Err(row.error(pilot, "allowed is `true` or `false`"));
            }
            _ => {
                return Err(row.error(phase, "allowed is `practice`, `catch` or `main`"));
            }
        };
        if let Some(count) = reason {
            *count += 1;
            rows_left_out += 1;
            continue;
        }
        if device.is_some_and(|at| row.bytes(at) == b"scripted") {
            left_out.scripted += 1;
        }
        trials.add(&Observation {
            participant: row.bytes(participant),
            condition: row.bytes(condition),
            first_technique: row.bytes(first),
            second_technique: row.bytes(second),
            chosen: position(&row, response)?,
            response_time_ms: time.map_or(Ok(None), |at| milliseconds(&row, at))?,
            hypothesis: None,
            line: row.line,
        })?;
        rows_used += 1;
    }
    Ok(Source {
        path: file.path().display().to_string(),
        kind: KIND,
        sha256: file.sha256(),
        rows_used,
        rows_left_out,
    })
}

/// What to say about rows that do not count, or that no person answered.
pub fn notes(left_out: &LeftOut) -> Vec<String> {
    let mut notes = Vec::new();
    for (count, what) in [
        (left_out.practice, "practice trials are left out"),
        (left_out.catch, "catch trials are left out"),
        (
            left_out.pilot,
            "trials of pilot sessions are left out; --include-pilot takes them in",
        ),
        (
            left_out.scripted,
            "trials were answered by a scripted observer, not by a person",
        ),
    ] {
        if count > 0 {
            notes.push(format!("{count} {what}."));
        }
    }
    notes
}
