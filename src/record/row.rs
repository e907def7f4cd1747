//! One row a trial.

use serde::{Deserialize, Serialize};

use crate::protocol::Position;

/// One answered trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrialRow {
    /// Participant's pseudonymous id.
    pub participant_id: String,
    /// Place in the session, from 0.
    pub trial_index: u32,
    /// Condition id.
    pub condition: String,
    /// Technique of the image shown first.
    pub technique_first: String,
    /// Technique of the image shown second.
    pub technique_second: String,
    /// The participant's choice.
    pub response: Position,
}
