//! A results folder: one study, its participants and their slots.

use std::path::{Path, PathBuf};

use time::OffsetDateTime;
use time::format_description::well_known::Rfc3339;

use super::read::{Flaw, Rows};
use super::slots::{self, Claim, ClaimRecord, KnownClaims, SegmentRecord, Slots};
use super::{
    About, ParticipantId, RecordError, RowLog, StudyIdentity, TrialRow, about, description, files,
    read,
};
use crate::config;
use crate::protocol::Protocol;

/// What a results folder belongs to.
pub const STUDY_FILE: &str = "study.json";

/// The protocol's file as it was.
pub const PROTOCOL_FILE: &str = "materials/protocol.toml";

/// An open results folder.
#[derive(Debug)]
pub struct Study {
    folder: PathBuf,
    identity: StudyIdentity,
    pilot: bool,
    known_claims: KnownClaims,
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
    /// A try-out: rows are marked as such, and the slot is one of the pilot's.
    pub pilot: bool,
    /// Which computer.
    pub station: String,
    /// Trials already on record, in order.
    pub rows: Vec<TrialRow>,
    /// When resumed: wall-clock time of what came last on record.
    pub interrupted_utc: Option<OffsetDateTime>,
    /// What was found damaged and passed over, in words, with file and line.
    pub warnings: Vec<String>,
    /// Where the rows go.
    pub log: RowLog,
    /// What the participant agreed to and told, if that was asked already.
    pub about: Option<About>,
    /// The results folder.
    pub results: PathBuf,
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
        protocol_text: &str,
    ) -> Result<Self, RecordError> {
        for part in ["", "materials", "slots", super::DATA_FOLDER] {
            files::create_folder(&folder.join(part))?;
        }
        let study = Self {
            folder: folder.to_owned(),
            identity,
            pilot: false,
            known_claims: KnownClaims::default(),
        };
        let path = folder.join(STUDY_FILE);
        if !path.exists() {
            // Whoever is first decides what the folder belongs to.
            files::create_whole(&path, &slots::json(&path, &study.identity)?)?;
        }
        study.identity.check_against(folder, &slots::load(&path)?)?;
        study.keep(PROTOCOL_FILE, protocol_text.as_bytes())?;
        let path = folder.join("dataset_description.json");
        let description = description::dataset_description(&study.identity);
        study.keep(
            "dataset_description.json",
            &slots::json(&path, &description)?,
        )?;
        study.keep(".psychdsignore", description::PSYCHDS_IGNORE.as_bytes())?;
        Ok(study)
    }

    /// Opens a results folder as it is, without its protocol's file; makes nothing.
    ///
    /// # Errors
    /// [`RecordError`], also if the folder has no `study.json`.
    pub fn open_existing(folder: &Path) -> Result<Self, RecordError> {
        let path = folder.join(STUDY_FILE);
        if !path.is_file() {
            return Err(RecordError::NoStudy {
                path: folder.to_owned(),
            });
        }
        Ok(Self {
            folder: folder.to_owned(),
            identity: slots::load(&path)?,
            pilot: false,
            known_claims: KnownClaims::default(),
        })
    }

    /// The protocol as it is kept beside the data.
    ///
    /// # Errors
    /// [`RecordError::Protocol`] if it is not there or cannot be understood.
    pub fn protocol(&self) -> Result<Protocol, RecordError> {
        let path = self.folder.join(PROTOCOL_FILE);
        let text = config::read(&path)?;
        Ok(Protocol::parse(&path, &text)?)
    }

    /// The same folder for try-outs: their rows are marked, their slots are counted apart.
    #[must_use]
    pub fn pilot(self, pilot: bool) -> Self {
        Self { pilot, ..self }
    }

    /// Keeps a file in the folder, unless one of that name is there already.
    ///
    /// # Errors
    /// [`RecordError::Io`] naming the file.
    pub fn keep(&self, name: &str, content: &[u8]) -> Result<(), RecordError> {
        let path = self.folder.join(name);
        if !path.exists() {
            files::create_whole(&path, content)?;
        }
        Ok(())
    }

    /// Takes the lowest open slot for a new participant and makes the data file.
    /// `now` is the wall-clock time.
    ///
    /// # Errors
    /// [`RecordError`], also if the id is taken.
    pub fn enrol(
        &self,
        participant: &ParticipantId,
        station: &str,
        now: OffsetDateTime,
    ) -> Result<Enrolment, RecordError> {
        check_station(station)?;
        let path = self.data_path(participant);
        // The file comes first: its name is what makes the id unique.
        let Some(log) = RowLog::create(&path)? else {
            return Err(RecordError::ParticipantExists {
                participant: participant.to_string(),
                answered: read::read_rows(&path)?.rows.len(),
            });
        };
        let claim = self.claim(participant, station, now)?;
        Ok(Enrolment {
            participant: participant.clone(),
            slot: claim.slot,
            session: 1,
            segment: 1,
            pilot: self.pilot,
            station: station.to_owned(),
            rows: Vec::new(),
            interrupted_utc: None,
            warnings: Vec::new(),
            log,
            about: None,
            results: self.folder.clone(),
        })
    }

    /// Goes on with an unfinished session of the same participant.
    ///
    /// # Errors
    /// [`RecordError`], also if there is none, if it is finished or was given up, or
    /// if it is open elsewhere.
    pub fn resume(
        &self,
        participant: &ParticipantId,
        station: &str,
        now: OffsetDateTime,
    ) -> Result<Enrolment, RecordError> {
        check_station(station)?;
        let path = self.data_path(participant);
        if !path.exists() {
            return Err(unknown(participant));
        }
        let (log, rows) = RowLog::reopen(&path, participant.as_str())?;
        if rows.rows.len() >= self.identity.trials() {
            return Err(RecordError::Finished {
                participant: participant.to_string(),
                answered: rows.rows.len(),
            });
        }
        let held = match self.held(participant)? {
            Some(held) => held,
            None => {
                // Interrupted between making the file and claiming the slot.
                self.claim(participant, station, now)?;
                self.held(participant)?
                    .ok_or_else(|| unknown(participant))?
            }
        };
        let claim = held.latest();
        if held.files(claim).released {
            return Err(RecordError::Released {
                participant: participant.to_string(),
                slot: claim.slot,
            });
        }
        let interrupted_utc = last_on_record(&rows.rows, &held.times_utc()?);
        let segment = held.add_segment(&segment_record(station, now, &rows))?;
        Ok(Enrolment {
            participant: participant.clone(),
            slot: claim.slot,
            session: 1,
            segment,
            pilot: held.slots.is_pilot(),
            station: station.to_owned(),
            rows: rows.rows,
            interrupted_utc,
            warnings: rows.warnings.iter().map(ToString::to_string).collect(),
            log,
            about: about::load(&self.folder, participant)?,
            results: self.folder.clone(),
        })
    }

    /// The slot the next new participant would take.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn next_slot(&self) -> Result<u32, RecordError> {
        let slots = self.slots(self.pilot);
        slots.next_open().map(|claim| claim.slot)
    }

    /// Rows on record of a participant, `None` if the id is new.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn answered(&self, participant: &ParticipantId) -> Result<Option<usize>, RecordError> {
        let path = self.data_path(participant);
        if !path.exists() {
            return Ok(None);
        }
        read::read_rows(&path).map(|rows| Some(rows.rows.len()))
    }

    /// Whole rows on record of a participant; none if the id is new.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn rows(&self, participant: &ParticipantId) -> Result<Vec<TrialRow>, RecordError> {
        let path = self.data_path(participant);
        if !path.exists() {
            return Ok(Vec::new());
        }
        read::read_rows(&path).map(|read| read.rows)
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

    pub(super) fn is_pilot(&self) -> bool {
        self.pilot
    }

    pub(super) fn slots(&self, pilot: bool) -> Slots {
        Slots::new(&self.folder, pilot, KnownClaims::clone(&self.known_claims))
    }

    /// Psych-DS: keys in lower case, values of letters and digits only.
    pub(super) fn data_path(&self, participant: &ParticipantId) -> PathBuf {
        let alphanumeric = |c: &char| c.is_ascii_alphanumeric();
        let study: String = self
            .identity
            .study_id
            .chars()
            .filter(alphanumeric)
            .collect();
        let subject = participant.file_value();
        self.folder.join(super::DATA_FOLDER).join(format!(
            "study-{study}_subject-{subject}_session-1{}",
            super::DATA_SUFFIX
        ))
    }

    fn claim(
        &self,
        participant: &ParticipantId,
        station: &str,
        now: OffsetDateTime,
    ) -> Result<Claim, RecordError> {
        let slots = self.slots(self.pilot);
        slots.claim(&claim_record(participant, station, now))
    }
}

