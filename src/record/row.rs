//! One row a trial: what was shown, when, and what was answered. The meaning of
//! every column for the data's readers stands in [`super::columns`].

use serde::{Deserialize, Serialize};

use crate::protocol::{Language, Phase, Position};

/// Version of the row's layout; one more column is one more version.
pub const SCHEMA_VERSION: u32 = 2;

/// What stands between the items of a list in one cell.
pub const LIST_SEPARATOR: char = ';';

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
    /// What a trial is made of (`no-reference`); empty in rows of version 1, which knew that one only.
    #[serde(default)]
    pub procedure: String,
    /// Language of the participant's screens.
    #[serde(default)]
    pub language: Language,
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
    /// Technique of the image shown first, or on the left, or alone.
    #[serde(with = "super::spreadsheet::free_text")]
    pub technique_first: String,
    /// Technique of the image shown second, or on the right; empty where one was shown alone.
    #[serde(with = "super::spreadsheet::free_text")]
    pub technique_second: String,
    /// Technique of the image they were compared with; empty where there was none.
    #[serde(default, with = "super::spreadsheet::free_text")]
    pub technique_reference: String,
    /// Techniques of all images of a ranking, by place on the screen; empty otherwise.
    #[serde(default, with = "super::spreadsheet::free_text")]
    pub techniques_shown: String,
    /// SHA-256 of the file of the image shown first.
    pub first_image_sha256: String,
    /// SHA-256 of the file of the image shown second.
    pub second_image_sha256: String,
    /// SHA-256 of the file of the reference.
    #[serde(default)]
    pub reference_image_sha256: String,
    /// SHA-256 of the files of all images of a ranking, by place on the screen.
    #[serde(default)]
    pub images_sha256: String,
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
    /// Frames the grey stood for; absent where nobody counted.
    #[serde(default)]
    pub grey_frames: Option<u32>,
    /// How the onsets were obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// Frames of this trial that came late; absent where nobody counted.
    pub missed_frames: Option<u32>,
    /// Period of the display as measured before the session; absent where nobody measured.
    #[serde(default)]
    pub refresh_period_ms: Option<f64>,
    /// Standard deviation of its frames' intervals.
    #[serde(default)]
    pub refresh_jitter_sd_ms: Option<f64>,
    /// What the display check said.
    #[serde(default)]
    pub display_check: DisplayVerdict,
    /// The participant's choice; absent where images were rated or ranked.
    pub response: Option<Response>,
    /// Technique of the image chosen.
    #[serde(with = "super::spreadsheet::optional_free_text")]
    pub chosen_technique: Option<String>,
    /// Whether a catch trial was passed; absent in all others.
    #[serde(default)]
    pub correct: Option<bool>,
    /// Ratings of a single image, `scale=points` each; empty otherwise.
    #[serde(default)]
    pub ratings: String,
    /// Techniques of a ranking, the best one first; empty otherwise.
    #[serde(default, with = "super::spreadsheet::free_text")]
    pub ranking: String,
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

/// A choice on record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Response {
    /// The image shown first, or on the left.
    First,
    /// The image shown second, or on the right.
    Second,
    /// Neither: the participant could not tell.
    CannotTell,
}

impl Response {
    /// The image chosen, if one was.
    #[must_use]
    pub fn position(self) -> Option<Position> {
        match self {
            Self::First => Some(Position::First),
            Self::Second => Some(Position::Second),
            Self::CannotTell => None,
        }
    }
}

impl From<Position> for Response {
    fn from(position: Position) -> Self {
        match position {
            Position::First => Self::First,
            Position::Second => Self::Second,
        }
    }
}

/// What the check of the display said before the session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DisplayVerdict {
    /// Nothing was checked: no display, or rows of version 1.
    #[default]
    Unchecked,
    /// It was as the protocol asks.
    Passed,
    /// It was not, and the protocol only warns.
    Warned,
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
