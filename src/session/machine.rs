//! The state machine of one participant's session.

use super::info::SessionInfo;
use super::trial_log::TrialLog;
use super::{Deadline, Effect, Event, Screen, SessionTime};
use crate::protocol::procedure::{Step, Until};
use crate::protocol::{Position, Protocol, SessionPlan};
use crate::record::TrialRow;

/// One participant's session, from the instructions to the thanks.
///
/// A driver draws [`Session::screen`], hands every event to [`Session::handle`]
/// with the time it was received, does what the effects say, and sends
/// [`Event::Tick`] at [`Session::wake_at`]. Events that have no meaning on the
/// current screen are ignored, so a driver may send what it gets.
///
/// The images, the grey and the question take no input before their first
/// [`Event::Shown`]: what the participant has not seen cannot be answered. For the
/// same reason input received before that frame is ignored, whenever it is reported.
#[derive(Debug, Clone)]
pub struct Session {
    plan: SessionPlan,
    identity: Identity,
    steps: Vec<Step>,
    info: SessionInfo,
    state: State,
    screen: Screen,
    screen_serial: u64,
    /// When the current screen became the one to show.
    entered_at: SessionTime,
    /// First frame of the current screen, as well as it is known by now.
    shown_at: Option<SessionTime>,
    /// The same as it was first reported: what frames to come are compared with.
    handed_over_at: Option<SessionTime>,
    /// Frames reported with the current screen.
    frames_shown: u64,
    /// Latest time seen: time never runs backwards.
    now: SessionTime,
    trial_log: TrialLog,
    /// The answer that is not on disk yet.
    unsaved: Option<Box<TrialRow>>,
    stored: usize,
}

/// What the protocol puts into every row.
#[derive(Debug, Clone)]
pub(super) struct Identity {
    pub study_id: String,
    pub protocol_hash: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Instructions,
    Menu,
    Step(usize),
    /// Waiting for the row; `abort` remembers a chord pressed meanwhile.
    Saving {
        abort: bool,
    },
    Trouble,
    Closing,
    Aborted,
}

impl Session {
    /// A session that stands at its instructions. With
    /// [`SessionInfo::answered`] it goes on after the trials on record.
    #[must_use]
    pub fn new(plan: SessionPlan, protocol: &Protocol, info: SessionInfo) -> Self {
        let stored = info.answered.min(plan.trials.len());
        Self {
            steps: (protocol.procedure.steps)(protocol),
            identity: Identity {
                study_id: protocol.study_id.to_string(),
                protocol_hash: protocol.hash.clone(),
            },
            trial_log: TrialLog::new(info.input_device),
            plan,
            info,
            state: State::Instructions,
            screen: Screen::Instructions,
            screen_serial: 0,
            entered_at: SessionTime::default(),
            shown_at: None,
            handed_over_at: None,
            frames_shown: 0,
            now: SessionTime::default(),
            unsaved: None,
            stored,
        }
    }

    /// What stands on the participant's screen.
    #[must_use]
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// Counts the screens so far; changes whenever the screen changes.
    #[must_use]
    pub fn screen_serial(&self) -> u64 {
        self.screen_serial
    }

