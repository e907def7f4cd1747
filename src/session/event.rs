//! What happens to a session, and what it asks for in return.

use crate::protocol::Position;

/// Nanoseconds on the session's one monotonic clock, which starts at 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct SessionTime {
    /// Nanoseconds since the session's clock started.
    pub ns: u64,
}

/// Something that happened. Every event comes with the time it was received.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Event {
    /// The button under the instructions.
    Begin,
    /// The button of one pair.
    StartPair(usize),
    /// The key that ends an image (space).
    Continue,
    /// A frame with the current screen was handed to the display; the time is an
    /// estimate of when (the row records how it was obtained). The first one of a
    /// screen is its onset, further ones are harmless. Where frames are reported
    /// late, compare [`Session::screen_serial`](super::Session::screen_serial)
    /// first: a frame of the screen before must not be reported for this one.
    Shown,
    /// Time has passed (the view was woken, nothing else happened).
    Tick,
    /// The participant's choice.
    Answer(Position),
    /// The row of [`Effect::StoreRow`] is on disk, synced.
    RowStored,
    /// It is not, and why.
    StoreFailed(String),
    /// Try to store the same row again.
    RetryStore,
    /// The window lost the keyboard focus.
    FocusLost,
    /// The window has it back.
    FocusGained,
    /// Input from now on comes from this device.
    UsedDevice(crate::record::InputDevice),
    /// So many frames came late since the last such event.
    MissedFrames(u32),
    /// The experimenter's chord.
    Abort,
}

/// What the driver of a session must do.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Append this row, sync it, then send [`Event::RowStored`] or [`Event::StoreFailed`].
    StoreRow(Box<crate::record::TrialRow>),
}
