//! What stands on the participant's screen.

use crate::protocol::Pause;

/// The screen to show now. A view draws exactly this and nothing else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Screen {
    /// What the participant is asked to agree to ([`Event::Agree`](super::Event::Agree),
    /// [`Event::Decline`](super::Event::Decline)).
    Consent,
    /// Questions about the participant ([`Event::Told`](super::Event::Told)).
    Form,
    /// Text and one button ([`Event::Begin`](super::Event::Begin)).
    Instructions,
    /// A page between two trials and one button ([`Event::Begin`](super::Event::Begin)).
    Pause(Pause),
    /// A button a trial; only `next` is enabled ([`Event::StartPair`](super::Event::StartPair)).
    PairMenu {
        /// Index of the trial whose button is enabled; those before are done.
        next: usize,
        /// Number of trials.
        total: usize,
    },
    /// One button for the next trial ([`Event::StartPair`](super::Event::StartPair)).
    Ready {
        /// Index of the trial.
        next: usize,
        /// Number of trials.
        total: usize,
    },
    /// One stimulus, its own pixels, nothing else; the key on record ends it
    /// ([`Event::Continue`](super::Event::Continue)), or time.
    Image {
        /// Index of the trial.
        trial: usize,
        /// Which of its images, by time.
        place: usize,
    },
    /// Uniform grey; ends by itself (see [`Session::wake_at`](super::machine::Session::wake_at)).
    Grey {
        /// Index of the trial.
        trial: usize,
    },
    /// First or second ([`Answer::Choice`](super::Answer::Choice)).
    Question {
        /// Index of the trial.
        trial: usize,
    },
    /// Two images and the reference between them: which one is closer
    /// ([`Answer::Choice`](super::Answer::Choice))?
    Comparison {
        /// Index of the trial.
        trial: usize,
    },
    /// The scales ([`Answer::Ratings`](super::Answer::Ratings)).
    Rating {
        /// Index of the trial.
        trial: usize,
    },
    /// All images of the trial, to be put in order
    /// ([`Answer::Ranking`](super::Answer::Ranking)).
    Ranking {
        /// Index of the trial.
        trial: usize,
    },
    /// The answer is being written to disk; nothing to do for the participant.
    Saving,
    /// The answer could not be written. A calm sentence for the participant, the
    /// precise one for the experimenter; [`Event::RetryStore`](super::Event::RetryStore) tries again.
    StorageTrouble {
        /// For the experimenter.
        detail: String,
    },
    /// The end: thanks.
    Closing,
    /// The participant did not agree to take part.
    Declined,
    /// Ended before the end, on purpose.
    Aborted,
}
