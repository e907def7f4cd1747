//! Reading data files: every whole row, and a warning for everything else.

use std::collections::HashSet;
use std::fmt;
use std::path::{Path, PathBuf};

use super::line;
use super::{RecordError, TrialRow, files};

/// The rows of one or more data files.
#[derive(Debug, Default)]
pub struct Rows {
    /// Whole rows, in the order of the files.
    pub rows: Vec<TrialRow>,
    /// The line each of them stands on in its file, from 1.
    pub lines: Vec<u64>,
    /// What was passed over.
    pub warnings: Vec<Warning>,
}

/// A line that is not a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// The file.
    pub path: PathBuf,
    /// The line, from 1.
    pub line: u64,
    /// What is wrong with it.
    pub flaw: Flaw,
}

/// What is wrong with a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flaw {
    /// The checksum is missing or does not fit.
    Damaged,
    /// The same of a last line that has no line break: the last write was cut off.
    CutOff,
    /// The row's id stood before; the first one counts.
    Repeated,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: ", self.path.display(), self.line)?;
        f.write_str(match self.flaw {
            Flaw::Damaged => {
                "passed over: the line was cut off by a crash or changed since (its checksum does not fit)"
            }
            Flaw::CutOff => {
                "passed over: the line was cut off by a crash; what there is of it stays, and the next row goes on a line of its own"
            }
            Flaw::Repeated => "passed over: this row_id stands further up already",
        })
    }
}

/// Reads one data file.
///
/// # Errors
/// [`RecordError`] if the file cannot be read or is not a data file. Damaged lines
/// are no error but a [`Warning`].
pub fn read_rows(path: &Path) -> Result<Rows, RecordError> {
    parse(path, &files::read(path)?)
}

/// Reads every data file of a results folder, in the order of their names.
///
/// # Errors
/// As [`read_rows`].
pub fn read_folder(results: &Path) -> Result<Rows, RecordError> {
    let data = results.join(super::DATA_FOLDER);
    let mut all = Rows::default();
    for name in files::names(&data)? {
        if name.ends_with(super::DATA_SUFFIX) && !name.starts_with('.') {
            let rows = read_rows(&data.join(name))?;
            all.rows.extend(rows.rows);
            all.lines.extend(rows.lines);
            all.warnings.extend(rows.warnings);
        }
    }
    Ok(all)
}

/// The rows of a data file's bytes; `path` is only named.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Rows, RecordError> {
    let mut lines = bytes.split(|&byte| byte == b'\n').peekable();
    let first = lines.next().unwrap_or_default();
    let mut result = Rows::default();
    if first.len() == bytes.len() && line::header().as_bytes().starts_with(bytes) {
        // A crash has cut the header off: no row can be below it.
        return Ok(result);
    }
    let header = header(path, first)?;
    let mut seen = HashSet::new();
    let mut line = 1;
    while let Some(text) = lines.next() {
        line += 1;
        if text.is_empty() {
            continue;
        }
        let is_last = lines.peek().is_none();
        let mut warn = |flaw| {
            result.warnings.push(Warning {
                path: path.to_owned(),
                line,
                flaw,
            });
        };
        let Some(fields) = line::checked(text) else {
            warn(if is_last { Flaw::CutOff } else { Flaw::Damaged });
            continue;
        };
        let row = decode(path, line, &header, fields)?;
        if seen.insert(row.row_id.clone()) {
            result.rows.push(row);
            result.lines.push(line);
        } else {
            warn(Flaw::Repeated);
        }
    }
    Ok(result)
}

/// The columns of a data file, without the checksum's.
fn header(path: &Path, line: &[u8]) -> Result<csv::StringRecord, RecordError> {
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let columns = std::str::from_utf8(line).unwrap_or_default();
    let named = columns.strip_suffix(&format!(",{}", line::CHECKSUM_COLUMN));
    let Some(named) = named.filter(|named| named.starts_with("row_id,")) else {
        return Err(RecordError::Malformed {
            path: path.to_owned(),
            line: 1,
            message: format!(
                "not a data file of Greyfield: the first line must name the columns from row_id to {}",
                line::CHECKSUM_COLUMN
            ),
        });
    };
    Ok(named.split(',').collect::<Vec<_>>().into())
}

/// A row whose checksum fits; if it cannot be read now, another version wrote it.
fn decode(
    path: &Path,
    line: u64,
    header: &csv::StringRecord,
    fields: &[u8],
) -> Result<TrialRow, RecordError> {
    let malformed = |message: String| RecordError::Malformed {
        path: path.to_owned(),
        line,
        message: format!(
            "the row is whole but this version cannot read it: {message}; use the version that wrote it"
        ),
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(fields);
    let mut record = csv::StringRecord::new();
    reader
        .read_record(&mut record)
        .map_err(|error| malformed(error.to_string()))?;
    record
        .deserialize(Some(header))
        .map_err(|error| malformed(error.to_string()))
}
