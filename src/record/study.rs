//! A results folder: one study, its participants and their slots.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use time::OffsetDateTime;

use super::{ParticipantId, RecordError, RowLog, TrialRow};
use crate::protocol::{Condition, Protocol};

/// What a results folder belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StudyIdentity {
    /// Study id.
    pub study_id: String,
    /// SHA-256 of the protocol's file.
    pub protocol_hash: String,
    /// The study's conditions, in the stimulus set's order.
    pub conditions: Vec<Condition>,
}

/// An open results folder.
#[derive(Debug)]
pub struct Study {
    folder: PathBuf,
    identity: StudyIdentity,
}

/// A participant's place in the study and the open file of the session.
#[derive(Debug)]
pub struct Enrolment {
    /// Who.
    pub participant: ParticipantId,
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// Session of this participant, from 1.
    pub session: u32,
    /// Which uninterrupted run of the session, from 1.
    pub segment: u32,
    /// Trials already on record, in order.
    pub rows: Vec<TrialRow>,
    /// When resumed: wall-clock time of what came last on record.
    pub interrupted_utc: Option<OffsetDateTime>,
    /// What was found damaged and passed over, in words, with file and line.
    pub warnings: Vec<String>,
    /// Where the rows go.
    pub log: RowLog,
}

impl StudyIdentity {
    /// The identity of a protocol over the conditions of its stimulus set.
    #[must_use]
    pub fn new(protocol: &Protocol, conditions: &[Condition]) -> Self {
        Self {
            study_id: protocol.study_id.to_string(),
            protocol_hash: protocol.hash.clone(),
            conditions: conditions.to_vec(),
        }
    }
}

impl Study {
    /// Opens a results folder, making it if it is not there. `protocol_text` is
    /// kept beside the data as the protocol's file is now.
    ///
    /// # Errors
    /// [`RecordError`], also if the folder belongs to another protocol.
    pub fn open(
        folder: &Path,
        identity: StudyIdentity,
        _protocol_text: &str,
    ) -> Result<Self, RecordError> {
        Ok(Self {
            folder: folder.to_owned(),
            identity,
        })
    }

    /// Takes the lowest open slot for a new participant and makes the data file.
    /// `now` is the wall-clock time.
    ///
    /// # Errors
    /// [`RecordError`], also if the id is taken.
    pub fn enrol(
        &self,
        participant: &ParticipantId,
        _station: &str,
        _now: OffsetDateTime,
    ) -> Result<Enrolment, RecordError> {
        Err(RecordError::UnknownParticipant {
            participant: participant.to_string(),
        })
    }

    /// Goes on with an unfinished session of the same participant.
    ///
    /// # Errors
    /// [`RecordError`], also if there is none, or if it is open elsewhere.
    pub fn resume(
        &self,
        participant: &ParticipantId,
        _station: &str,
        _now: OffsetDateTime,
    ) -> Result<Enrolment, RecordError> {
        Err(RecordError::UnknownParticipant {
            participant: participant.to_string(),
        })
    }

    /// Gives a drop-out's slot to the next participant; both stay on record.
    ///
    /// # Errors
    /// [`RecordError`], also if the participant holds no slot.
    pub fn release(
        &self,
        participant: &ParticipantId,
        _reason: &str,
        _now: OffsetDateTime,
    ) -> Result<u32, RecordError> {
        Err(RecordError::UnknownParticipant {
            participant: participant.to_string(),
        })
    }

    /// The slot the next new participant would take.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn next_slot(&self) -> Result<u32, RecordError> {
        Ok(0)
    }

    /// Rows on record of a participant, `None` if the id is new.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn answered(&self, _participant: &ParticipantId) -> Result<Option<usize>, RecordError> {
        Ok(None)
    }

    /// The results folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// What the folder belongs to.
    #[must_use]
    pub fn identity(&self) -> &StudyIdentity {
        &self.identity
    }
}
