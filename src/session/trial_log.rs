//! What is noted while one trial runs, and the row it becomes.

use time::OffsetDateTime;

use super::SessionTime;
use super::info::SessionInfo;
use super::machine::Identity;
use crate::protocol::procedure::Step;
use crate::protocol::{Position, SessionPlan, Trial};
use crate::record::row::{InputDevice, OnsetMethod, Outcome, SCHEMA_VERSION};
use crate::record::{TrialRow, study::iso_8601};

/// When something was on the display.
#[derive(Debug, Clone, Copy, Default)]
struct Interval {
    onset: Option<SessionTime>,
    offset: Option<SessionTime>,
}

/// A step that was on the display.
#[derive(Debug, Clone, Copy)]
struct Shown {
    step: Step,
    screen_serial: u64,
    onset: SessionTime,
    /// How well the display system knows the onset; absent while it is an estimate.
    measured_uncertainty_ns: Option<u64>,
}

/// Onsets and mishaps of the running trial.
#[derive(Debug, Clone)]
pub(super) struct TrialLog {
    first: Interval,
    grey: Interval,
    second: Interval,
    question: Interval,
    /// Every step so far, in order.
    shown: Vec<Shown>,
    missed_frames: Option<u32>,
    focus_lost: u32,
    unfocused: bool,
    pub input_device: InputDevice,
}

impl TrialLog {
    pub fn new(input_device: InputDevice) -> Self {
        Self {
            first: Interval::default(),
            grey: Interval::default(),
            second: Interval::default(),
            question: Interval::default(),
            shown: Vec::new(),
            missed_frames: None,
            focus_lost: 0,
            unfocused: false,
            input_device,
        }
    }

    /// A new trial begins; a window that is out of focus stays so.
    pub fn start(&mut self) {
        *self = Self {
            unfocused: self.unfocused,
            focus_lost: u32::from(self.unfocused),
            ..Self::new(self.input_device)
        };
    }

    pub fn focus_lost(&mut self) {
        self.unfocused = true;
        self.focus_lost = self.focus_lost.saturating_add(1);
    }

    pub fn focus_gained(&mut self) {
        self.unfocused = false;
    }

    pub fn missed_frames(&mut self, count: u32) {
        self.missed_frames = Some(self.missed_frames.unwrap_or(0).saturating_add(count));
    }

    /// The first frame of a step, which is the first one without the step before it.
    pub fn onset(&mut self, step: Step, screen_serial: u64, at: SessionTime) {
        self.shown.push(Shown {
            step,
            screen_serial,
            onset: at,
            measured_uncertainty_ns: None,
        });
        self.note_onset(self.shown.len() - 1);
    }

    /// Replaces the estimate of an onset by what the display system says. False,
    /// and nothing changed, if the screen is not of this trial or the time cannot
    /// be its own: not between the onsets of the steps round it.
    pub fn onset_known(
        &mut self,
        screen_serial: u64,
        at: SessionTime,
        uncertainty_ns: u64,
    ) -> bool {
        let same = |shown: &Shown| shown.screen_serial == screen_serial;
        let Some(index) = self.shown.iter().position(same) else {
            return false;
        };
        let after_the_one_before = index == 0 || self.shown[index - 1].onset <= at;
        let before_the_next = self
            .shown
            .get(index + 1)
            .is_none_or(|next| at <= next.onset);
        if !(after_the_one_before && before_the_next) {
            return false;
        }
        self.shown[index].onset = at;
        self.shown[index].measured_uncertainty_ns = Some(uncertainty_ns);
        self.note_onset(index);
        true
    }

    /// Puts the onset of a step where the row takes it from; it is the offset of
    /// the step before.
    fn note_onset(&mut self, index: usize) {
        let Shown { step, onset, .. } = self.shown[index];
        if let Some(before) = index.checked_sub(1) {
            let before = self.shown[before].step;
            self.interval(before).offset = Some(onset);
        }
        self.interval(step).onset = Some(onset);
    }

    /// How the onsets of the row were obtained, and how far they may be off: from
    /// the display system only if it told every one.
    fn onset_method(&self, info: &SessionInfo) -> (OnsetMethod, Option<f64>) {
        let uncertainties: Option<Vec<u64>> = self
            .shown
            .iter()
            .map(|shown| shown.measured_uncertainty_ns)
            .collect();
        match uncertainties.and_then(|all| all.into_iter().max()) {
            Some(largest_ns) => (OnsetMethod::PresentFeedback, Some(largest_ns as f64 / 1e6)),
            None => (info.onset_method, info.onset_uncertainty_ms),
        }
    }

