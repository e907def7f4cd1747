//! The session as a state machine: takes events (time, key, frame shown), gives
//! what to show and what to store. No window and no clock of its own, so that
//! every path of it can be tested; the application and the scripted observers
//! drive the same [`Session`](machine::Session).

mod answers;
pub mod deadline;
pub mod display_gate;
pub mod event;
pub mod frames;
pub mod headless;
pub mod info;
pub mod machine;
pub mod observer;
pub mod replay;
pub mod screen;
pub mod start;
#[cfg(test)]
mod tests;
mod trial_log;

pub use deadline::Deadline;
pub use display_gate::{DisplayFigures, Verdict};
pub use event::{Answer, Effect, Event, SessionTime};
pub use frames::{FrameFigures, FrameMeter};
pub use info::{DisplayOnRecord, ImageHashes, SessionInfo};
pub use machine::Session;
pub use screen::Screen;
