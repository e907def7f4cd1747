//! One row a trial: what was shown, when, and what was answered. The meaning of
//! every column for the data's readers stands in [`super::columns`].

use serde::{Deserialize, Serialize};

use crate::protocol::{Phase, Position};

/// Version of the row's layout; one more column is one more version.
pub const SCHEMA_VERSION: u32 = 1;

/// One trial on record. Times in `…_ns` are on the session's monotonic clock,
/// which starts at 0 with each segment of a session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrialRow {
    /// Unique in a study: `participant:session:phase:trial`.
    pub row_id: String,
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Greyfield's version.
    pub app_version: String,
    /// The study, from its protocol.
    pub study_id: String,
    /// SHA-256 of the protocol's file.
    pub protocol_hash: String,
    /// Which computer, as the experimenter named it.
    #[serde(with = "super::spreadsheet::free_text")]
    pub station_id: String,
    /// Participant's pseudonymous id.
    pub participant_id: String,
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// Session of this participant, from 1.
    pub session: u32,
    /// Which uninterrupted run of the session, from 1; 2 after the first resume.
    pub segment: u32,
    /// Recorded to try the study out; not data.
    pub pilot: bool,
    /// What the trial counts for.
    pub phase: Phase,
    /// Place in the session, from 0.
    pub trial_index: u32,
    /// Condition id.
    #[serde(with = "super::spreadsheet::free_text")]
    pub condition: String,
    /// Scene id.
    #[serde(with = "super::spreadsheet::free_text")]
    pub scene: String,
    /// Technique of the image shown first.
    #[serde(with = "super::spreadsheet::free_text")]
    pub technique_first: String,
    /// Technique of the image shown second.
    #[serde(with = "super::spreadsheet::free_text")]
    pub technique_second: String,
    /// SHA-256 of the file of the image shown first.
    pub first_image_sha256: String,
    /// SHA-256 of the file of the image shown second.
    pub second_image_sha256: String,
    /// First frame of the first image.
    pub first_onset_ns: Option<u64>,
    /// First frame without it.
    pub first_offset_ns: Option<u64>,
    /// First frame of the grey.
    pub grey_onset_ns: Option<u64>,
    /// First frame without it.
    pub grey_offset_ns: Option<u64>,
    /// First frame of the second image.
    pub second_onset_ns: Option<u64>,
    /// First frame without it.
    pub second_offset_ns: Option<u64>,
    /// First frame of the question.
    pub question_onset_ns: Option<u64>,
    /// When the answer was received.
    pub response_ns: Option<u64>,
    /// How the onsets were obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// Frames of this trial that came late; absent where nobody counted.
    pub missed_frames: Option<u32>,
    /// The participant's choice; absent where the outcome is not `answered`.
    pub response: Option<Position>,
    /// Technique of the image chosen.
    #[serde(with = "super::spreadsheet::optional_free_text")]
    pub chosen_technique: Option<String>,
    /// From the first frame of the question to the answer.
    pub response_time_ms: Option<f64>,
    /// What the answer was given with.
    pub input_device: InputDevice,
    /// How often the window was without the keyboard focus during the trial.
    pub focus_lost: u32,
    /// How the trial ended.
    pub outcome: Outcome,
    /// First row after a resume: wall-clock time since the row before it, or since
    /// the claim of the slot where there is none.
    pub resume_gap_ms: Option<u64>,
    /// Wall-clock time of the answer, UTC, ISO 8601.
    pub answered_utc: String,
}

/// How onset times were obtained.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnsetMethod {
    /// A scripted observer in virtual time; nothing was displayed.
    Virtual,
    /// The time the frame was handed over, an estimate; see the uncertainty.
    PresentCall,
    /// The display system said when the frame reached the screen.
    PresentFeedback,
}

/// What an answer was given with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InputDevice {
    /// A key.
    Keyboard,
    /// A button on the screen.
    Mouse,
    /// A game-pad.
    Gamepad,
    /// A scripted observer.
    Scripted,
}

/// How a trial ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// With an answer.
    Answered,
}
