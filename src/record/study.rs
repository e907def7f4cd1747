//! A results folder: one study, its participants and their slots.

use std::path::{Path, PathBuf};

use time::OffsetDateTime;
use time::format_description::well_known::Rfc3339;

use super::slots::{self, Claim, ClaimRecord, Release, SegmentRecord, Slots};
use super::{
    About, ParticipantId, RecordError, RowLog, StudyIdentity, TrialRow, about, description, files,
    read,
};

/// An open results folder.
#[derive(Debug)]
pub struct Study {
    folder: PathBuf,
    identity: StudyIdentity,
    pilot: bool,
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

/// Where one participant stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Standing {
    /// The participant's id.
    pub participant: String,
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// Trials on record.
    pub answered: usize,
    /// Set if the slot was given up.
    pub released: Option<Release>,
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
        };
        let path = folder.join("study.json");
        if !path.exists() {
            // Whoever is first decides what the folder belongs to.
            files::create_whole(&path, &slots::json(&path, &study.identity)?)?;
        }
        study.identity.check_against(folder, &slots::load(&path)?)?;
        study.keep("materials/protocol.toml", protocol_text.as_bytes())?;
        let path = folder.join("dataset_description.json");
        let description = description::dataset_description(&study.identity);
        study.keep(
            "dataset_description.json",
            &slots::json(&path, &description)?,
        )?;
        Ok(study)
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
        let Some(log) = RowLog::create(&path, participant.as_str())? else {
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
        let (slots, claim, record) = match self.find_claim(participant)? {
            Some(found) => found,
            // Interrupted between making the file and claiming the slot.
            None => (
                Slots::new(&self.folder, self.pilot),
                self.claim(participant, station, now)?,
                claim_record(participant, station, now),
            ),
        };
        if slots.released(claim)?.is_some() {
            return Err(RecordError::Released {
                participant: participant.to_string(),
                slot: claim.slot,
            });
        }
        let interrupted_utc = last_on_record(&rows.rows, &slots.segments(claim)?, &record);
        let segment = slots.add_segment(
            claim,
            &SegmentRecord {
                station: station.to_owned(),
                resumed_utc: iso_8601(now),
            },
        )?;
        Ok(Enrolment {
            participant: participant.clone(),
            slot: claim.slot,
            session: 1,
            segment,
            pilot: slots.is_pilot(),
            station: station.to_owned(),
            rows: rows.rows,
            interrupted_utc,
            warnings: rows.warnings.iter().map(ToString::to_string).collect(),
            log,
            about: about::load(&self.folder, participant)?,
            results: self.folder.clone(),
        })
    }

    /// Gives a drop-out's slot to the next participant; both stay on record.
    ///
    /// # Errors
    /// [`RecordError`], also if the participant holds no slot or the session is running.
    pub fn release(
        &self,
        participant: &ParticipantId,
        reason: &str,
        now: OffsetDateTime,
    ) -> Result<u32, RecordError> {
        let path = self.data_path(participant);
        if !path.exists() {
            return Err(unknown(participant));
        }
        // Held until the end: nobody resumes what is being given up.
        let _log = RowLog::reopen(&path, participant.as_str())?;
        let Some((slots, claim, _)) = self.find_claim(participant)? else {
            return Err(unknown(participant));
        };
        let release = Release {
            reason: reason.to_owned(),
            released_utc: iso_8601(now),
        };
        slots.release(claim, &release)?;
        Ok(claim.slot)
    }

    /// The slot the next new participant would take.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn next_slot(&self) -> Result<u32, RecordError> {
        let slots = Slots::new(&self.folder, self.pilot);
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

    /// Everybody who ever held a slot, by slot.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn standings(&self) -> Result<Vec<Standing>, RecordError> {
        let slots = Slots::new(&self.folder, self.pilot);
        let stands = |(claim, record): (Claim, ClaimRecord)| {
            let id = ParticipantId::new(&record.participant)?;
            Ok(Standing {
                slot: claim.slot,
                answered: self.answered(&id)?.unwrap_or(0),
                released: slots.released(claim)?,
                participant: record.participant,
            })
        };
        slots.claims()?.into_iter().map(stands).collect()
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

    /// Psych-DS: keys in lower case, values of letters and digits only.
    fn data_path(&self, participant: &ParticipantId) -> PathBuf {
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

    /// The latest claim of a participant, in either series.
    fn find_claim(
        &self,
        participant: &ParticipantId,
    ) -> Result<Option<(Slots, Claim, ClaimRecord)>, RecordError> {
        for pilot in [self.pilot, !self.pilot] {
            let slots = Slots::new(&self.folder, pilot);
            if let Some((claim, record)) = slots.find(participant.as_str())? {
                return Ok(Some((slots, claim, record)));
            }
        }
        Ok(None)
    }

    fn claim(
        &self,
        participant: &ParticipantId,
        station: &str,
        now: OffsetDateTime,
    ) -> Result<Claim, RecordError> {
        let slots = Slots::new(&self.folder, self.pilot);
        slots.claim(&claim_record(participant, station, now))
    }
}

fn claim_record(participant: &ParticipantId, station: &str, now: OffsetDateTime) -> ClaimRecord {
    ClaimRecord {
        participant: participant.to_string(),
        station: station.to_owned(),
        claimed_utc: iso_8601(now),
    }
}

fn unknown(participant: &ParticipantId) -> RecordError {
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

/// The latest wall-clock time a session has left on record.
fn last_on_record(
    rows: &[TrialRow],
    segments: &[SegmentRecord],
    claim: &ClaimRecord,
) -> Option<OffsetDateTime> {
    let resumed = segments.iter().map(|segment| segment.resumed_utc.as_str());
    let answered = rows.iter().map(|row| row.answered_utc.as_str());
    resumed
        .chain(answered)
        .chain([claim.claimed_utc.as_str()])
        .filter_map(|utc| OffsetDateTime::parse(utc, &Rfc3339).ok())
        .max()
}

/// UTC, ISO 8601 (RFC 3339).
pub(crate) fn iso_8601(at: OffsetDateTime) -> String {
    at.to_offset(time::UtcOffset::UTC)
        .format(&Rfc3339)
        .unwrap_or_default()
}
