//! Sessions without a window: scripted observers drive the session a window
//! drives, in virtual time, and their rows go the same way to disk.

use std::path::PathBuf;

use time::OffsetDateTime;

use super::observer::{Behaviour, Observer, Question, Scripted};
use super::start::{self, Setting, StartError};
use super::{DisplayOnRecord, Effect, Event, Screen, Session, SessionTime};
use crate::protocol::Protocol;
use crate::record::{Enrolment, InputDevice, OnsetMethod, ParticipantId, RecordError, Study};
use crate::stimulus::Manifest;

/// A headless run that could not go on.
#[derive(Debug, thiserror::Error)]
pub enum HeadlessError {
    /// The results folder.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The plan.
    #[error(transparent)]
    Start(#[from] StartError),
    /// An answer is not on disk. Nothing after it was asked.
    #[error(
        "participant {participant}: the answer to trial {trial} could not be saved: {detail}. Every answer before it is on disk; run the same command again to go on"
    )]
    Store {
        /// The participant.
        participant: String,
        /// Place in the session, from 0.
        trial: usize,
        /// What the disk said.
        detail: String,
    },
}

/// What a headless run tells while it runs.
#[derive(Debug)]
pub enum Progress<'a> {
    /// A session begins, or goes on.
    Started(&'a Enrolment),
    /// A row is on disk and synced.
    Stored {
        /// Its id.
        row_id: &'a str,
        /// Its file.
        path: &'a std::path::Path,
    },
    /// All trials of a participant are on record.
    Finished(&'a ParticipantId),
}

/// What a headless run did.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Summary {
    /// Sessions that were whole already.
    pub already_finished: u32,
    /// Sessions begun and finished.
    pub finished: u32,
    /// Interrupted sessions that were finished.
    pub resumed: u32,
    /// Rows written.
    pub rows: u64,
    /// Damaged lines that were passed over.
    pub warnings: Vec<String>,
    /// Where the data is.
    pub data: PathBuf,
}

/// Everything a headless run needs.
#[derive(Debug)]
pub struct Headless<'a> {
    /// The open results folder.
    pub study: &'a Study,
    /// The protocol.
    pub protocol: &'a Protocol,
    /// The rendered set.
    pub manifest: &'a Manifest,
    /// Who answers.
    pub scripted: &'a Scripted,
    /// Which computer.
    pub station: &'a str,
}

impl Headless<'_> {
    /// Runs the observers numbered 1 to `participants`: new ones are enrolled,
    /// interrupted ones resumed, finished ones left alone. `wall_clock` is asked once
    /// a session.
    ///
    /// # Errors
    /// [`HeadlessError`]; every row reported before is on disk.
    pub fn run(
        &self,
        participants: u32,
        wall_clock: impl Fn() -> OffsetDateTime,
        mut report: impl FnMut(Progress),
    ) -> Result<Summary, HeadlessError> {
        let mut summary = Summary {
            data: self.study.folder().join(crate::record::DATA_FOLDER),
            ..Summary::default()
        };
        for number in 1..=participants {
            let participant = ParticipantId::new(&self.scripted.participant_id(number))?;
            let now = wall_clock();
            let enrolment = match self.study.answered(&participant)? {
                None => self.study.enrol(&participant, self.station, now)?,
                Some(rows) if rows >= self.study.identity().trials() => {
                    summary.already_finished += 1;
                    continue;
                }
                Some(_) => self.study.resume(&participant, self.station, now)?,
            };
            report(Progress::Started(&enrolment));
            summary.warnings.extend(enrolment.warnings.iter().cloned());
            if enrolment.segment > 1 {
                summary.resumed += 1;
            } else {
                summary.finished += 1;
            }
            summary.rows += self.sit(enrolment, now, &mut report)?;
            report(Progress::Finished(&participant));
        }
        Ok(summary)
    }

    /// One session of an enrolled participant to its end; gives the number of rows
    /// written.
    ///
    /// # Errors
    /// [`HeadlessError`]; every row reported before is on disk.
    pub fn sit(
        &self,
        mut enrolment: Enrolment,
        now: OffsetDateTime,
        report: &mut impl FnMut(Progress),
    ) -> Result<u64, HeadlessError> {
        let setting = Setting {
            started_utc: now,
            onset_method: OnsetMethod::Virtual,
            onset_uncertainty_ms: Some(0.0),
            display: DisplayOnRecord::default(),
            refresh_period_ns: None,
            input_device: InputDevice::Scripted,
            language: self.protocol.language,
        };
        let mut session = start::start(self.protocol, self.manifest, &enrolment, &setting)?;
        let mut rows = 0;
        let store = |effect: &Effect| {
            let outcome = start::perform(effect, &mut enrolment);
            if let (Effect::StoreRow(row), Event::RowStored) = (effect, &outcome) {
                rows += 1;
                report(Progress::Stored {
                    row_id: &row.row_id,
                    path: enrolment.log.path(),
                });
            }
            outcome
        };
        let observer = &*self.scripted.observer;
        let outcome = sit(&mut session, self.protocol, observer, None, store);
        match outcome {
            Ok(()) => Ok(rows),
            Err(detail) => Err(HeadlessError::Store {
                participant: enrolment.participant.to_string(),
                trial: session.stored(),
                detail,
            }),
        }
    }
}

