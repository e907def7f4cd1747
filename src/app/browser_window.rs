//! The stimulus browser in a window of its own.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use eframe::egui::{Context, Ui};
use winit::window::Window;

use super::browser::{Browser, Folder};
use super::{AppError, START_PAGE, check_display, theme, window};

/// Opens the browser on a folder of stimuli and runs until its window is closed.
///
/// # Errors
/// [`AppError`] if there is no display, no graphics adapter, or the window system fails.
pub fn browse(folder: Folder) -> Result<(), AppError> {
    check_display()?;
    let title = format!("Greyfield: {}", folder.manifest.set_id);
    let content = BrowserWindow::Opening(Some(Box::new(folder)));
    window::run(&title, START_PAGE, &(Rc::new(RefCell::new(content)) as _))
}

enum BrowserWindow {
    Opening(Option<Box<Folder>>),
    Open(Box<Browser>),
}

impl window::Content for BrowserWindow {
    fn ui(&mut self, ui: &mut Ui) {
        if let Self::Open(browser) = self {
            browser.ui(ui);
        }
    }

    fn opened(&mut self, ctx: &Context, _window: Option<Arc<Window>>) {
        theme::install(ctx);
        if let Self::Opening(folder) = self
            && let Some(folder) = folder.take()
        {
            *self = Self::Open(Box::new(Browser::of(ctx, Ok(*folder))));
        }
    }

    fn pressed(&mut self, _at: Instant) {}

    fn presented(&mut self, _ctx: &Context, _at: Instant) {}

    fn clear_level(&self) -> u8 {
        theme::BROWSER_STAGE
    }
}
