//! A study's results folder as it stands: read whole, beside the interface.

use std::path::Path;

use crate::app::start_page::participants;
use crate::protocol::Phase;
use crate::record::audit::{self, Severity};
use crate::record::{ParticipantId, RecordError, Standing, Study, TrialRow};

/// What the page shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// The study.
    pub study_id: String,
    /// Trials of a whole session.
    pub trials: usize,
    /// Everybody who ever held a slot, try-outs last.
    pub people: Vec<Person>,
    /// Attendance, balance, and the next place, in words.
    pub overview: Vec<String>,
    /// What the audit found: severity, and where and what.
    pub findings: Vec<(Severity, String)>,
}

/// One participant.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// Slot, trials on record, decisions.
    pub standing: Standing,
    /// Wall-clock time of the last answer, UTC, ISO 8601; empty before the first.
    pub last_answer_utc: String,
    /// Frames that came late, where they were counted.
    pub missed_frames: Option<u64>,
    /// How often the window was without the focus.
    pub focus_lost: u64,
    /// Catch trials passed and answered.
    pub catch: (u32, u32),
}

impl Snapshot {
    /// Reads a results folder.
    ///
    /// # Errors
    /// [`RecordError`] if it is none, or cannot be read.
    pub fn read(results: &Path) -> Result<Self, RecordError> {
        let mut study = Study::open_existing(results)?;
        let protocol = study.protocol()?;
        let conditions = study.identity().conditions.clone();
        let overview = participants(&study, &protocol, &conditions)?;
        let mut people = Vec::new();
        for pilot in [false, true] {
            study = study.pilot(pilot);
            for standing in study.standings()? {
                people.push(person(&study, standing)?);
            }
        }
        let findings = audit::audit(results)?.findings.into_iter();
        Ok(Self {
            study_id: study.identity().study_id.clone(),
            trials: study.identity().trials(),
            people,
            overview,
            findings: findings
                .map(|it| {
                    let line = it.line.map_or_else(String::new, |line| format!(":{line}"));
                    let text = format!("{}{line}: {}", it.path.display(), it.message);
                    (it.severity, text)
                })
                .collect(),
        })
    }

    /// How many findings there are of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        let found = self.findings.iter();
        found.filter(|(known, _)| *known == severity).count()
    }
}

fn person(study: &Study, standing: Standing) -> Result<Person, RecordError> {
    let id = ParticipantId::new(&standing.participant)?;
    let rows = study.rows(&id)?;
    let caught = |row: &&TrialRow| row.phase == Phase::Catch;
    let missed = rows.iter().filter_map(|row| row.missed_frames);
    let catch = rows.iter().filter(caught);
    Ok(Person {
        last_answer_utc: rows
            .last()
            .map_or_else(String::new, |row| row.answered_utc.clone()),
        missed_frames: rows
            .iter()
            .any(|row| row.missed_frames.is_some())
            .then(|| missed.map(u64::from).sum()),
        focus_lost: rows.iter().map(|row| u64::from(row.focus_lost)).sum(),
        catch: catch.fold((0, 0), |(right, all), row| {
            (right + u32::from(row.correct == Some(true)), all + 1)
        }),
        standing,
    })
}