    fn interval(&mut self, step: Step) -> &mut Interval {
        match step {
            Step::Image {
                position: Position::First,
                ..
            } => &mut self.first,
            Step::Image {
                position: Position::Second,
                ..
            } => &mut self.second,
            Step::Grey { .. } => &mut self.grey,
            Step::Question => &mut self.question,
        }
    }

    /// The row of an answered trial.
    pub fn row(
        &self,
        plan: &SessionPlan,
        trial: &Trial,
        identity: &Identity,
        info: &SessionInfo,
        choice: Position,
        answered: SessionTime,
    ) -> TrialRow {
        let ns = |time: Option<SessionTime>| time.map(|time| time.ns);
        let condition = &plan.conditions[trial.condition];
        let (technique_first, technique_second) = plan.techniques(trial);
        let chosen = match choice {
            Position::First => technique_first,
            Position::Second => technique_second,
        };
        let (first_hash, second_hash) = hashes(info, trial);
        let answered_utc = wall_clock(info, answered);
        let (onset_method, onset_uncertainty_ms) = self.onset_method(info);
        TrialRow {
            row_id: row_id(info, trial),
            schema_version: SCHEMA_VERSION,
            app_version: env!("CARGO_PKG_VERSION").to_owned(),
            study_id: identity.study_id.clone(),
            protocol_hash: identity.protocol_hash.clone(),
            station_id: info.station_id.clone(),
            participant_id: info.participant_id.clone(),
            slot: plan.slot,
            session: info.session,
            segment: info.segment,
            pilot: info.pilot,
            phase: trial.phase,
            trial_index: u32::try_from(trial.index).unwrap_or(u32::MAX),
            condition: condition.id.clone(),
            scene: condition.scene.clone(),
            technique_first: technique_first.to_owned(),
            technique_second: technique_second.to_owned(),
            first_image_sha256: first_hash,
            second_image_sha256: second_hash,
            first_onset_ns: ns(self.first.onset),
            first_offset_ns: ns(self.first.offset),
            grey_onset_ns: ns(self.grey.onset),
            grey_offset_ns: ns(self.grey.offset),
            second_onset_ns: ns(self.second.onset),
            second_offset_ns: ns(self.second.offset),
            question_onset_ns: ns(self.question.onset),
            response_ns: Some(answered.ns),
            onset_method,
            onset_uncertainty_ms,
            missed_frames: self.missed_frames,
            response: Some(choice),
            chosen_technique: Some(chosen.to_owned()),
            response_time_ms: self
                .question
                .onset
                .map(|onset| (answered.ns - onset.ns) as f64 / 1e6),
            input_device: self.input_device,
            focus_lost: self.focus_lost,
            outcome: Outcome::Answered,
            resume_gap_ms: info
                .interrupted_utc
                .map(|before| whole_milliseconds(answered_utc - before)),
            answered_utc: iso_8601(answered_utc),
        }
    }
}

fn row_id(info: &SessionInfo, trial: &Trial) -> String {
    let phase = match trial.phase {
        crate::protocol::Phase::Practice => "practice",
        crate::protocol::Phase::Catch => "catch",
        crate::protocol::Phase::Main => "main",
    };
    format!(
        "{}:{}:{phase}:{}",
        info.participant_id, info.session, trial.index
    )
}

/// Image hashes in the order shown.
fn hashes(info: &SessionInfo, trial: &Trial) -> (String, String) {
    let Some(pair) = info.images.get(trial.condition) else {
        return (String::new(), String::new());
    };
    let base = (pair.first.clone(), pair.second.clone());
    if trial.reversed {
        (base.1, base.0)
    } else {
        base
    }
}

fn wall_clock(info: &SessionInfo, at: SessionTime) -> OffsetDateTime {
    let since_start = time::Duration::nanoseconds(i64::try_from(at.ns).unwrap_or(i64::MAX));
    info.started_utc
        .checked_add(since_start)
        .unwrap_or(info.started_utc)
}

fn whole_milliseconds(duration: time::Duration) -> u64 {
    u64::try_from(duration.whole_milliseconds()).unwrap_or(0)
}
