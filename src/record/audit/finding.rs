//! What an audit has to say.

use std::path::PathBuf;

use serde::Serialize;

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Data or record contradict each other: not to be analysed before it is understood.
    Error,
    /// Somebody should look at it.
    Warning,
    /// Good to know.
    Note,
}

/// One thing that an audit found.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// The file or folder, relative to the results folder.
    pub path: PathBuf,
    /// The line, from 1, where there is one.
    pub line: Option<u64>,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub mend: String,
}

/// Findings while they are gathered.
#[derive(Debug, Default)]
pub(super) struct Findings(pub Vec<Finding>);

impl Findings {
    /// Adds one on a file as a whole.
    pub fn file(
        &mut self,
        severity: Severity,
        path: impl Into<PathBuf>,
        message: impl Into<String>,
        mend: impl Into<String>,
    ) {
        self.add(severity, path.into(), None, message.into(), mend.into());
    }

    /// Adds one on a line of a file.
    pub fn line(
        &mut self,
        severity: Severity,
        (path, line): (impl Into<PathBuf>, u64),
        message: impl Into<String>,
        mend: impl Into<String>,
    ) {
        self.add(
            severity,
            path.into(),
            Some(line),
            message.into(),
            mend.into(),
        );
    }

    fn add(
        &mut self,
        severity: Severity,
        path: PathBuf,
        line: Option<u64>,
        message: String,
        mend: String,
    ) {
        self.0.push(Finding {
            severity,
            path,
            line,
            message,
            mend,
        });
    }
}
