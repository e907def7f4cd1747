//! Reads whatever holds the answers: a results folder, session files, a plain table of trials,
//! ranks or ratings, or a table of counts. A file is recognised by its columns.

mod count_table;
mod csv_file;
mod error;
mod files;
mod judgement_tables;
mod judgements;
mod layout;
mod lookalikes;
mod names;
mod results;
mod rules;
mod studies;
#[cfg(test)]
mod tests;
mod trial_table;
mod trials;

use std::path::{Path, PathBuf};

use super::dataset::{Dataset, Source};
use count_table::Counts;
use csv_file::CsvFile;
pub use error::InputError;
use judgements::Judgements;
use rules::Rules;
use studies::Studies;
use trials::Trials;

/// What to take in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Options {
    /// Count pilot sessions too.
    pub include_pilot: bool,
    /// Count participants the experimenter has rejected too.
    pub include_rejected: bool,
    /// Leave out trials answered in less than this, whatever the protocol says.
    pub minimum_response_ms: Option<f64>,
    /// Leave out trials answered in more.
    pub maximum_response_ms: Option<f64>,
}

/// What was read so far; of the four kinds one alone can be analysed.
#[derive(Default)]
struct Gathered {
    trials: Trials,
    counts: Counts,
    ratings: Judgements,
    rankings: Judgements,
}

/// Reads the inputs, files and folders, into one dataset.
///
/// # Errors
/// [`InputError`] naming file and line, what was found, what is allowed.
pub fn read(inputs: &[PathBuf], options: Options) -> Result<Dataset, InputError> {
    let mut gathered = Gathered::default();
    let mut left_out = results::LeftOut::default();
    let mut studies = Studies::default();
    let (mut sources, mut notes) = (Vec::new(), Vec::new());
    let files = files_of(inputs)?;
    for (path, known) in &files {
        let kind = known.map_or_else(|| layout::recognise(path, &mut notes), Ok)?;
        sources.push(if kind == results::KIND {
            results::read(
                path,
                &mut gathered,
                options,
                &mut studies,
                &mut left_out,
                &mut notes,
            )?
        } else {
            gathered.read_table(path, kind)?
        });
        gathered.refuse_mixture(path)?;
    }
    notes.extend(left_out.notes());
    if gathered.kinds().next().is_none() {
        return Err(nothing_left(&files, &notes));
    }
    if !gathered.counts.is_empty() && options.limits_times() {
        notes.push(
            "counts have no response times: no limit of the response time was applied.".to_owned(),
        );
    }
    let mut data = gathered.finish(&studies.rules(options))?;
    let (study, declared) = studies.facts(&data.participants, &mut notes);
    (data.study, data.declared) = (study, declared);
    data.sources = sources;
    notes.append(&mut data.notes);
    data.notes = notes;
    if data.is_empty() {
        let rules = data.exclusions.iter().filter(|rule| rule.trials > 0);
        data.notes
            .extend(rules.map(|rule| format!("{} trials left out: {}", rule.trials, rule.rule)));
        return Err(nothing_left(&files, &data.notes));
    }
    Ok(data)
}

impl Options {
    fn limits_times(self) -> bool {
        self.minimum_response_ms.is_some() || self.maximum_response_ms.is_some()
    }
}

impl Gathered {
    fn read_table(&mut self, path: &Path, kind: &str) -> Result<Source, InputError> {
        let file = CsvFile::open(path)?;
        match kind {
            count_table::KIND => self.counts.read(file),
            judgement_tables::RANKS => judgement_tables::read_ranks(file, &mut self.rankings),
            judgement_tables::RATINGS => judgement_tables::read_ratings(file, &mut self.ratings),
            _ => trial_table::read(file, &mut self.trials),
        }
    }

    /// The kinds of which something was read.
    fn kinds(&self) -> impl Iterator<Item = &'static str> + use<> {
        [
            ("counts", self.counts.is_empty()),
            ("single choices", self.trials.is_empty()),
            ("ratings", self.ratings.is_empty()),
            ("rankings", self.rankings.is_empty()),
        ]
        .into_iter()
        .filter_map(|(kind, is_empty)| (!is_empty).then_some(kind))
    }

    fn refuse_mixture(&self, path: &Path) -> Result<(), InputError> {
        let mut kinds = self.kinds();
        match (kinds.next(), kinds.next()) {
            (Some(one), Some(other)) => Err(InputError::whole(
                path,
                format!("{one} and {other} cannot be analysed together; give one kind"),
            )),
            _ => Ok(()),
        }
    }

    fn finish(self, rules: &[Rules]) -> Result<Dataset, InputError> {
        if !self.counts.is_empty() {
            return Ok(self.counts.finish());
        }
        if !self.ratings.is_empty() {
            return self.ratings.into_ratings(rules);
        }
        if !self.rankings.is_empty() {
            return self.rankings.into_rankings(rules);
        }
        self.trials.finish(rules)
    }
}

/// A file, and what it is where the folder says so.
type Found = (PathBuf, Option<&'static str>);

/// The files of all inputs, folders opened, in the order given.
fn files_of(inputs: &[PathBuf]) -> Result<Vec<Found>, InputError> {
    let mut all = Vec::new();
    for input in inputs {
        if !input.is_dir() {
            all.push((input.clone(), None));
        } else if results::is_results_folder(input) {
            let files = results::data_files(input)?;
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
