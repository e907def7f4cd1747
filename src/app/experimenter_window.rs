//! Windows of their own for what is the experimenter's alone: the stimulus browser, and the cost
//! panel.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use eframe::egui::{Context, Ui};
use winit::window::Window;

use super::browser::{Browser, Folder};
use super::tuner::{Tuner, Tuning};
use super::{AppError, START_PAGE, check_display, theme, window};

/// Size of the cost panel's window, points: controls beside a picture of 640 columns and more.
const TUNER: [u32; 2] = [1440, 900];

/// Opens the browser on a folder of stimuli and runs until its window is closed.
///
/// # Errors
/// [`AppError`] if there is no display, no graphics adapter, or the window system fails.
pub fn browse(folder: Folder) -> Result<(), AppError> {
    let title = format!("Greyfield: {}", folder.manifest.set_id);
    run(&title, START_PAGE, move |ctx| {
        let mut browser = Browser::of(ctx, Ok(folder));
        Box::new(move |ui| browser.ui(ui))
    })
}

/// Opens the cost panel on a scene and runs until its window is closed.
///
/// # Errors
/// As [`browse`].
pub fn tune(tuning: Tuning) -> Result<(), AppError> {
    let title = format!("Greyfield: {}", tuning.scene.id);
    run(&title, TUNER, move |ctx| {
        let mut tuner = Tuner::new(ctx, tuning);
        Box::new(move |ui| tuner.ui(ui))
    })
}

/// What a window shows.
type Face = Box<dyn FnMut(&mut Ui)>;

/// How it is made once there is a window.
type Open = Box<dyn FnOnce(&Context) -> Face>;

fn run(
    title: &str,
    size_points: [u32; 2],
    open: impl FnOnce(&Context) -> Face + 'static,
) -> Result<(), AppError> {
    check_display()?;
    let content = ExperimenterWindow::Opening(Some(Box::new(open)));
    window::run(title, size_points, &(Rc::new(RefCell::new(content)) as _))
}

enum ExperimenterWindow {
    Opening(Option<Open>),
    Open(Face),
}

impl window::Content for ExperimenterWindow {
    fn ui(&mut self, ui: &mut Ui) {
        if let Self::Open(face) = self {
            face(ui);
        }
    }

    fn opened(&mut self, ctx: &Context, _window: Option<Arc<Window>>) {
        theme::install(ctx);
        if let Self::Opening(open) = self
            && let Some(open) = open.take()
        {
            *self = Self::Open(open(ctx));
        }
    }

    fn pressed(&mut self, _at: Instant) {}

    fn presented(&mut self, _ctx: &Context, _at: Instant) {}

    fn clear_level(&self) -> u8 {
        theme::BROWSER_STAGE
    }
}
