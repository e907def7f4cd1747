//! What a session needs to know beside its plan and its protocol.

use time::OffsetDateTime;

use super::SessionTime;
use crate::protocol::Language;
use crate::record::DisplayVerdict;
use crate::record::row::{InputDevice, OnsetMethod};
use crate::record::study::iso_8601;

/// SHA-256 of a condition's image files.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ImageHashes {
    /// Of its images, in the base order.
    pub images: Vec<String>,
    /// Of the reference.
    pub reference: Option<String>,
}

/// The display as it was measured before the session.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DisplayOnRecord {
    /// Mean time between two frames; absent where nobody measured.
    pub refresh_period_ms: Option<f64>,
    /// Standard deviation of those times.
    pub refresh_jitter_sd_ms: Option<f64>,
    /// What the check said.
    pub verdict: DisplayVerdict,
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
    /// Language of the participant's screens.
    pub language: Language,
    /// Wall-clock time at [`SessionTime`](super::SessionTime) 0.
    pub started_utc: OffsetDateTime,
    /// How the times of [`Event::Shown`](super::Event::Shown) are obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// The display.
    pub display: DisplayOnRecord,
    /// Time from refresh to refresh, where a frame handed over stands for one whole
    /// refresh at least; timed screens then last a whole number of frames. `None`
    /// where that is not known: then the clock ends them.
    pub refresh_period_ns: Option<u64>,
    /// The device answers come from, until [`Event::UsedDevice`](super::Event::UsedDevice) says otherwise.
    pub input_device: InputDevice,
    /// Image hashes, one a condition of the plan, in its order.
    pub images: Vec<ImageHashes>,
    /// Trials already on record; the session goes on with the next.
    pub answered: usize,
    /// Whether consent and questions about the participant are behind us.
    pub has_told: bool,
    /// When resumed: wall-clock time of what came last on record.
    pub interrupted_utc: Option<OffsetDateTime>,
}

impl SessionInfo {
    /// Wall-clock time of a moment on the session's clock.
    #[must_use]
    pub fn wall_clock(&self, at: SessionTime) -> OffsetDateTime {
        let since_start = time::Duration::nanoseconds(i64::try_from(at.ns).unwrap_or(i64::MAX));
        self.started_utc
            .checked_add(since_start)
            .unwrap_or(self.started_utc)
    }

    /// The same as it stands in files: UTC, ISO 8601.
    #[must_use]
    pub fn wall_clock_text(&self, at: SessionTime) -> String {
        iso_8601(self.wall_clock(at))
    }
}
