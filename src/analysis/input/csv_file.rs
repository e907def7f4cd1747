//! A CSV file read row by row: byte-order mark, line endings and quotes are dealt with, every error
//! has its line, and the bytes are hashed on the way.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use csv::{ByteRecord, ErrorKind, Position, ReaderBuilder, Terminator};
use sha2::{Digest, Sha256};

use super::error::InputError;

const BUFFER_BYTES: usize = 1 << 18;

/// An open file and its header.
pub struct CsvFile {
    path: PathBuf,
    reader: csv::Reader<BufReader<Hashing<File>>>,
    header: Vec<String>,
    record: ByteRecord,
}

/// One data row.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    path: &'a Path,
    header: &'a [String],
    record: &'a ByteRecord,
    /// Line of its start, from 1.
    pub line: u64,
}

/// Hashes what passes through.
struct Hashing<R> {
    inner: R,
    hasher: Sha256,
}

impl<R: Read> Read for Hashing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(buffer)?;
        self.hasher.update(&buffer[..read]);
        Ok(read)
    }
}

impl CsvFile {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// [`InputError`] for a file that cannot be read, is empty, is not UTF-8 or separates its
    /// columns by something else than commas.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let file = File::open(path).map_err(|error| InputError::unreadable(path, error))?;
        let hashing = Hashing {
            inner: file,
            hasher: Sha256::new(),
        };
        let mut buffered = BufReader::with_capacity(BUFFER_BYTES, hashing);
        skip_byte_order_mark(path, &mut buffered)?;
        // The line of a row is exact only if a line ends at its line feed: with CRLF as the
        // terminator the csv crate counts the line feed to the next row. The carriage return left at
        // the end of the last field is trimmed like a space.
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .terminator(Terminator::Any(b'\n'))
            .from_reader(buffered);
        let mut record = ByteRecord::new();
        let found = reader
            .read_byte_record(&mut record)
            .map_err(|error| csv_error(path, &error))?;
        if !found {
            return Err(InputError::whole(
                path,
                "the file is empty; a header line and data rows are needed",
            ));
        }
        let header = header_names(path, &record, start_line(&record, reader.position()))?;
        Ok(Self {
            path: path.to_owned(),
            reader,
            header,
            record,
        })
    }

    /// Names of the columns, trimmed.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Index of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|column| column == name)
    }

    /// The next row, `None` at the end. Blank lines are passed over.
    ///
    /// # Errors
    /// [`InputError`] with the line, also for a row with too few or too many fields.
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, InputError> {
        let line = loop {
            let found = self
                .reader
                .read_byte_record(&mut self.record)
                .map_err(|error| csv_error(&self.path, &error))?;
            if !found {
                return Ok(None);
            }
            let first = self.record.get(0).unwrap_or_default();
            if self.record.len() > 1 || !first.trim_ascii().is_empty() {
                break start_line(&self.record, self.reader.position());
            }
        };
        let (found, named) = (self.record.len(), self.header.len());
        if found != named {
            return Err(InputError::line(
                &self.path,
                line,
                format!(
                    "found {found} fields, the header names {named} columns; an unquoted comma or a quote that is not closed does this"
                ),
            ));
        }
        Ok(Some(Row {
            path: &self.path,
            header: &self.header,
            line,
            record: &self.record,
        }))
    }

    /// SHA-256 of the file, lower-case hex. Call at the end: it hashes what was read.
    pub fn sha256(self) -> String {
        let digest = self.reader.into_inner().into_inner().hasher.finalize();
        digest.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl<'a> Row<'a> {
    /// Bytes of a field, without the spaces around it.
    pub fn bytes(&self, column: usize) -> &'a [u8] {
        self.record.get(column).unwrap_or_default().trim_ascii()
    }

    /// Text of a field.
    ///
    /// # Errors
    /// [`InputError`] if it is not UTF-8.
    pub fn text(&self, column: usize) -> Result<&'a str, InputError> {
        std::str::from_utf8(self.bytes(column)).map_err(|_| {
            self.error(
                column,
                "not UTF-8 text; save the file as UTF-8 and try again",
            )
        })
    }

    /// A number.
    ///
    /// # Errors
    /// [`InputError`] saying what is `allowed`.
    pub fn number<T: std::str::FromStr>(
        &self,
        column: usize,
        allowed: &str,
    ) -> Result<T, InputError> {
        let text = self.text(column)?;
        text.parse()
            .map_err(|_| self.error(column, &format!("found `{}`, {allowed}", shown(text))))
    }

    /// An error in one field.
    pub fn error(&self, column: usize, message: &str) -> InputError {
        let name = self.header.get(column).map_or("?", String::as_str);
        InputError::line(self.path, self.line, format!("column `{name}`: {message}"))
    }

    /// An error of the row as a whole.
    pub fn row_error(&self, message: impl Into<String>) -> InputError {
        InputError::line(self.path, self.line, message)
    }
}

