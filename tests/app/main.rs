//! The application, page by page, drawn without a window: what a person reads, presses and sees.
//!
//! One program for all of it, because each test program links the whole application once more.
#![allow(clippy::expect_used)] // a test ends where something is missing

mod browser;
mod procedures;
mod replay;
mod results_page;
mod same_rows;
mod session;
mod start_page;
mod stimulus_pixels;
mod study_page;
mod tuner;

#[path = "../support/desk.rs"]
mod desk;
#[path = "../support/recorded.rs"]
mod recorded;
#[path = "../support/mod.rs"]
mod support;
#[path = "../wall/mod.rs"]
mod wall;
