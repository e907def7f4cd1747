//! What is exported: the rows that were asked for, by participant.

use std::collections::BTreeMap;
use std::path::Path;

use crate::record::{
    About, DATA_FOLDER, DATA_SUFFIX, ParticipantId, RecordError, Standing, Study, StudyIdentity,
    TrialRow, about, files, read_rows, rejections,
};

/// Which rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Selection {
    /// Pilot rows too.
    pub include_pilot: bool,
    /// Rejected participants too.
    pub include_rejected: bool,
}

/// One participant's rows.
#[derive(Debug)]
pub struct Session {
    /// The participant's id.
    pub participant: String,
    /// Name of the data file.
    pub file: String,
    /// Rows, in order; none for a session in which nothing was answered.
    pub rows: Vec<TrialRow>,
    /// What was decided about the participant.
    pub standing: Option<Standing>,
    /// What the participant agreed to and told.
    pub about: Option<About>,
}

/// What is exported.
#[derive(Debug)]
pub struct Material {
    /// What the folder belongs to.
    pub identity: StudyIdentity,
    /// The protocol's file, if it is there.
    pub protocol: Option<Vec<u8>>,
    /// Participants with at least one row, in the order of their files.
    pub sessions: Vec<Session>,
    /// What was left out.
    pub notes: Vec<String>,
}

impl Material {
    /// Reads a results folder.
    ///
    /// # Errors
    /// [`RecordError`] if it is none, or holds what this version cannot read.
    pub fn read(results: &Path, selection: Selection) -> Result<Self, RecordError> {
        let study = Study::open_existing(results)?;
        let identity = study.identity().clone();
        let protocol = std::fs::read(results.join(crate::record::study::PROTOCOL_FILE)).ok();
        let rejected = rejections(results)?;
        let mut standings = BTreeMap::new();
        let mut study = study;
        for pilot in [true, false] {
            study = study.pilot(pilot);
            let these = study.standings()?.into_iter();
            standings.extend(these.map(|s| (s.participant.clone(), s)));
        }
        let mut left_out = LeftOut::default();
        let mut sessions = Vec::new();
        let folder = results.join(DATA_FOLDER);
        for name in files::names(&folder)? {
            if !name.ends_with(DATA_SUFFIX) || name.starts_with('.') {
                continue;
            }
            let read = read_rows(&folder.join(&name))?;
            left_out
                .notes
                .extend(read.warnings.iter().map(ToString::to_string));
            let Some(participant) = read.rows.first().map(|row| row.participant_id.clone()) else {
                continue;
            };
            if !selection.include_rejected && rejected.contains_key(&participant) {
                left_out.rejected.insert(participant, read.rows.len());
                continue;
            }
            let (rows, pilot): (Vec<_>, Vec<_>) = read
                .rows
                .into_iter()
                .partition(|row| selection.include_pilot || !row.pilot);
            left_out.pilot += pilot.len();
            if !rows.is_empty() {
                let id = ParticipantId::new(&participant)?;
                sessions.push(Session {
                    about: about::load(results, &id)?,
                    standing: standings.remove(&participant),
                    participant,
                    file: name,
                    rows,
                });
            }
        }
        if sessions.is_empty() {
            left_out.notes.push("There is no row to export.".to_owned());
        }
        Ok(Self {
            identity,
            protocol,
            sessions,
            notes: left_out.notes(),
        })
    }

    /// Ids of the questions about participants that anybody answered, in order.
    #[must_use]
    pub fn questions(&self) -> Vec<&str> {
        let told = self.sessions.iter().filter_map(|it| it.about.as_ref());
        let mut ids: Vec<&str> = Vec::new();
        for answer in told.flat_map(|about| &about.answers) {
            if !ids.contains(&answer.id.as_str()) {
                ids.push(&answer.id);
            }
        }
        ids
    }

    /// Every row, by participant.
    pub fn rows(&self) -> impl Iterator<Item = &TrialRow> {
        self.sessions.iter().flat_map(|session| &session.rows)
    }
}

#[derive(Default)]
struct LeftOut {
    pilot: usize,
    /// Rows by participant.
    rejected: BTreeMap<String, usize>,
    notes: Vec<String>,
}

impl LeftOut {
    fn notes(mut self) -> Vec<String> {
        if self.pilot > 0 {
            self.notes.push(format!(
                "{} rows of pilot sessions are left out; --include-pilot takes them in.",
                self.pilot
            ));
        }
        if !self.rejected.is_empty() {
            let ids: Vec<&str> = self.rejected.keys().map(String::as_str).collect();
            self.notes.push(format!(
                "{} rows of rejected participants are left out ({}); --include-rejected takes them in.",
                self.rejected.values().sum::<usize>(),
                ids.join(", ")
            ));
        }
        self.notes
    }
}
