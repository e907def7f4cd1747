//! Reads whatever holds the choices: a results folder, session files, a plain trial table or a
//! table of counts. A file is recognised by its columns.

mod count_table;
mod csv_file;
mod error;
mod names;
mod results;
#[cfg(test)]
mod tests;
mod trial_table;
mod trials;

use std::path::{Path, PathBuf};

use super::dataset::Dataset;
use count_table::Counts;
use csv_file::{CsvFile, shown};
pub use error::InputError;
use trials::Trials;

/// What to take in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// Count pilot sessions too.
    pub include_pilot: bool,
    /// Count participants the experimenter has rejected too.
    pub include_rejected: bool,
}

/// A layout that is recognised.
struct Layout {
    kind: &'static str,
    required: &'static [&'static str],
    /// Columns that are used where they are there.
    optional: Option<&'static [&'static str]>,
}

/// The layouts, in the order they are tried.
const LAYOUTS: [Layout; 3] = [
    Layout {
        kind: results::KIND,
        required: results::REQUIRED,
        // A session file has many columns more, each of them Greyfield's own.
        optional: None,
    },
    Layout {
        kind: trial_table::KIND,
        required: trial_table::REQUIRED,
        optional: Some(trial_table::OPTIONAL),
    },
    Layout {
        kind: count_table::KIND,
        required: count_table::REQUIRED,
        optional: Some(count_table::OPTIONAL),
    },
];

/// Reads the inputs, files and folders, into one dataset.
///
/// # Errors
/// [`InputError`] naming file and line, what was found, what is allowed.
pub fn read(inputs: &[PathBuf], options: Options) -> Result<Dataset, InputError> {
    let (mut trials, mut counts) = (Trials::default(), Counts::default());
    let mut left_out = results::LeftOut::default();
    let (mut sources, mut notes) = (Vec::new(), Vec::new());
    let files = files_of(inputs, &mut trials)?;
    for (path, known) in &files {
        let kind = known.map_or_else(|| recognise(path, &mut notes), Ok)?;
        sources.push(match kind {
            results::KIND => results::read(path, &mut trials, options, &mut left_out, &mut notes)?,
            count_table::KIND => counts.read(CsvFile::open(path)?)?,
            _ => trial_table::read(CsvFile::open(path)?, &mut trials)?,
        });
        if !counts.is_empty() && !trials.is_empty() {
            return Err(InputError::whole(
                path,
                "counts and single answers cannot be analysed together; give one kind",
            ));
        }
    }
    notes.extend(left_out.notes());
    if counts.is_empty() && trials.is_empty() {
        return Err(nothing_left(&files, &notes));
    }
    let mut data = if counts.is_empty() {
        trials.finish()?
    } else {
        Dataset {
            conditions: counts.into_conditions(),
            ..Dataset::default()
        }
    };
    data.sources = sources;
    data.notes = notes;
    Ok(data)
}

/// A file, and what it is where the folder says so.
type Found = (PathBuf, Option<&'static str>);

/// The files of all inputs, folders opened, in the order given.
fn files_of(inputs: &[PathBuf], trials: &mut Trials) -> Result<Vec<Found>, InputError> {
    let mut all = Vec::new();
    for input in inputs {
        if !input.is_dir() {
            all.push((input.clone(), None));
        } else if results::is_results_folder(input) {
            let files = results::data_files(input, trials)?;
            all.extend(files.into_iter().map(|file| (file, Some(results::KIND))));
        } else {
            let files = csv_files_in(input)?;
            if files.is_empty() {
                return Err(InputError::whole(
                    input,
                    "the folder has no data; a results folder (with data/…_data.csv) or CSV files are needed",
                ));
            }
            all.extend(files.into_iter().map(|file| (file, None)));
        }
    }
    Ok(all)
}

/// The CSV files directly in a folder, sorted by name so that the order never depends on the disk.
fn csv_files_in(folder: &Path) -> Result<Vec<PathBuf>, InputError> {
    let unreadable = |error| InputError::unreadable(folder, error);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|extension| extension == "csv") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// What a file is, by its columns. Columns nobody reads are noted.
fn recognise(path: &Path, notes: &mut Vec<String>) -> Result<&'static str, InputError> {
    let file = CsvFile::open(path)?;
    let layout = layout_of(&file)?;
    notes.extend(unused_columns(&file, layout));
    Ok(layout.kind)
}

