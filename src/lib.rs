//! Greyfield: how accurate does ambient occlusion have to be before people stop
//! seeing the difference, and what does that accuracy cost in time?
//!
//! The path of the data is the layout of the modules ("rooms"); see
//! `docs/architecture.md` for what each may use and must never reach.
//!
//! ```text
//! scene config ─▶ scene ─▶ render ─▶ stimulus ─▶ protocol ─▶ session ─▶ record ─▶ analysis ─▶ report
//! ```
#![forbid(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

pub mod config;
pub mod digest;
pub mod embedded;
pub mod multi_bounce;
pub mod seed;

pub mod scene;

pub mod reference;

pub mod render;

pub mod stimulus;

pub mod cost;

pub mod protocol;

pub mod record;

pub mod session;

pub mod analysis;

pub mod planning;

pub mod report;

pub mod app;

pub mod cli;