    /// True once a frame with the current screen has been reported.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.shown_at.is_some()
    }

    /// When to send [`Event::Tick`] (where frames are counted,
    /// [`Event::NextFrame`]) at the latest: the end of a timed screen. `None` where
    /// nothing ends by itself.
    #[must_use]
    pub fn wake_at(&self) -> Option<SessionTime> {
        self.deadline().map(|deadline| deadline.at())
    }

    fn deadline(&self) -> Option<Deadline> {
        let State::Step(step) = self.state else {
            return None;
        };
        let duration_ns = match self.steps[step] {
            Step::Grey { duration_ns }
            | Step::Image {
                until: Until::Elapsed { duration_ns },
                ..
            } => duration_ns,
            _ => return None,
        };
        self.handed_over_at.map(|onset| Deadline {
            onset,
            duration_ns,
            period_ns: self.info.refresh_period_ns,
        })
    }

    /// Whether this event ends the timed screen that stands.
    fn is_end(&self, event: &Event) -> bool {
        self.deadline().is_some_and(|deadline| match event {
            Event::NextFrame { expected } if self.info.refresh_period_ns.is_some() => {
                deadline.next_frame_is_after(self.frames_shown, *expected)
            }
            _ => deadline.has_passed(self.now),
        })
    }

    /// The plan this session follows.
    #[must_use]
    pub fn plan(&self) -> &SessionPlan {
        &self.plan
    }

    /// Trials on record, those of earlier segments included.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.stored
    }

    /// True once nothing more can happen: thanks said, or ended early.
    #[must_use]
    pub fn is_over(&self) -> bool {
        matches!(self.state, State::Closing | State::Aborted)
    }

    /// Takes one event and the time it was received.
    pub fn handle(&mut self, event: Event, at: SessionTime) -> Vec<Effect> {
        self.now = self.now.max(at);
        self.note(&event);
        if self.is_end(&event) {
            self.next_step();
            // What was pressed or shown belongs to the screen that has just ended.
            if !matches!(event, Event::Abort) {
                return Vec::new();
            }
        }
        if is_input(&event) && self.shown_at.is_some_and(|onset| at < onset) {
            return Vec::new();
        }
        match (self.state, event) {
            (State::Closing | State::Aborted, _) => Vec::new(),
            (State::Saving { .. }, Event::Abort) => {
                self.state = State::Saving { abort: true };
                Vec::new()
            }
            (_, Event::Abort) => {
                self.enter(State::Aborted, Screen::Aborted);
                Vec::new()
            }
            (_, Event::Shown) => {
                self.shown(at);
                Vec::new()
            }
            (State::Instructions, Event::Begin) => {
                self.next_trial();
                Vec::new()
            }
            (State::Menu, Event::StartPair(index)) if index == self.stored => {
                self.trial_log.start();
                self.enter_step(0);
                Vec::new()
            }
            (State::Step(step), Event::Continue) if self.accepts_continue(step) => {
                self.next_step();
                Vec::new()
            }
            (State::Step(step), Event::Answer(choice)) if self.accepts_answer(step) => {
                self.answer(choice)
            }
            (State::Saving { abort }, Event::RowStored) => {
                self.row_stored(abort);
                Vec::new()
            }
            (State::Saving { .. }, Event::StoreFailed(detail)) => {
                let trial = self.stored;
                self.enter(State::Trouble, Screen::StorageTrouble { trial, detail });
                Vec::new()
            }
            (State::Trouble, Event::RetryStore) => self.store(),
            _ => Vec::new(),
        }
    }

    /// Keeps count of what may happen at any time.
    fn note(&mut self, event: &Event) {
        match event {
            Event::FocusLost => self.trial_log.focus_lost(),
            Event::FocusGained => self.trial_log.focus_gained(),
            Event::MissedFrames(count) => self.trial_log.missed_frames(*count),
            Event::UsedDevice(device) => self.trial_log.input_device = *device,
            Event::OnsetKnown {
                screen_serial,
                at,
                uncertainty_ns,
            } => self.onset_known(*screen_serial, *at, *uncertainty_ns),
            _ => {}
        }
    }

    fn onset_known(&mut self, screen_serial: u64, at: SessionTime, uncertainty_ns: u64) {
        let taken = at <= self.now
            && self
                .trial_log
                .onset_known(screen_serial, at, uncertainty_ns);
        if taken && screen_serial == self.screen_serial {
            self.shown_at = Some(at);
        }
    }

    fn enter(&mut self, state: State, screen: Screen) {
        self.state = state;
        self.screen = screen;
        self.screen_serial += 1;
        self.entered_at = self.now;
        self.shown_at = None;
        self.handed_over_at = None;
        self.frames_shown = 0;
    }

    /// A display may report a frame after later events: its own time counts, not
    /// the time of the report, but never one before the screen was asked for.
    fn shown(&mut self, at: SessionTime) {
        self.frames_shown += 1;
        if self.shown_at.is_some() {
            return;
        }
        let onset = at.max(self.entered_at);
        self.shown_at = Some(onset);
        self.handed_over_at = Some(onset);
        if let State::Step(step) = self.state {
            self.trial_log
                .onset(self.steps[step], self.screen_serial, onset);
        }
    }

    fn accepts_continue(&self, step: usize) -> bool {
        let self_paced = matches!(
            self.steps[step],
            Step::Image {
                until: Until::Continue,
                ..
            }
        );
        self_paced && self.shown_at.is_some()
    }

    fn accepts_answer(&self, step: usize) -> bool {
        self.steps[step] == Step::Question && self.shown_at.is_some()
    }

    fn next_step(&mut self) {
        if let State::Step(step) = self.state {
            self.enter_step(step + 1);
        }
    }

    fn enter_step(&mut self, step: usize) {
        let trial = self.stored;
        let screen = match self.steps[step] {
            Step::Image { position, .. } => Screen::Image { trial, position },
            Step::Grey { .. } => Screen::Grey { trial },
            Step::Question => Screen::Question { trial },
        };
        self.enter(State::Step(step), screen);
    }

    fn next_trial(&mut self) {
        let total = self.plan.trials.len();
        if self.stored < total {
            let next = self.stored;
            self.enter(State::Menu, Screen::PairMenu { next, total });
        } else {
            self.enter(State::Closing, Screen::Closing);
        }
    }

    fn answer(&mut self, choice: Position) -> Vec<Effect> {
        let trial = &self.plan.trials[self.stored];
        let row = self.trial_log.row(
            &self.plan,
            trial,
            &self.identity,
            &self.info,
            choice,
            self.now,
        );
        self.unsaved = Some(Box::new(row));
        self.store()
    }

    fn store(&mut self) -> Vec<Effect> {
        let trial = self.stored;
        self.enter(State::Saving { abort: false }, Screen::Saving { trial });
        self.unsaved.iter().cloned().map(Effect::StoreRow).collect()
    }

    fn row_stored(&mut self, abort: bool) {
        self.unsaved = None;
        self.stored += 1;
        // Only the first row after a resume tells of the gap.
        self.info.interrupted_utc = None;
        if abort {
            self.enter(State::Aborted, Screen::Aborted);
        } else {
            self.next_trial();
        }
    }
}

/// Whether an event is something the participant did in answer to the screen.
fn is_input(event: &Event) -> bool {
    matches!(
        event,
        Event::Begin | Event::StartPair(_) | Event::Continue | Event::Answer(_)
    )
}
