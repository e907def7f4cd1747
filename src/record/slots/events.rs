//! What the files under `slots/` say.

use serde::{Deserialize, Serialize};

/// What a claim's file says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::record) struct ClaimRecord {
    /// The participant's id.
    pub participant: String,
    /// The computer, as the experimenter named it.
    pub station: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub claimed_utc: String,
}

/// What the file of a resumed session says.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::record) struct SegmentRecord {
    /// The computer, as the experimenter named it.
    pub station: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub resumed_utc: String,
    /// The line of the data file that a crash had cut off and that this resume has
    /// ended with a line break, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ended_torn_line: Option<u64>,
    /// Every line of the data file that did not count when the session went on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub damaged_lines: Vec<u64>,
}

/// Why and when a slot was given up.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Release {
    /// The experimenter's words.
    pub reason: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub released_utc: String,
}

/// Why and when a participant's data was marked as not to be counted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejection {
    /// The experimenter's words.
    pub reason: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub rejected_utc: String,
}

/// Why and when a rejection was taken back.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Reinstatement {
    /// The experimenter's words; empty where none were given.
    pub reason: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub reinstated_utc: String,
}
