//! What stands on the participant's screen.

use crate::protocol::Position;

/// The screen to show now. A view draws exactly this and nothing else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Screen {
    /// Text and one button ([`Event::Begin`](super::Event::Begin)).
    Instructions,
    /// A button a pair; only `next` is enabled ([`Event::StartPair`](super::Event::StartPair)).
    PairMenu {
        /// Index of the trial whose button is enabled; those before are done.
        next: usize,
        /// Number of trials.
        total: usize,
    },
    /// One stimulus, its own pixels, nothing else; the key on record ends it
    /// ([`Event::Continue`](super::Event::Continue)).
    Image {
        /// Index of the trial.
        trial: usize,
        /// Which of its two images.
        position: Position,
    },
    /// Uniform grey; ends by itself (see [`Session::wake_at`](super::machine::Session::wake_at)).
    Grey {
        /// Index of the trial.
        trial: usize,
    },
    /// Which image looked more realistic ([`Event::Answer`](super::Event::Answer)).
    Question {
        /// Index of the trial.
        trial: usize,
    },
    /// The answer is being written to disk; nothing to do for the participant.
    Saving {
        /// Index of the trial.
        trial: usize,
    },
    /// The answer could not be written. A calm sentence for the participant, the
    /// precise one for the experimenter; [`Event::RetryStore`](super::Event::RetryStore) tries again.
    StorageTrouble {
        /// Index of the trial.
        trial: usize,
        /// For the experimenter.
        detail: String,
    },
    /// The end: thanks.
    Closing,
    /// Ended before the end, on purpose.
    Aborted,
}
