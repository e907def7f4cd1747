//! Rows and files on disk: the append-only log, slots, resume, the dataset's
//! description.
//!
//! A participant's data is sacred: append, sync, never truncate, never overwrite,
//! never reuse a slot.

pub mod row;

pub use row::TrialRow;
