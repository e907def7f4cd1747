//! One error for every way a config file can be wrong.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A config file that cannot be used, and where and why.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct ConfigError {
    /// The file, as it was named.
    pub path: PathBuf,
    /// Line and column, both counted from 1, where the file could be read at all.
    pub position: Option<(usize, usize)>,
    /// Dotted path of the field, such as `camera.near_m`; empty where none applies.
    pub field: String,
    /// What was found and what is allowed.
    pub message: String,
}

impl ConfigError {
    /// An error at a byte range of `text`.
    #[must_use]
    pub fn at(
        path: &Path,
        text: &str,
        span: Option<Range<usize>>,
        field: &str,
        message: &str,
    ) -> Self {
        Self {
            path: path.to_owned(),
            position: span.map(|span| line_and_column(text, span.start)),
            field: if field == "." { "" } else { field }.to_owned(),
            message: message.trim().to_owned(),
        }
    }

    /// An error about the file as a whole.
    #[must_use]
    pub fn whole_file(path: &Path, message: &str) -> Self {
        Self::at(path, "", None, "", message)
    }

    /// The file could not be read.
    #[must_use]
    pub fn unreadable(path: &Path, error: &std::io::Error) -> Self {
        Self::whole_file(path, &format!("cannot be read: {error}"))
    }
}

impl fmt::Display for ConfigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some((line, column)) = self.position {
            write!(f, ":{line}:{column}")?;
        }
        if !self.field.is_empty() {
            write!(f, ": field `{}`", self.field)?;
        }
        write!(f, ": {}", self.message)
    }
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let offset = (0..=offset.min(text.len()))
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0);
    let before = &text[..offset];
    let line = before.matches('\n').count() + 1;
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (line, before[line_start..].chars().count() + 1)
}
