//! What can go wrong with a results folder.

use std::io;
use std::path::{Path, PathBuf};

/// A results folder that cannot be used, or a row that is not on disk.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The disk said no.
    #[error("{}: cannot {action}: {source}{}", path.display(), hint(source))]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What was tried, as in "cannot …".
        action: &'static str,
        /// Why not.
        source: io::Error,
    },
    /// A participant's id that cannot be a file name everywhere.
    #[error(
        "participant id {found:?}: allowed is a letter or digit, then letters, digits, - and _, 64 at most"
    )]
    ParticipantId {
        /// What was given.
        found: String,
    },
    /// A station's name that cannot stand in a row.
    #[error("station name {found:?}: allowed is 1 to 64 characters without line breaks")]
    Station {
        /// What was given.
        found: String,
    },
    /// The folder belongs to another protocol.
    #[error(
        "{}: this folder belongs to study {found_study:?} with protocol {found_hash}; {expected_study:?} with protocol {expected_hash} needs a folder of its own. The protocol as it was stands in {}",
        path.display(), path.join("materials/protocol.toml").display()
    )]
    OtherProtocol {
        /// The results folder.
        path: PathBuf,
        /// Study id on record.
        found_study: String,
        /// SHA-256 on record.
        found_hash: String,
        /// Study id of the protocol in use.
        expected_study: String,
        /// SHA-256 of the protocol in use.
        expected_hash: String,
    },
    /// The protocol is the same but its stimulus set has other conditions now.
    #[error(
        "{}: the stimulus set has other conditions than when this folder was begun ({found}, now {expected}); restore the set or begin a new folder",
        path.display()
    )]
    OtherConditions {
        /// The results folder.
        path: PathBuf,
        /// Conditions on record.
        found: String,
        /// Conditions of the set in use.
        expected: String,
    },
    /// The images are not those the folder was begun with.
    #[error(
        "{}: the images have changed since this folder was begun; use the rendered set it was begun with (its manifest is materials/manifest.json), or begin a new folder",
        path.display()
    )]
    OtherImages {
        /// The results folder.
        path: PathBuf,
    },
    /// All trials are answered.
    #[error("participant {participant:?} has finished: all {answered} trials are on record")]
    Finished {
        /// The id.
        participant: String,
        /// Rows on record.
        answered: usize,
    },
    /// The id is taken.
    #[error(
        "participant {participant:?} is already in this study ({answered} trials on record); resume that session or give another id"
    )]
    ParticipantExists {
        /// The id.
        participant: String,
        /// Rows on record.
        answered: usize,
    },
    /// Nothing to resume.
    #[error(
        "participant {participant:?} is not in this study; check the id, or start a new session"
    )]
    UnknownParticipant {
        /// The id.
        participant: String,
    },
    /// The slot was given up.
    #[error(
        "participant {participant:?} was released from slot {slot}, which may have been taken since; the session cannot go on"
    )]
    Released {
        /// The id.
        participant: String,
        /// The slot.
        slot: u32,
    },
    /// There is nothing to give up.
    #[error(
        "participant {participant:?} was released from slot {slot} on {released_utc} already ({reason})"
    )]
    AlreadyReleased {
        /// The id.
        participant: String,
        /// The slot.
        slot: u32,
        /// The reason on record.
        reason: String,
        /// Since when.
        released_utc: String,
    },
    /// The data is marked already.
    #[error("participant {participant:?} was rejected on {rejected_utc} already ({reason})")]
    AlreadyRejected {
        /// The id.
        participant: String,
        /// The reason on record.
        reason: String,
        /// Since when.
        rejected_utc: String,
    },
    /// There is nothing to take back.
    #[error(
        "participant {participant:?} is neither rejected nor released (slot {slot}); there is nothing to take back"
    )]
    NothingToReinstate {
        /// The id.
        participant: String,
        /// The slot.
        slot: u32,
    },
    /// Somebody else sits there now.
    #[error(
        "participant {participant:?} cannot be reinstated: slot {slot} is held by participant {holder:?} since {since_utc}; release {holder:?} first if {participant:?} is to have it back"
    )]
    SlotTaken {
        /// The id.
        participant: String,
        /// The slot.
        slot: u32,
        /// Who has it.
        holder: String,
        /// Since when.
        since_utc: String,
    },
    /// A data file without a slot.
    #[error(
        "participant {participant:?} has a data file but no slot: the program was stopped while the slot was being taken; resume the session, then try again"
    )]
    NoSlot {
        /// The id.
        participant: String,
    },
    /// Not a results folder.
    #[error(
        "{}: not a results folder, it has no study.json; name the folder that `greyfield run --results` was given",
        path.display()
    )]
    NoStudy {
        /// The folder.
        path: PathBuf,
    },
    /// The place of an export is taken.
    #[error(
        "{}: the folder has something in it already; name another one, or one that is empty",
        path.display()
    )]
    ExportTaken {
        /// The folder.
        path: PathBuf,
    },
    /// The protocol beside the data cannot be read.
    #[error(transparent)]
    Protocol(#[from] crate::config::ConfigError),
    /// The session is open elsewhere.
    #[error(
        "{}: the session of participant {participant:?} is running in another window or on another computer; end it there first",
        path.display()
    )]
    InUse {
        /// The data file.
        path: PathBuf,
        /// The id.
        participant: String,
    },
    /// A file is not what Greyfield wrote.
    #[error("{}:{line}: {message}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// What was found and what is expected.
        message: String,
    },
    /// A row that would break the file.
    #[error("row {row_id}: {message}; nothing was written")]
    Row {
        /// The row.
        row_id: String,
        /// What is wrong with it.
        message: String,
    },
}

impl RecordError {
    /// For `map_err`: names the path and what was tried.
    pub(crate) fn io(path: &Path, action: &'static str) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Io {
            path,
            action,
            source,
        }
    }
}

/// How to mend what the disk said.
fn hint(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "; free some space, then try again"
        }
        io::ErrorKind::FileTooLarge => "; the file may not grow any further here (see `ulimit -f`)",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "; the results folder must be writable"
        }
        _ => "",
    }
}