/// What one segment's file says of the data file it goes on with.
fn segment_record(station: &str, now: OffsetDateTime, rows: &Rows) -> SegmentRecord {
    let lines = |of: fn(Flaw) -> bool| {
        let found = rows.warnings.iter().filter(move |found| of(found.flaw));
        found.map(|found| found.line)
    };
    SegmentRecord {
        station: station.to_owned(),
        resumed_utc: iso_8601(now),
        ended_torn_line: lines(|flaw| flaw == Flaw::CutOff).next(),
        damaged_lines: lines(|flaw| flaw != Flaw::Repeated).collect(),
    }
}

pub(super) fn claim_record(
    participant: &ParticipantId,
    station: &str,
    now: OffsetDateTime,
) -> ClaimRecord {
    ClaimRecord {
        participant: participant.to_string(),
        station: station.to_owned(),
        claimed_utc: iso_8601(now),
    }
}

pub(super) fn unknown(participant: &ParticipantId) -> RecordError {
    RecordError::UnknownParticipant {
        participant: participant.to_string(),
    }
}

fn check_station(station: &str) -> Result<(), RecordError> {
    let length = station.chars().count();
    if (1..=64).contains(&length) && !station.chars().any(char::is_control) {
        return Ok(());
    }
    Err(RecordError::Station {
        found: station.to_owned(),
    })
}

/// The latest wall-clock time a session has left on record; `others_utc` are those of
/// its claims and segments.
fn last_on_record(rows: &[TrialRow], others_utc: &[String]) -> Option<OffsetDateTime> {
    let answered = rows.iter().map(|row| row.answered_utc.as_str());
    answered
        .chain(others_utc.iter().map(String::as_str))
        .filter_map(|utc| OffsetDateTime::parse(utc, &Rfc3339).ok())
        .max()
}

/// UTC, ISO 8601 (RFC 3339).
pub(crate) fn iso_8601(at: OffsetDateTime) -> String {
    at.to_offset(time::UtcOffset::UTC)
        .format(&Rfc3339)
        .unwrap_or_default()
}
