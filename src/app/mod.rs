//! The application: the experimenter's start page and the participant's screens
//! in one window. It draws what the session says and holds no rule of its own.
//!
//! ```text
//! window       the event loop, and when things happened
//! application  start page, then one session after another
//! sitting      one session on the screen: input in, picture out, rows to disk
//! participant  one file a screen
//! ```

pub mod application;
pub mod clock;
pub mod display;
pub mod error;
pub mod participant;
pub mod pictures;
pub mod sitting;
pub mod start_page;
pub mod stimuli_check;
pub mod stimulus_view;
pub mod theme;
pub mod window;

use std::cell::RefCell;
use std::rc::Rc;

pub use application::{Application, Setup};
pub use display::available as display_available;
pub use error::AppError;

/// Smallest window the start page reads well in, points.
const START_PAGE: stimulus_view::SizePx = [1280, 800];

/// Opens the application on a study and runs until its window is closed.
///
/// # Errors
/// [`AppError`] if there is no display, no graphics adapter, or the window system
/// fails.
pub fn run(setup: Setup) -> Result<(), AppError> {
    if let Some(detail) = display::missing() {
        return Err(AppError::NoDisplay { detail });
    }
    let title = format!("Greyfield: {}", &*setup.protocol.study_id);
    let application = Application::new(setup);
    let image_px = application.image_px();
    let size_px = [0, 1].map(|axis| image_px[axis].max(START_PAGE[axis]));
    window::run(&title, size_px, &(Rc::new(RefCell::new(application)) as _))
}
