//! The logical lines of a text file: without comments, joined at backslashes.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::super::error::Fault;

/// Longest line, joined ones together.
const LONGEST_LINE: u64 = 1 << 24;

/// A line as errors name it.
pub(super) fn at_line(number: usize) -> String {
    format!("line {number}")
}

/// Reads one logical line after another.
pub(super) struct Lines {
    reader: BufReader<File>,
    number: usize,
    text: String,
}

impl Lines {
    pub fn open(path: &Path) -> Result<Self, Fault> {
        let file = File::open(path).map_err(|error| Fault::unreadable("", &error))?;
        Ok(Self {
            reader: BufReader::new(file),
            number: 0,
            text: String::new(),
        })
    }

    /// The next line that is not empty, trimmed, and its number (where it ends).
    pub fn next_line(&mut self) -> Result<Option<(usize, &str)>, Fault> {
        loop {
            if !self.read_joined()? {
                return Ok(None);
            }
            let end = self.text.find('#').unwrap_or(self.text.len());
            self.text.truncate(end);
            if !self.text.trim().is_empty() {
                return Ok(Some((self.number, self.text.trim())));
            }
        }
    }

    fn read_joined(&mut self) -> Result<bool, Fault> {
        self.text.clear();
        let mut bytes = Vec::new();
        loop {
            let left = LONGEST_LINE.saturating_sub(bytes.len() as u64);
            let read = self
                .reader
                .by_ref()
                .take(left)
                .read_until(b'\n', &mut bytes)
                .map_err(|error| Fault::unreadable(at_line(self.number), &error))?;
            self.number += 1;
            if bytes.len() as u64 >= LONGEST_LINE {
                let message = format!("is longer than {LONGEST_LINE} bytes; this is no OBJ file");
                return Err(Fault::new(at_line(self.number), message));
            }
            while matches!(bytes.last(), Some(b'\n' | b'\r')) {
                bytes.pop();
            }
            if read == 0 || bytes.last() != Some(&b'\\') {
                self.text.push_str(&String::from_utf8_lossy(&bytes));
                return Ok(read > 0 || !bytes.is_empty());
            }
            bytes.pop();
            bytes.push(b' ');
        }
    }
}
