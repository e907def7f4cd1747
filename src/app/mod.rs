//! The application: the experimenter's start page and the participant's screens
//! in one window. It draws what the session says and holds no rule of its own.
//!
//! ```text
//! window       the event loop, and when things happened
//! application  start page, then one session after another
//! readiness    between the two: is the display as the protocol asks?
//! display_check  a second of grey before a session: does the display keep time
//! full_screen  covering the monitor
//! present_feedback  when frames were on the display, where the system tells
//! pace         when to ask for the next frame while a picture stands
//! sitting      one session on the screen: input in, picture out, rows to disk
//! participant  one file a screen
//! study_page   who is how far, decisions, exports; also in a window of its own
//! browser      the stimuli, for the experimenter alone
//! replay       a recorded session again, for the experimenter alone
//! tuner        what a technique costs, live, for the experimenter alone
//! stage        pictures under one zoom, in both
//! ```

pub mod application;
pub mod arrangement;
mod background;
pub mod browser;
pub mod clock;
pub mod display;
pub mod display_check;
pub mod error;
mod experimenter_window;
pub mod full_screen;
pub mod gamepad;
pub mod pace;
pub mod participant;
pub mod pictures;
pub mod present_feedback;
pub mod readiness;
pub mod replay;
pub mod sitting;
pub mod stage;
pub mod start_page;
pub mod stimuli_check;
pub mod stimulus_view;
pub mod study_page;
pub mod theme;
pub mod tuner;
pub mod window;

use std::cell::RefCell;
use std::rc::Rc;

pub use application::{Application, Setup};
pub use display::available as display_available;
pub use error::AppError;
pub use experimenter_window::{browse, replay, tune, watch};

/// Smallest window the start page reads well in, points.
const START_PAGE: [u32; 2] = [1280, 800];

/// Whether there is a display to open a window on.
///
/// # Errors
/// [`AppError::NoDisplay`] saying what is missing.
pub fn check_display() -> Result<(), AppError> {
    match display::missing() {
        Some(detail) => Err(AppError::NoDisplay { detail }),
        None => Ok(()),
    }
}

/// Opens the application on a study and runs until its window is closed.
///
/// # Errors
/// [`AppError`] if there is no display, no graphics adapter, or the window system
/// fails.
pub fn run(setup: Setup) -> Result<(), AppError> {
    check_display()?;
    let title = format!("Greyfield: {}", &*setup.protocol.study_id);
    let application = Application::new(setup);
    let image_px = application.image_px();
    let size = [0, 1].map(|axis| image_px[axis].max(START_PAGE[axis]));
    window::run(&title, size, &(Rc::new(RefCell::new(application)) as _))
}
