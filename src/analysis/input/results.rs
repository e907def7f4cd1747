//! Greyfield's own results: a folder with `study.json` and `data/…_data.csv`, or one such file.
//! The rows come from [`record`](crate::record), which tests every line's checksum.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::csv_file::shown;
use super::error::InputError;
use super::judgements::Judgement;
use super::studies::{Studies, folder_of};
use super::trials::Observation;
use super::{Gathered, Options};
use crate::analysis::dataset::Source;
use crate::digest;
use crate::protocol::Phase;
use crate::record::row::LIST_SEPARATOR;
use crate::record::{self, DATA_FOLDER, DATA_SUFFIX, InputDevice, Response, TrialRow};

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
    no_answer: u64,
    cannot_tell: u64,
    /// Trials of each rejected participant.
    rejected: BTreeMap<String, u64>,
    /// Trials a scripted observer answered; they are used, and reported.
    scripted: u64,
}

/// Whether a folder is a results folder.
pub fn is_results_folder(folder: &Path) -> bool {
    folder.join(record::study::STUDY_FILE).is_file() || folder.join(DATA_FOLDER).is_dir()
}

/// The data files of a results folder in the order of their first answers, so that participants
/// appear in the order they took part: tests that may be looked at early need it.
///
/// # Errors
/// [`InputError`] for a folder that cannot be read or has no data files.
pub fn data_files(folder: &Path) -> Result<Vec<PathBuf>, InputError> {
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
    files.sort_by_cached_key(|path| (first_answer(path), path.clone()));
    if files.is_empty() {
        return Err(InputError::whole(
            folder,
            "the results folder has no data files under data/ yet; run a session first",
        ));
    }
    Ok(files)
}

/// Wall-clock time of a file's first answer, ISO 8601; empty where there is none. What is wrong
/// with the file is said when it is read.
fn first_answer(path: &Path) -> String {
    let Ok(mut reader) = csv::Reader::from_path(path) else {
        return String::new();
    };
    let time = |header: &csv::StringRecord| header.iter().position(|name| name == "answered_utc");
    let Some(column) = reader.headers().ok().and_then(time) else {
        return String::new();
    };
    let row = reader.records().next().and_then(Result::ok);
    row.and_then(|row| row.get(column).map(str::to_owned))
        .unwrap_or_default()
}

/// Reads one session file. Damaged lines are passed over and noted.
///
/// # Errors
/// [`InputError`] with file and line.
pub fn read(
    path: &Path,
    gathered: &mut Gathered,
    options: Options,
    studies: &mut Studies,
    left_out: &mut LeftOut,
    notes: &mut Vec<String>,
) -> Result<Source, InputError> {
    let number = study_of(path, gathered, studies, notes)?;
    gathered.trials.begin_file(path, number);
    gathered.ratings.begin_file(path, number);
    gathered.rankings.begin_file(path, number);
    let read = record::read_rows(path)?;
    notes.extend(read.warnings.iter().map(ToString::to_string));
    let study = studies.get(number);
    let (mut rows_used, mut rows_left_out) = (0, 0);
    for (row, &line) in read.rows.iter().zip(&read.lines) {
        if !options.include_rejected && study.rejected.contains(&row.participant_id) {
            *left_out
                .rejected
                .entry(row.participant_id.clone())
                .or_default() += 1;
            rows_left_out += 1;
            continue;
        }
        if options.include_pilot || !row.pilot {
            study.see(row);
        }
        if let Some(count) = left_out.reason(row, options) {
            *count += 1;
            rows_left_out += 1;
            continue;
        }
        left_out.scripted += u64::from(row.input_device == InputDevice::Scripted);
        add(row, path, line, gathered)?;
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

/// The number of the study a data file is of. The study's base orders are declared with its first
/// file.
fn study_of(
    path: &Path,
    gathered: &mut Gathered,
    studies: &mut Studies,
    notes: &mut Vec<String>,
) -> Result<u32, InputError> {
    let folder = folder_of(path);
    let (number, is_new) = studies.number(&folder, notes)?;
    if let (true, Some(identity)) = (is_new, &studies.get(number).identity) {
        let file = folder.join(record::study::STUDY_FILE);
        gathered
            .trials
            .declare(&file, number, &identity.conditions)?;
        for condition in &identity.conditions {
            let (id, techniques) = (&condition.id, &condition.techniques);
            gathered.rankings.declare(id, techniques);
            let view = techniques.first().map_or(&**id, |only| view_of(id, only));
            gathered.ratings.declare(view, techniques);
        }
    }
    Ok(number)
}

/// The condition that versions of one view share: single images are named `SCENE-LIGHT-TECHNIQUE`.
fn view_of<'a>(condition: &'a str, technique: &str) -> &'a str {
    condition
        .strip_suffix(technique)
        .and_then(|rest| rest.strip_suffix('-'))
        .filter(|view| !view.is_empty())
        .unwrap_or(condition)
}

/// Adds what a row holds: a choice, ratings of one image, or a ranking.
fn add(row: &TrialRow, path: &Path, line: u64, gathered: &mut Gathered) -> Result<(), InputError> {
    let response_time_ms = row.response_time_ms.map(|time| time as f32);
    let participant = row.participant_id.as_bytes();
    if row.response.is_some() {
        return gathered.trials.add(&Observation {
            participant,
            condition: row.condition.as_bytes(),
            first_technique: row.technique_first.as_bytes(),
            second_technique: row.technique_second.as_bytes(),
            chosen: row.response.and_then(Response::position),
            response_time_ms,
            hypothesis: None,
            scene: row.scene.as_bytes(),
            line,
        });
    }
    for rating in items(&row.ratings) {
        let given = rating.split_once('=').and_then(|(scale, points)| {
            let points: f32 = points.trim().parse().ok()?;
            (points.is_finite() && !scale.is_empty()).then_some((scale, points))
        });
        let Some((scale, value)) = given else {
            let message = format!(
                "column `ratings`: found `{}`, `scale=points` with {LIST_SEPARATOR} between them is needed",
                shown(rating)
            );
            return Err(InputError::line(path, line, message));
        };
        gathered.ratings.add(&Judgement {
            participant,
            condition: view_of(&row.condition, &row.technique_first).as_bytes(),
            technique: row.technique_first.as_bytes(),
            scale: scale.as_bytes(),
            value,
            response_time_ms,
            line,
        })?;
    }
    for (place, technique) in (1_u16..).zip(items(&row.ranking)) {
        gathered.rankings.add(&Judgement {
            participant,
            condition: row.condition.as_bytes(),
            technique: technique.as_bytes(),
            scale: b"",
            value: f32::from(place),
            response_time_ms,
            line,
        })?;
    }
    Ok(())
}

/// The items of a list in one cell; none of an empty cell.
fn items(cell: &str) -> impl Iterator<Item = &str> {
    let items = cell.split(LIST_SEPARATOR);
    items.filter(move |_| !cell.is_empty())
}

impl LeftOut {
    /// The count of the reason why a row does not count; `None` if it does.
    fn reason(&mut self, row: &TrialRow, options: Options) -> Option<&mut u64> {
        match row.phase {
            Phase::Practice => Some(&mut self.practice),
            Phase::Catch => Some(&mut self.catch),
            Phase::Main if row.pilot && !options.include_pilot => Some(&mut self.pilot),
            Phase::Main => match row.response {
                Some(Response::CannotTell) => Some(&mut self.cannot_tell),
                None if row.ratings.is_empty() && row.ranking.is_empty() => {
                    Some(&mut self.no_answer)
                }
                _ => None,
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
            (self.no_answer, "trials hold no answer and are left out"),
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
