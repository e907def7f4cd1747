//! What is noted while one trial runs, and the row it becomes.

use super::SessionTime;
use super::info::{ImageHashes, SessionInfo};
use super::machine::Rules;
use crate::protocol::procedure::{Ask, Step};
use crate::protocol::{Phase, SessionPlan, Trial};
use crate::record::TrialRow;
use crate::record::row::{InputDevice, LIST_SEPARATOR, OnsetMethod, Outcome, SCHEMA_VERSION};
use crate::record::study::iso_8601;

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
    /// Of the first and the second image.
    images: [Interval; 2],
    grey: Interval,
    question: Interval,
    /// Every step so far, in order.
    shown: Vec<Shown>,
    missed_frames: Option<u32>,
    pub grey_frames: Option<u32>,
    focus_lost: u32,
    unfocused: bool,
    pub input_device: InputDevice,
}

impl TrialLog {
    pub fn new(input_device: InputDevice) -> Self {
        Self {
            images: [Interval::default(); 2],
            grey: Interval::default(),
            question: Interval::default(),
            shown: Vec::new(),
            missed_frames: None,
            grey_frames: None,
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
            if let Some(interval) = self.interval(before) {
                interval.offset = Some(onset);
            }
        }
        if let Some(interval) = self.interval(step) {
            interval.onset = Some(onset);
        }
        // Images that stand beside the question come with it.
        if let Step::Ask(Ask::CloserToReference | Ask::Ranking) = step {
            self.images.iter_mut().for_each(|it| it.onset = Some(onset));
        }
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

    fn interval(&mut self, step: Step) -> Option<&mut Interval> {
        match step {
            Step::Image { place, .. } => self.images.get_mut(place),
            Step::Grey { .. } => Some(&mut self.grey),
            Step::Ask(_) => Some(&mut self.question),
        }
    }

    /// The row of a trial that is being answered; what was answered is not in it yet.
    pub fn row(
        &self,
        plan: &SessionPlan,
        trial: &Trial,
        rules: &Rules,
        info: &SessionInfo,
        answered: SessionTime,
    ) -> TrialRow {
        let ns = |time: Option<SessionTime>| time.map(|time| time.ns);
        let condition = &plan.conditions[trial.condition];
        let (technique_first, technique_second) = plan.techniques(trial);
        let hashes = Hashes::of(info, trial);
        let [first, second] = self.images;
        let is_ranking = rules.asks(Ask::Ranking);
        let (onset_method, onset_uncertainty_ms) = self.onset_method(info);
        TrialRow {
            row_id: row_id(info, trial),
            schema_version: SCHEMA_VERSION,
            app_version: env!("CARGO_PKG_VERSION").to_owned(),
            study_id: rules.study_id.clone(),
            protocol_hash: rules.protocol_hash.clone(),
            station_id: info.station_id.clone(),
            participant_id: info.participant_id.clone(),
            slot: plan.slot,
            session: info.session,
            segment: info.segment,
            pilot: info.pilot,
            procedure: rules.procedure.to_owned(),
            language: info.language,
            phase: trial.phase,
            trial_index: u32::try_from(trial.index).unwrap_or(u32::MAX),
            condition: condition.id.clone(),
            scene: condition.scene.clone(),
            technique_first: technique_first.to_owned(),
            technique_second: technique_second.to_owned(),
            technique_reference: condition.reference.clone().unwrap_or_default(),
            techniques_shown: if is_ranking {
                list(plan.shown(trial))
            } else {
                String::new()
            },
            first_image_sha256: hashes.at(0).to_owned(),
            second_image_sha256: hashes.at(1).to_owned(),
            reference_image_sha256: hashes.reference.to_owned(),
            images_sha256: if is_ranking {
                list(hashes.shown.iter().copied())
            } else {
                String::new()
            },
            first_onset_ns: ns(first.onset),
            first_offset_ns: ns(first.offset),
            grey_onset_ns: ns(self.grey.onset),
            grey_offset_ns: ns(self.grey.offset),
            second_onset_ns: ns(second.onset),
            second_offset_ns: ns(second.offset),
            question_onset_ns: ns(self.question.onset),
            response_ns: Some(answered.ns),
            grey_frames: self.grey_frames,
            onset_method,
            onset_uncertainty_ms,
            missed_frames: self.missed_frames,
            refresh_period_ms: info.display.refresh_period_ms,
            refresh_jitter_sd_ms: info.display.refresh_jitter_sd_ms,
            display_check: info.display.verdict,
            response: None,
            chosen_technique: None,
            correct: None,
            ratings: String::new(),
            ranking: String::new(),
            response_time_ms: self
                .question
                .onset
                .map(|onset| (answered.ns - onset.ns) as f64 / 1e6),
            input_device: self.input_device,
            focus_lost: self.focus_lost,
            outcome: Outcome::Answered,
            resume_gap_ms: info
                .interrupted_utc
                .map(|before| whole_milliseconds(info.wall_clock(answered) - before)),
            answered_utc: iso_8601(info.wall_clock(answered)),
        }
    }
}

/// Items of one cell.
pub(super) fn list<'a>(items: impl Iterator<Item = &'a str>) -> String {
    items.collect::<Vec<_>>().join(&LIST_SEPARATOR.to_string())
}

fn row_id(info: &SessionInfo, trial: &Trial) -> String {
    let phase = match trial.phase {
        Phase::Practice => "practice",
        Phase::Catch => "catch",
        Phase::Main => "main",
    };
    format!(
        "{}:{}:{phase}:{}",
        info.participant_id, info.session, trial.index
    )
}

/// Image hashes of a trial.
struct Hashes<'a> {
    /// By place.
    shown: Vec<&'a str>,
    reference: &'a str,
}

impl<'a> Hashes<'a> {
    fn of(info: &'a SessionInfo, trial: &Trial) -> Self {
        let known: Option<&'a ImageHashes> = info.images.get(trial.condition);
        let images = known.map_or(&[][..], |hashes| &hashes.images);
        let hash = |&image: &usize| images.get(image).map_or("", String::as_str);
        Self {
            shown: trial.places.iter().map(hash).collect(),
            reference: known
                .and_then(|hashes| hashes.reference.as_deref())
                .unwrap_or_default(),
        }
    }

    fn at(&self, place: usize) -> &'a str {
        self.shown.get(place).copied().unwrap_or_default()
    }
}

fn whole_milliseconds(duration: time::Duration) -> u64 {
    u64::try_from(duration.whole_milliseconds()).unwrap_or(0)
}
