//! What happens to a session, and what it asks for in return.

use crate::protocol::Position;
use crate::record::{About, AboutAnswer, TrialRow};

/// Nanoseconds on the session's one monotonic clock, which starts at 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct SessionTime {
    /// Nanoseconds since the session's clock started.
    pub ns: u64,
}

/// Something that happened. Every event comes with the time it was received.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Event {
    /// The participant agrees to take part.
    Agree,
    /// The participant does not.
    Decline,
    /// What the participant chose to tell, in the protocol's order.
    Told(Vec<AboutAnswer>),
    /// The button under a page of text.
    Begin,
    /// The button of one trial.
    StartPair(usize),
    /// The key that ends an image (space).
    Continue,
    /// A frame with the current screen was handed to the display; the time is an
    /// estimate of when (the row records how it was obtained). The first one of a
    /// screen is its onset; further ones count how long it has stood, so send one
    /// for every frame. Where frames are reported late, compare
    /// [`Session::screen_serial`](super::Session::screen_serial) first: a frame of
    /// the screen before must not be reported for this one.
    Shown,
    /// A frame is about to be drawn and will be handed over at about `expected`:
    /// where frames are counted, a timed screen ends with this event and no other,
    /// so that the frame already shows the next one.
    NextFrame {
        /// When, on the clock of [`Event::Shown`]; later than the event itself.
        expected: SessionTime,
    },
    /// The display system has told when the first frame of a screen reached the
    /// display. It replaces the estimate, if the trial it belongs to is still on and
    /// the time can be true: not to come, and between the onsets of the screens
    /// before and after.
    OnsetKnown {
        /// The screen, as [`Session::screen_serial`](super::Session::screen_serial) counts.
        screen_serial: u64,
        /// When.
        at: SessionTime,
        /// How far that may lie from the light of the display, either way.
        uncertainty_ns: u64,
    },
    /// Time has passed (the view was woken, nothing else happened).
    Tick,
    /// The participant's answer.
    Answer(Answer),
    /// What the last effect asked to store is on disk, synced.
    RowStored,
    /// It is not, and why.
    StoreFailed(String),
    /// Try to store the same again.
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

/// An answer to what a trial asks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// One of two images.
    Choice(Position),
    /// Neither, where the protocol allows it.
    CannotTell,
    /// One rating a scale, in the protocol's order, from 1.
    Ratings(Vec<u32>),
    /// Places of the images on the screen, the best image first.
    Ranking(Vec<usize>),
}

/// What the driver of a session must do, and then answer with [`Event::RowStored`] or
/// [`Event::StoreFailed`].
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Append this row and sync it.
    StoreRow(Box<TrialRow>),
    /// Put on record what the participant agreed to and told.
    StoreAbout(Box<About>),
}
