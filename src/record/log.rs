//! The append-only file of one participant's session.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::read::{self, Rows};
use super::{RecordError, TrialRow, files, line};

/// The open data file of one session; no other process can open it meanwhile.
#[derive(Debug)]
pub struct RowLog {
    path: PathBuf,
    file: File,
    /// A write has failed: the file may end in a part of a line.
    suspect: bool,
}

impl RowLog {
    /// Makes the file of a new session, or gives `None` if there is one already. It is
    /// locked before it has its name: nobody resumes a session that is just being
    /// enrolled, which would give it a slot of its own.
    pub(super) fn create(path: &Path) -> Result<Option<Self>, RecordError> {
        // A folder whose file system knows no locks is still usable by one computer.
        let lock = |file: &File| {
            let _ = file.try_lock();
        };
        let file = files::create_whole_open(path, line::header().as_bytes(), lock)?;
        Ok(file.map(|file| Self {
            path: path.to_owned(),
            file,
            suspect: false,
        }))
    }

    /// Opens the file of an interrupted session, ends a line that a crash has cut
    /// off, and gives what is on record.
    pub(super) fn reopen(path: &Path, participant: &str) -> Result<(Self, Rows), RecordError> {
        let mut log = Self::open(path, participant)?;
        let bytes = files::read(path)?;
        let header = line::header();
        if bytes.len() < header.len() && header.as_bytes().starts_with(&bytes) {
            log.write_once(&header.as_bytes()[bytes.len()..])?;
        } else if !bytes.starts_with(header.as_bytes()) {
            return Err(RecordError::Malformed {
                path: path.to_owned(),
                line: 1,
                message: format!(
                    "the columns are not those of this version ({}); finish the session with the version that began it",
                    env!("CARGO_PKG_VERSION")
                ),
            });
        }
        log.end_torn_line()?;
        log.sync()?;
        let rows = read::parse(path, &bytes)?;
        Ok((log, rows))
    }

    /// Opens the file for this process alone, and changes nothing.
    pub(super) fn open(path: &Path, participant: &str) -> Result<Self, RecordError> {
        let file = OpenOptions::new()
            .read(true)
            .append(true)
            .open(path)
            .map_err(RecordError::io(path, "open"))?;
        match file.try_lock() {
            // A folder whose file system knows no locks is still usable by one computer.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self {
                path: path.to_owned(),
                file,
                suspect: false,
            }),
            Err(TryLockError::WouldBlock) => Err(RecordError::InUse {
                path: path.to_owned(),
                participant: participant.to_owned(),
            }),
        }
    }

    /// Appends one row and syncs it: when this returns `Ok`, the row outlives a
    /// crash of the machine. After an error the same row can be given again; should
    /// it then stand twice, the reader takes the first.
    ///
    /// # Errors
    /// [`RecordError`] saying what the disk said; the row does not count then.
    pub fn append_row(&mut self, row: &TrialRow) -> Result<(), RecordError> {
        let line = line::encode(row).map_err(|message| RecordError::Row {
            row_id: row.row_id.clone(),
            message,
        })?;
        if self.suspect {
            self.end_torn_line()?;
        }
        self.suspect = true;
        self.write_once(&line)?;
        self.sync()?;
        self.still_there()?;
        self.suspect = false;
        Ok(())
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// One write for the whole of `bytes`: in append mode no other write comes
    /// between, and a crash leaves either all or a recognisable part.
    fn write_once(&mut self, bytes: &[u8]) -> Result<(), RecordError> {
        let written = loop {
            match self.file.write(bytes) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                other => break other,
            }
        };
        let short = |written: usize| {
            io::Error::new(
                io::ErrorKind::StorageFull,
                format!("only {written} of {} bytes were taken", bytes.len()),
            )
        };
        match written {
            Ok(count) if count == bytes.len() => Ok(()),
            Ok(count) => Err(RecordError::io(&self.path, "write the row")(short(count))),
            Err(error) => Err(RecordError::io(&self.path, "write the row")(error)),
        }
    }

    /// The contents and the size; the name was synced when the file was made.
    fn sync(&self) -> Result<(), RecordError> {
        self.file
            .sync_data()
            .map_err(RecordError::io(&self.path, "sync"))
    }

    /// A file that was removed or replaced still takes rows, but nobody will find them.
    fn still_there(&self) -> Result<(), RecordError> {
        let gone = || {
            let message = "the data file was removed or replaced while the session was running";
            io::Error::new(io::ErrorKind::NotFound, message)
        };
        let named = fs::metadata(&self.path).map_err(|_| gone());
        let open = self.file.metadata();
        named
            .and_then(|named| Ok(named.len() == open?.len()))
            .and_then(|same| if same { Ok(()) } else { Err(gone()) })
            .map_err(RecordError::io(&self.path, "keep the row"))
    }

    /// Ends a line that was cut off. What there is of it stays.
    fn end_torn_line(&mut self) -> Result<(), RecordError> {
        let failed = |path: &Path| RecordError::io(path, "read back");
        let length = self
            .file
            .seek(SeekFrom::End(0))
            .map_err(failed(&self.path))?;
        if length == 0 {
            return Ok(());
        }
        let mut last = [0];
        self.file
            .seek(SeekFrom::End(-1))
            .and_then(|_| self.file.read_exact(&mut last))
            .map_err(failed(&self.path))?;
        if last == *b"\n" {
            return Ok(());
        }
        self.write_once(b"\n")
    }
}