fn layout_of(file: &CsvFile) -> Result<&'static Layout, InputError> {
    let missing = |layout: &Layout| {
        layout
            .required
            .iter()
            .filter(|name| file.column(name).is_none())
            .count()
    };
    if let Some(layout) = LAYOUTS.iter().find(|layout| missing(layout) == 0) {
        return Ok(layout);
    }
    for (column, kind) in [("rank", "rank"), ("rating", "rating")] {
        if file.column(column).is_some() && file.column("technique").is_some() {
            return Err(InputError::whole(
                file.path(),
                format!(
                    "this is a {kind} table; this version analyses choices between two images only"
                ),
            ));
        }
    }
    // The closest layout is the one that the writer most likely meant.
    let closest = LAYOUTS
        .iter()
        .min_by_key(|layout| (missing(layout) * 100) / layout.required.len())
        .filter(|layout| missing(layout) * 2 <= layout.required.len());
    Err(match closest {
        Some(layout) => missing_columns(file, layout.required),
        None => {
            let layouts: Vec<String> = LAYOUTS
                .iter()
                .map(|layout| format!("{} ({})", layout.required.join(","), layout.kind))
                .collect();
            InputError::line(
                file.path(),
                1,
                format!(
                    "the columns {} belong to no table known; known are {}",
                    found_columns(file),
                    layouts.join("; "),
                ),
            )
        }
    })
}

/// The error for a header that lacks columns.
fn missing_columns(file: &CsvFile, required: &[&str]) -> InputError {
    let missing: Vec<&str> = required
        .iter()
        .copied()
        .filter(|name| file.column(name).is_none())
        .collect();
    InputError::line(
        file.path(),
        1,
        format!(
            "the header lacks {}; found {}, needed {}",
            missing
                .iter()
                .map(|name| format!("`{name}`"))
                .collect::<Vec<_>>()
                .join(", "),
            found_columns(file),
            required.join(","),
        ),
    )
}

fn found_columns(file: &CsvFile) -> String {
    const MOST: usize = 300;
    let names: Vec<String> = file.header().iter().map(|name| shown(name)).collect();
    let mut joined = names.join(",");
    if joined.chars().count() > MOST {
        joined = joined.chars().take(MOST).collect::<String>() + "…";
    }
    joined
}

/// A note on columns nobody reads: they may be a misspelt optional one.
fn unused_columns(file: &CsvFile, layout: &Layout) -> Option<String> {
    let optional = layout.optional?;
    let unused: Vec<String> = file
        .header()
        .iter()
        .filter(|name| {
            !layout.required.contains(&name.as_str()) && !optional.contains(&name.as_str())
        })
        .map(|name| format!("`{}`", shown(name)))
        .collect();
    (!unused.is_empty()).then(|| {
        format!(
            "{}: not used: {}; a {} may also have {}.",
            file.path().display(),
            unused.join(", "),
            layout.kind,
            optional.join(", "),
        )
    })
}

fn nothing_left(files: &[Found], notes: &[String]) -> InputError {
    let path = files.first().map_or(Path::new(""), |(path, _)| path);
    InputError::whole(
        path,
        format!(
            "no trial to analyse: {}{}",
            if files.len() == 1 {
                "the file has no data row that counts"
            } else {
                "none of the files has a data row that counts"
            },
            notes
                .iter()
                .map(|note| format!(" ({note})"))
                .collect::<String>(),
        ),
    )
}
