//! Windows of their own for what is the experimenter's alone: the stimulus browser, the cost panel,
//! and replays.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use eframe::egui::{Context, Ui};
use winit::window::Window;

use super::browser::{Browser, Folder};
use super::replay::Replaying;
use super::study_page::StudyPage;
use super::tuner::{Tuner, Tuning};
use super::{AppError, START_PAGE, check_display, theme, window};

/// Size of the cost panel's window, points: controls beside a picture of 640 columns and more.
const TUNER: [u32; 2] = [1440, 900];

/// Height of a replay's bar of time with its controls, points.
const REPLAY_BAR: u32 = 64;

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

/// Opens the page of a study, which follows its sessions, and runs until its window is closed.
///
/// # Errors
/// As [`browse`].
pub fn watch(results: &Path) -> Result<(), AppError> {
    let title = format!("Greyfield: {}", results.display());
    let mut page = StudyPage::new(results, true);
    run(&title, START_PAGE, move |_ctx| {
        Box::new(move |ui| page.ui(ui))
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

/// Opens a window on a replay, large enough for its images, and runs until it is closed.
///
/// # Errors
/// As [`browse`].
pub fn replay(mut replaying: Replaying) -> Result<(), AppError> {
    let trials = &replaying.replay().trials;
    let images = || trials.iter().flat_map(|trial| &trial.images);
    let width = images().map(|image| image.width_px).max().unwrap_or(0);
    let height = images().map(|image| image.height_px).max().unwrap_or(0);
    // The images stand in the middle, and the bar of time under them.
    let with_bar = height + 2 * REPLAY_BAR;
    let size = [START_PAGE[0].max(width), START_PAGE[1].max(with_bar)];
    let title = trials.first().map_or_else(String::new, |trial| {
        format!("Greyfield: replay of {}", trial.row.participant_id)
    });
    run(&title, size, move |_| Box::new(move |ui| replaying.ui(ui)))
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
