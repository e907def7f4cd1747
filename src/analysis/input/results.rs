//! Greyfield's own results: a folder with `study.json` and `data/…_data.csv`, or one such file.
//! The rows come from [`record`](crate::record), which tests every line's checksum.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use super::Options;
use super::error::InputError;
use super::trials::{Observation, Trials};
use crate::analysis::dataset::Source;
use crate::digest;
use crate::protocol::Phase;
use crate::record::{
    self, DATA_FOLDER, DATA_SUFFIX, InputDevice, Response, StudyIdentity, TrialRow,
};

/// What a data file is called in reports.
pub const KIND: &str = "session file";
/// Columns by which a session file is recognised.
pub const REQUIRED: &[&str] = &[
    "row_id",
    "participant_id",
    "condition",
    "technique_first",
    "technique_second",
    "response",
    "row_crc32",
];

/// Rows that do not count, by reason.
#[derive(Debug, Default)]
pub struct LeftOut {
    practice: u64,
    catch: u64,
    pilot: u64,
    /// Ratings and rankings.
    no_choice: u64,
    cannot_tell: u64,
    /// Trials of each rejected participant.
    rejected: BTreeMap<String, u64>,
    /// Who was rejected, by results folder: read once.
    rejections: HashMap<PathBuf, BTreeSet<String>>,
    /// Trials a scripted observer answered; they are used, and reported.
    scripted: u64,
}

/// Whether a folder is a results folder.
pub fn is_results_folder(folder: &Path) -> bool {
    folder.join("study.json").is_file() || folder.join(DATA_FOLDER).is_dir()
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
    let data = folder.join(DATA_FOLDER);
    let mut files = if data.is_dir() {
        super::csv_files_in(&data)?
    } else {
        Vec::new()
    };
    files.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(DATA_SUFFIX) && !name.starts_with('.')
    });
    if files.is_empty() {
        return Err(InputError::whole(
            folder,
            "the results folder has no data files under data/ yet; run a session first",
        ));
    }
    Ok(files)
}

/// Reads one session file. Damaged lines are passed over and noted.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read(
    path: &Path,
    trials: &mut Trials,
    options: Options,
    left_out: &mut LeftOut,
    notes: &mut Vec<String>,
) -> Result<Source, InputError> {
    trials.begin_file(path);
    let read = record::read_rows(path)?;
    notes.extend(read.warnings.iter().map(ToString::to_string));
    let rejected = left_out.rejected_beside(path)?;
    let (mut rows_used, mut rows_left_out) = (0, 0);
    for (row, &line) in read.rows.iter().zip(&read.lines) {
        if let Some(count) = left_out.reason(row, &rejected, options) {
            *count += 1;
            rows_left_out += 1;
            continue;
        }
        left_out.scripted += u64::from(row.input_device == InputDevice::Scripted);
        trials.add(&Observation {
            participant: row.participant_id.as_bytes(),
            condition: row.condition.as_bytes(),
            first_technique: row.technique_first.as_bytes(),
            second_technique: row.technique_second.as_bytes(),
            chosen: row.response.and_then(Response::position),
            response_time_ms: row.response_time_ms.map(|time| time as f32),
            hypothesis: None,
            line,
        })?;
        rows_used += 1;
    }
    let sha256 = digest::sha256_file(path).map_err(|error| InputError::unreadable(path, error))?;
    Ok(Source {
        path: path.display().to_string(),
        kind: KIND,
        sha256,
        rows_used,
        rows_left_out,
    })
}

impl LeftOut {
    /// Who was rejected in the results folder that a data file stands in.
    fn rejected_beside(&mut self, file: &Path) -> Result<BTreeSet<String>, InputError> {
        let results = file.parent().unwrap_or(Path::new("")).join("..");
        if let Some(known) = self.rejections.get(&results) {
            return Ok(known.clone());
        }
        let ids: BTreeSet<String> = record::rejections(&results)?.into_keys().collect();
        self.rejections.insert(results, ids.clone());
        Ok(ids)
    }

    /// The count of the reason why a row does not count; `None` if it does.
    fn reason(
        &mut self,
        row: &TrialRow,
        rejected: &BTreeSet<String>,
        options: Options,
    ) -> Option<&mut u64> {
        if !options.include_rejected && rejected.contains(&row.participant_id) {
            return Some(self.rejected.entry(row.participant_id.clone()).or_default());
        }
        match row.phase {
            Phase::Practice => Some(&mut self.practice),
            Phase::Catch => Some(&mut self.catch),
            Phase::Main if row.pilot && !options.include_pilot => Some(&mut self.pilot),
            Phase::Main => match row.response {
                None => Some(&mut self.no_choice),
                Some(Response::CannotTell) => Some(&mut self.cannot_tell),
                Some(_) => None,
            },
        }
    }

    /// What to say about rows that do not count, or that no person answered.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (count, what) in [
            (self.practice, "practice trials are left out"),
            (self.catch, "catch trials are left out"),
            (
                self.pilot,
                "trials of pilot sessions are left out; --include-pilot takes them in",
            ),
            (
                self.no_choice,
                "trials are ratings or rankings, not choices, and are left out",
            ),
            (
                self.cannot_tell,
                "trials were answered by \"cannot tell\" and are left out of the choices",
            ),
            (
                self.scripted,
                "trials were answered by a scripted observer, not by a person",
            ),
        ] {
            if count > 0 {
                notes.push(format!("{count} {what}."));
            }
        }
        if !self.rejected.is_empty() {
            let ids: Vec<&str> = self.rejected.keys().map(String::as_str).collect();
            notes.push(format!(
                "{} rejected participants are left out ({}), {} trials; --include-rejected takes them in.",
                ids.len(),
                ids.join(", "),
                self.rejected.values().sum::<u64>(),
            ));
        }
        notes
    }
}
