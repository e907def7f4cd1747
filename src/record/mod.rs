//! Rows and files on disk: the append-only log, slots, resume, the dataset's
//! description.
//!
//! A participant's data is sacred: append, sync, never truncate, never overwrite,
//! never reuse a slot.
//!
//! ```text
//! RESULTS/study.json                 the one protocol this folder belongs to
//! RESULTS/materials/protocol.toml    that protocol, as it was
//! RESULTS/dataset_description.json   Psych-DS: what every column means
//! RESULTS/.psychdsignore             what is not for Psych-DS
//! RESULTS/slots/                     who has which place in the design, and what became of it
//! RESULTS/participants/              what participants agreed to and chose to tell of themselves
//! RESULTS/displays/                  what the display of each session was found to be
//! RESULTS/data/…_data.csv            one file a participant's session, one row a trial
//! ```

pub mod about;
pub mod audit;
pub mod columns;
pub mod description;
pub mod display;
pub mod error;
pub mod export;
mod files;
pub mod identity;
pub mod line;
pub mod log;
pub mod participant;
pub mod read;
pub mod row;
mod slots;
pub mod spreadsheet;
pub mod standing;
pub mod study;
#[cfg(test)]
pub(crate) mod tests;

pub use about::{About, AboutAnswer};
pub use error::RecordError;
pub use identity::StudyIdentity;
pub use log::RowLog;
pub use participant::ParticipantId;
pub use read::{Rows, Warning, read_folder, read_rows};
pub use row::{DisplayVerdict, InputDevice, OnsetMethod, Outcome, Response, TrialRow};
pub use slots::{Reinstatement, Rejection, Release};
pub use standing::{Reinstated, Standing, rejections};
pub use study::{Enrolment, Study};

/// Folder of the data files in a results folder.
pub const DATA_FOLDER: &str = "data";

/// How the name of every data file ends.
pub const DATA_SUFFIX: &str = "_data.csv";