/// An observer sits a session to its end, or leaves it once so many trials are on record.
/// `store` does what an effect asks and gives the event to answer it with.
///
/// # Errors
/// What the storage said where it failed; nothing after it was asked.
pub fn sit(
    session: &mut Session,
    protocol: &Protocol,
    observer: &dyn Observer,
    leaves_after: Option<usize>,
    mut store: impl FnMut(&Effect) -> Event,
) -> Result<(), String> {
    let mut driver = Driver {
        observer,
        protocol,
        now: SessionTime::default(),
    };
    while !session.is_over() {
        if let Screen::StorageTrouble { detail } = session.screen() {
            return Err(detail.clone());
        }
        if leaves_after == Some(session.stored()) {
            session.handle(Event::Abort, driver.now);
            continue;
        }
        for effect in driver.act(session) {
            session.handle(store(&effect), driver.now);
        }
    }
    Ok(())
}

/// An observer before a screen, with a clock that only moves when it acts.
#[derive(Debug)]
struct Driver<'a> {
    observer: &'a dyn Observer,
    protocol: &'a Protocol,
    now: SessionTime,
}

impl Driver<'_> {
    /// Looks at the screen, waits as long as the observer would, and does what it
    /// would do. Gives the session's effects.
    fn act(&mut self, session: &mut Session) -> Vec<Effect> {
        session.handle(Event::Shown, self.now);
        let (wait_ns, event) = match session.screen() {
            Screen::Consent => (0, Event::Agree),
            Screen::Form => (0, Event::Told(Vec::new())),
            Screen::Instructions | Screen::Pause(_) => (0, Event::Begin),
            Screen::PairMenu { next, .. } | Screen::Ready { next, .. } => {
                (0, Event::StartPair(*next))
            }
            Screen::Image { trial, place } => {
                let behaviour = self.behaviour(session, *trial);
                (behaviour.looks_ns[*place], Event::Continue)
            }
            Screen::Question { trial }
            | Screen::Comparison { trial }
            | Screen::Rating { trial }
            | Screen::Ranking { trial } => {
                let behaviour = self.behaviour(session, *trial);
                (behaviour.decision_ns, Event::Answer(behaviour.answer))
            }
            _ => (0, Event::Tick),
        };
        let event_at = self.now.ns.saturating_add(wait_ns);
        // A screen that ends by itself is waited out.
        self.now.ns = session.wake_at().map_or(event_at, |wake| wake.ns);
        session.handle(event, self.now)
    }

    fn behaviour(&self, session: &Session, trial: usize) -> Behaviour {
        let plan = session.plan();
        let question = Question::new(self.protocol, plan, &plan.trials[trial]);
        self.observer.behave(&question)
    }
}
