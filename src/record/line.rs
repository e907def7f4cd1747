//! A row as one line of CSV with a checksum at its end.
//!
//! The last column, `row_crc32`, is `x` and the CRC-32 (IEEE 802.3) of everything
//! before its comma, eight hex digits. A line that a crash has cut off anywhere is
//! recognised by it, and so is one that was edited.

use super::TrialRow;
use super::columns;

/// Name of the checksum's column.
pub const CHECKSUM_COLUMN: &str = "row_crc32";

/// `,x` and eight hex digits.
const CHECKSUM_LENGTH: usize = 10;

/// The first line of a data file, with its line break.
#[must_use]
pub fn header() -> String {
    let names: Vec<&str> = columns::COLUMNS.iter().map(|column| column.name).collect();
    format!("{}\n", names.join(","))
}

/// A row as one line, with its line break.
///
/// # Errors
/// What is wrong with the row: a line break in one of its texts.
pub fn encode(row: &TrialRow) -> Result<Vec<u8>, String> {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    writer.serialize(row).map_err(|error| error.to_string())?;
    let mut line = writer
        .into_inner()
        .map_err(|error| error.error().to_string())?;
    line.pop();
    if line.iter().any(|byte| matches!(byte, b'\n' | b'\r')) {
        return Err("a text with a line break in it cannot stand in a row".to_owned());
    }
    let checksum = format!(",x{:08x}\n", crc32fast::hash(&line));
    line.extend_from_slice(checksum.as_bytes());
    Ok(line)
}

/// The cells of a row as they stand in a line, without the checksum's.
///
/// # Errors
/// As [`encode`].
pub fn cells(row: &TrialRow) -> Result<Vec<String>, String> {
    let line = encode(row)?;
    let fields = &line[..line.len() - CHECKSUM_LENGTH - 1];
    let mut record = csv::StringRecord::new();
    csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(fields)
        .read_record(&mut record)
        .map_err(|error| error.to_string())?;
    Ok(record.iter().map(str::to_owned).collect())
}

/// The fields of a line without its line break, its checksum tested; `None` if
/// the line is not whole.
#[must_use]
pub fn checked(line: &[u8]) -> Option<&[u8]> {
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let fields = line.len().checked_sub(CHECKSUM_LENGTH)?;
    let (fields, checksum) = line.split_at(fields);
    let expected = format!(",x{:08x}", crc32fast::hash(fields));
    (checksum == expected.as_bytes()).then_some(fields)
}
