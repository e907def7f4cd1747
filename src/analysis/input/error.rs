//! Data that cannot be analysed, where it is and how to mend it.

use std::io;
use std::path::{Path, PathBuf};

use crate::record::RecordError;

/// An input that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// The disk said no.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// A file or folder as a whole.
    #[error("{}: {message}", path.display())]
    Whole {
        /// The file or folder.
        path: PathBuf,
        /// What was found, what is expected, how to mend it.
        message: String,
    },
    /// One line of a file.
    #[error("{}:{line}: {message}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Line, from 1; the first of a row that spans several.
        line: u64,
        /// What was found, what is expected, how to mend it.
        message: String,
    },
    /// Greyfield's own results.
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl InputError {
    pub(super) fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable {
            path: path.to_owned(),
            source,
        }
    }

    pub(super) fn whole(path: &Path, message: impl Into<String>) -> Self {
        Self::Whole {
            path: path.to_owned(),
            message: message.into(),
        }
    }

    pub(super) fn line(path: &Path, line: u64, message: impl Into<String>) -> Self {
        Self::Line {
            path: path.to_owned(),
            line,
            message: message.into(),
        }
    }
}
