//! One error for every way a model file can be wrong.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A model that cannot be used, and where and why.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct ModelError {
    /// The file, as it was named.
    pub path: PathBuf,
    /// Where in the file: a JSON path (`meshes[3].primitives[0]`), a line, or empty
    /// for the file as a whole.
    pub place: String,
    /// What was found, what is allowed and how to mend it.
    pub message: String,
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: ", self.path.display())?;
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        f.write_str(&self.message)
    }
}

/// A [`ModelError`] before it knows its file: the readers of single parts need not
/// carry the path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    pub place: String,
    pub message: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            place: place.into(),
            message: message.into(),
        }
    }

    /// About the file as a whole.
    pub fn whole(message: impl Into<String>) -> Self {
        Self::new("", message)
    }

    pub fn unreadable(place: impl Into<String>, error: &io::Error) -> Self {
        let hint = match error.kind() {
            io::ErrorKind::UnexpectedEof => "the file ends too early; copy or export it again",
            io::ErrorKind::NotFound => "there is no such file",
            _ => return Self::new(place, format!("cannot be read: {error}")),
        };
        Self::new(place, hint)
    }

    pub fn of(self, path: &Path) -> ModelError {
        ModelError {
            path: path.to_owned(),
            place: self.place,
            message: self.message,
        }
    }
}