/// A field as it stands in a message: short, on one line.
pub fn shown(text: &str) -> String {
    const MOST: usize = 60;
    let mut short: String = text.chars().take(MOST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short.escape_debug().to_string()
}

fn skip_byte_order_mark(path: &Path, reader: &mut impl BufRead) -> Result<(), InputError> {
    let start = reader
        .fill_buf()
        .map_err(|error| InputError::unreadable(path, error))?;
    if start.starts_with(&[0xff, 0xfe]) || start.starts_with(&[0xfe, 0xff]) {
        return Err(InputError::whole(
            path,
            "the file is UTF-16 text; save it as CSV in UTF-8 and try again",
        ));
    }
    if start.starts_with(&[0xef, 0xbb, 0xbf]) {
        reader.consume(3);
    }
    Ok(())
}

fn header_names(path: &Path, record: &ByteRecord, line: u64) -> Result<Vec<String>, InputError> {
    let names = record
        .iter()
        .map(|field| {
            std::str::from_utf8(field)
                .map(|name| name.trim().to_owned())
                .map_err(|_| {
                    InputError::line(
                        path,
                        line,
                        "the header is not UTF-8 text; save the file as CSV in UTF-8 and try again",
                    )
                })
        })
        .collect::<Result<Vec<String>, _>>()?;
    if names.iter().any(|name| name.contains('\0')) {
        return Err(InputError::whole(
            path,
            "the file is no plain text (or UTF-16); save it as CSV in UTF-8 and try again",
        ));
    }
    if names.iter().any(|name| name.contains('\r')) {
        return Err(InputError::line(
            path,
            line,
            "its lines end in a carriage return alone; save the file with line feeds and try again",
        ));
    }
    if let [only] = names.as_slice()
        && let Some(separator) = [';', '\t', '|'].into_iter().find(|&c| only.contains(c))
    {
        return Err(InputError::line(
            path,
            line,
            format!("the columns are separated by {separator:?}, commas are needed"),
        ));
    }
    if let Some(twice) = names
        .iter()
        .enumerate()
        .find_map(|(i, name)| names[..i].contains(name).then_some(name))
    {
        return Err(InputError::line(
            path,
            line,
            format!("the header names the column `{}` twice", shown(twice)),
        ));
    }
    Ok(names)
}

/// The line a record starts on, given the reader's position after it. The record's own position is
/// before the blank lines passed over.
fn start_line(record: &ByteRecord, after: &Position) -> u64 {
    let before = record.position().map_or(0, Position::line);
    let inside = record
        .as_slice()
        .iter()
        .filter(|&&byte| byte == b'\n')
        .count() as u64;
    before + (after.line() - before).saturating_sub(1 + inside)
}

fn csv_error(path: &Path, error: &csv::Error) -> InputError {
    match error.kind() {
        ErrorKind::Io(source) => {
            InputError::unreadable(path, io::Error::new(source.kind(), source.to_string()))
        }
        _ => InputError::whole(path, error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("x.csv");
        std::fs::write(&path, bytes).unwrap();
        (dir, path)
    }

    fn error_of(bytes: &[u8]) -> String {
        let (_dir, path) = written(bytes);
        let mut file = match CsvFile::open(&path) {
            Ok(file) => file,
            Err(error) => return error.to_string(),
        };
        loop {
            match file.next_row() {
                Ok(Some(_)) => {}
                Ok(None) => panic!("no error"),
                Err(error) => return error.to_string(),
            }
        }
    }

    #[test]
    fn marks_line_endings_and_quotes_are_read_through() {
        let bytes = "\u{feff}a , b\r\n\"x\r\ny\",\" 1 \"\r\n\r\n2,\"he said \"\"no\"\"\"\r\n";
        let (_dir, path) = written(bytes.as_bytes());
        let mut file = CsvFile::open(&path).unwrap();
        assert_eq!(file.header(), ["a", "b"]);
        let row = file.next_row().unwrap().unwrap();
        assert_eq!((row.line, row.text(0).unwrap()), (2, "x\r\ny"));
        assert_eq!(row.number::<u32>(1, "").unwrap(), 1);
        let row = file.next_row().unwrap().unwrap();
        assert_eq!((row.line, row.text(1).unwrap()), (5, "he said \"no\""));
        assert!(file.next_row().unwrap().is_none());
        assert_eq!(file.sha256(), crate::digest::sha256_hex(bytes.as_bytes()));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (bytes, parts) in [
            (&b""[..], &["empty"][..]),
            (b"a,b\n1,2\n1\n", &[":3:", "1 fields", "2 columns"]),
            (b"a,b\n1,2,3\n", &[":2:", "3 fields"]),
            (b"a,b\n\"1,2\n3,4\n", &[":2:", "quote"]),
            (b"a;b\n", &[":1:", "';'", "commas"]),
            (b"a,b,a\n", &[":1:", "`a` twice"]),
            (b"\xff\xfea\x00", &["UTF-16"]),
            (b"a\x00,\x00b\x00\n\x00", &["UTF-16", "UTF-8"]),
            (b"a,b\r1,2\r", &[":1:", "carriage return", "line feeds"]),
            (b"\xe9,b\n", &[":1:", "UTF-8"]),
        ] {
            let message = error_of(bytes);
            for part in parts {
                assert!(message.contains(part), "{part:?} not in {message:?}");
            }
        }
    }

    #[test]
    fn a_field_that_is_not_text_or_no_number_is_named() {
        let (_dir, path) = written(b"a,b\n1,\xff\n");
        let mut file = CsvFile::open(&path).unwrap();
        let row = file.next_row().unwrap().unwrap();
        let message = row.text(1).unwrap_err().to_string();
        assert!(
            message.contains(":2: column `b`") && message.contains("UTF-8"),
            "{message}"
        );
        let (_dir, path) = written(b"a\nx\n");
        let mut file = CsvFile::open(&path).unwrap();
        let row = file.next_row().unwrap().unwrap();
        let message = row
            .number::<u32>(0, "a whole number is needed")
            .unwrap_err();
        assert!(message.to_string().contains("found `x`"), "{message}");
    }
}
