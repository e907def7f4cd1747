//! What a file is, by its columns.

use std::path::Path;

use super::csv_file::{CsvFile, shown};
use super::error::InputError;
use super::{count_table, judgement_tables, results, trial_table};

/// A layout that is recognised.
struct Layout {
    kind: &'static str,
    required: &'static [&'static str],
    /// Columns that are used where they are there.
    optional: Option<&'static [&'static str]>,
}

/// The layouts, in the order they are tried.
const LAYOUTS: [Layout; 5] = [
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
    Layout {
        kind: judgement_tables::RANKS,
        required: judgement_tables::RANKS_REQUIRED,
        optional: Some(&[]),
    },
    Layout {
        kind: judgement_tables::RATINGS,
        required: judgement_tables::RATINGS_REQUIRED,
        optional: Some(&[]),
    },
];

/// What a file is, by its columns. Columns nobody reads are noted.
///
/// # Errors
/// [`InputError`] saying what was found and what is known.
pub fn recognise(path: &Path, notes: &mut Vec<String>) -> Result<&'static str, InputError> {
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
pub fn missing_columns(file: &CsvFile, required: &[&str]) -> InputError {
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
    let may_have = match optional {
        [] => String::new(),
        some => format!("; a {} may also have {}", layout.kind, some.join(", ")),
    };
    (!unused.is_empty()).then(|| {
        format!(
            "{}: not used: {}{may_have}.",
            file.path().display(),
            unused.join(", "),
        )
    })
}
