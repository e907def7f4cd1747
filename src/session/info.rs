//! What a session needs to know beside its plan and its protocol.

use time::OffsetDateTime;

use crate::record::row::{InputDevice, OnsetMethod};

/// SHA-256 of a condition's two image files, in the base order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairHashes {
    /// Of the image that comes first in the base order.
    pub first: String,
    /// Of the other.
    pub second: String,
}

/// Who, where and since when.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionInfo {
    /// Participant's pseudonymous id.
    pub participant_id: String,
    /// Session of this participant, from 1.
    pub session: u32,
    /// Which uninterrupted run of the session, from 1.
    pub segment: u32,
    /// Which computer.
    pub station_id: String,
    /// Rows are marked as pilot data.
    pub pilot: bool,
    /// Wall-clock time at [`SessionTime`](super::SessionTime) 0.
    pub started_utc: OffsetDateTime,
    /// How the times of [`Event::Shown`](super::Event::Shown) are obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// Time from refresh to refresh, where a frame handed over stands for one whole
    /// refresh at least; timed screens then last a whole number of frames. `None`
    /// where that is not known: then the clock ends them.
    pub refresh_period_ns: Option<u64>,
    /// The device answers come from, until [`Event::UsedDevice`](super::Event::UsedDevice) says otherwise.
    pub input_device: InputDevice,
    /// Image hashes, one a condition of the plan, in its order.
    pub images: Vec<PairHashes>,
    /// Trials already on record; the session goes on with the next.
    pub answered: usize,
    /// When resumed: wall-clock time of what came last on record.
    pub interrupted_utc: Option<OffsetDateTime>,
}
