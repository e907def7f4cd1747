//! The state machine of one participant's session.

mod flow;
mod rules;

pub(super) use rules::Rules;

use super::info::SessionInfo;
use super::trial_log::TrialLog;
use super::{Answer, Deadline, Effect, Event, Screen, SessionTime, answers};
use crate::protocol::procedure::{Ask, Step, Until};
use crate::protocol::{Language, Protocol, SessionPlan};
use crate::record::About;

/// One participant's session, from the consent to the thanks.
///
/// A driver draws [`Session::screen`], hands every event to [`Session::handle`]
/// with the time it was received, does what the effects say, and sends
/// [`Event::Tick`] at [`Session::wake_at`]. Events that have no meaning on the
/// current screen are ignored, so a driver may send what it gets.
///
/// The images, the grey and the questions take no input before their first
/// [`Event::Shown`]: what the participant has not seen cannot be answered. For the
/// same reason input received before that frame is ignored, whenever it is reported.
#[derive(Debug, Clone)]
pub struct Session {
    plan: SessionPlan,
    rules: Rules,
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
    /// What is being agreed to and told.
    about: About,
    /// What is not on disk yet.
    unsaved: Option<Effect>,
    stored: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Consent,
    Form,
    Instructions,
    Pause,
    Start,
    Step(usize),
    /// Waiting for the disk; `abort` remembers a chord pressed meanwhile.
    Saving {
        abort: bool,
    },
    Trouble,
    Closing,
    Declined,
    Aborted,
}

impl Session {
    /// A session that stands at its first page. With
    /// [`SessionInfo::answered`] it goes on after the trials on record.
    #[must_use]
    pub fn new(plan: SessionPlan, protocol: &Protocol, info: SessionInfo) -> Self {
        let rules = Rules::new(protocol, &info);
        let (state, screen) = match (&rules.consent_sha256, rules.asks_about) {
            (Some(_), _) if !info.has_told => (State::Consent, Screen::Consent),
            (None, true) if !info.has_told => (State::Form, Screen::Form),
            _ => (State::Instructions, Screen::Instructions),
        };
        Self {
            trial_log: TrialLog::new(info.input_device),
            stored: info.answered.min(plan.trials.len()),
            about: About {
                participant: info.participant_id.clone(),
                language: info.language,
                consent_sha256: None,
                consented_utc: None,
                answers: Vec::new(),
            },
            plan,
            rules,
            info,
            state,
            screen,
            screen_serial: 0,
            entered_at: SessionTime::default(),
            shown_at: None,
            handed_over_at: None,
            frames_shown: 0,
            now: SessionTime::default(),
            unsaved: None,
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
        let duration_ns = match self.rules.steps[step] {
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

    /// Language of the participant's screens.
    #[must_use]
    pub fn language(&self) -> Language {
        self.info.language
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
        matches!(
            self.state,
            State::Closing | State::Declined | State::Aborted
        )
    }

    /// What the trial on the screen asks, where it asks.
    #[must_use]
    pub fn ask(&self) -> Option<Ask> {
        match self.state {
            State::Step(step) => match self.rules.steps[step] {
                Step::Ask(ask) => Some(ask),
                _ => None,
            },
            _ => None,
        }
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
        if self.is_over() {
            return Vec::new();
        }
        match event {
            Event::Abort => self.abort(),
            Event::Shown => self.shown(at),
            Event::Agree | Event::Decline | Event::Told(_) => return self.preliminary(event),
            Event::Begin => self.begin(),
            Event::StartPair(index) if self.state == State::Start && index == self.stored => {
                self.start_trial();
            }
            Event::Continue => {
                if let State::Step(step) = self.state
                    && self.accepts_continue(step)
                {
                    self.next_step();
                }
            }
            Event::Answer(answer) => return self.answer(&answer),
            Event::RowStored => {
                if let State::Saving { abort } = self.state {
                    self.is_stored(abort);
                }
            }
            Event::StoreFailed(detail) if matches!(self.state, State::Saving { .. }) => {
                self.enter(State::Trouble, Screen::StorageTrouble { detail });
            }
            Event::RetryStore if self.state == State::Trouble => return self.store(),
            _ => {}
        }
        Vec::new()
    }

    fn abort(&mut self) {
        if let State::Saving { abort } = &mut self.state {
            *abort = true;
        } else {
            self.enter(State::Aborted, Screen::Aborted);
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
        // Where frames are not paced by the display, their number says nothing.
        if matches!(self.screen, Screen::Grey { .. }) && self.info.refresh_period_ns.is_some() {
            let frames = u32::try_from(self.frames_shown).unwrap_or(u32::MAX);
            self.trial_log.grey_frames = Some(frames);
        }
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
                .onset(self.rules.steps[step], self.screen_serial, onset);
        }
    }

    fn accepts_continue(&self, step: usize) -> bool {
        let self_paced = matches!(
            self.rules.steps[step],
            Step::Image {
                until: Until::Continue,
                ..
            }
        );
        self_paced && self.shown_at.is_some()
    }

    fn answer(&mut self, answer: &Answer) -> Vec<Effect> {
        let Some(ask) = self.ask().filter(|_| self.shown_at.is_some()) else {
            return Vec::new();
        };
        let Some(trial) = self.plan.trials.get(self.stored) else {
            return Vec::new();
        };
        if !answers::fits(answer, ask, &self.rules, trial) {
            return Vec::new();
        }
        let row = self
            .trial_log
            .row(&self.plan, trial, &self.rules, &self.info, self.now);
        let row = answers::on_record(row, answer, &self.plan, trial, &self.rules);
        self.unsaved = Some(Effect::StoreRow(Box::new(row)));
        self.store()
    }

    fn store(&mut self) -> Vec<Effect> {
        self.enter(State::Saving { abort: false }, Screen::Saving);
        self.unsaved.iter().cloned().collect()
    }

    fn is_stored(&mut self, abort: bool) {
        let stored = self.unsaved.take();
        let is_row = matches!(stored, Some(Effect::StoreRow(_)));
        if is_row {
            self.stored += 1;
            // Only the first row after a resume tells of the gap.
            self.info.interrupted_utc = None;
        }
        if abort {
            self.enter(State::Aborted, Screen::Aborted);
        } else if is_row {
            self.next_trial(false);
        } else {
            self.enter(State::Instructions, Screen::Instructions);
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
