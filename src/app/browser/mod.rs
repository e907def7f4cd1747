//! The stimulus browser, for the experimenter: every pair of a set, side by side, one over the
//! other, their difference, what they are made of and where they came from.
//!
//! No session leads here, so that no participant ever sees which technique made an image.
//!
//! ```text
//! folder   what is looked at         gallery     the list of conditions
//! pair     two pictures, compared    facts       the side panel
//! opened   the folder and what is    controls    the row over the stage
//!          selected in it
//! buffers  a frame's targets
//! ```

mod buffers;
mod controls;
mod facts;
mod folder;
mod gallery;
mod opened;
mod pair;

use std::path::Path;

use eframe::egui::{CentralPanel, Context, Frame, Key, Panel, Ui};

use self::facts::Sheet;
pub use self::folder::Folder;
use self::opened::Opened;
use super::stage::{self, Stage};
use super::theme;
use crate::render::Buffer;
use crate::stimulus::manifest::PairRecord;

/// How the pair is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// One image, and the other in its place at a key.
    Flip,
    /// The first left of a divider, the second right of it.
    Split,
    /// What differs, amplified.
    Difference,
    /// One of the renderer's targets.
    Buffer(Buffer),
}

/// The browser.
pub struct Browser {
    opened: Result<Opened, String>,
    look: Look,
    /// The second image is on the stage.
    shows_second: bool,
    gain: u32,
    stage: Stage,
    sheet: Sheet,
    /// The line under the stage.
    reading: String,
    /// Whether there is a page to go back to.
    can_leave: bool,
    is_left: bool,
}

impl Browser {
    /// Opens a set config or a folder of stimuli; what is wrong with it is shown in its place.
    #[must_use]
    pub fn open(ctx: &Context, path: &Path) -> Self {
        Self::of(ctx, Folder::open(path))
    }

    /// A browser on a folder, or on the reason why there is none.
    #[must_use]
    pub fn of(ctx: &Context, folder: Result<Folder, String>) -> Self {
        let opened = folder.and_then(|folder| Opened::new(ctx, folder));
        Self {
            opened,
            look: Look::Flip,
            shows_second: false,
            gain: 4,
            stage: Stage::default(),
            sheet: Sheet::Pair,
            reading: String::from(" "),
            can_leave: false,
            is_left: false,
        }
    }

    /// The same, with a way back to where it was opened from.
    #[must_use]
    pub fn with_way_back(mut self) -> Self {
        self.can_leave = true;
        self
    }

    /// Whether the experimenter has gone back.
    #[must_use]
    pub fn is_left(&self) -> bool {
        self.is_left
    }

    /// One pass of the interface.
    pub fn ui(&mut self, ui: &mut Ui) {
        theme::install_browser(ui);
        self.keys(ui.ctx());
        if let Ok(opened) = &mut self.opened {
            opened.pair.poll(ui.ctx());
        }
        Panel::top("browser-controls").show(ui, |ui| controls::show(self, ui));
        let opened = match &mut self.opened {
            Ok(opened) => opened,
            Err(detail) => {
                let frame = Frame::central_panel(ui.style());
                CentralPanel::default().frame(frame).show(ui, |ui| {
                    stage::note(ui, detail, false);
                });
                return;
            }
        };
        Panel::left("browser-gallery")
            .resizable(false)
            .exact_size(262.0)
            .show(ui, |ui| {
                let clicked = opened.gallery.show(ui, &opened.folder, opened.selected);
                if let Some(index) = clicked {
                    opened.select(ui.ctx(), index);
                }
            });
        let sheet = &mut self.sheet;
        Panel::right("browser-facts")
            .default_size(340.0)
            .size_range(240.0..=900.0)
            .show(ui, |ui| opened.side(ui, sheet));
        let status = Panel::bottom("browser-status").frame(Frame::side_top_panel(ui.style()));
        let (look, shows_second, gain) = (self.look, self.shows_second, self.gain);
        let stage = &mut self.stage;
        // The stage is drawn last, so the line under it says what it found a pass ago.
        status.show(ui, |ui| ui.weak(self.reading.as_str()));
        let pointed = CentralPanel::no_frame()
            .show(ui, |ui| opened.stage(ui, stage, look, shows_second, gain))
            .inner;
        let reading = opened.reading(pointed, stage);
        if reading != self.reading {
            self.reading = reading;
            ui.ctx().request_repaint();
        }
    }

    /// Every control has a key, so that the eyes can stay on the picture.
    fn keys(&mut self, ctx: &Context) {
        let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Default::default(), key));
        if pressed(Key::Space) {
            self.flip();
        }
        for (key, look) in [(Key::S, Look::Split), (Key::D, Look::Difference)] {
            if pressed(key) {
                self.look = look;
            }
        }
        for (key, second) in [(Key::A, false), (Key::B, true)] {
            if pressed(key) {
                (self.look, self.shows_second) = (Look::Flip, second);
            }
        }
        if pressed(Key::Num0) {
            self.stage.fit();
        }
        if pressed(Key::Num1) {
            self.stage.one_to_one();
        }
        if self.can_leave && pressed(Key::Escape) {
            self.is_left = true;
        }
        if let Ok(opened) = &mut self.opened {
            let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
            let last = opened.folder.manifest.pairs.len().saturating_sub(1);
            if up {
                opened.select(ctx, opened.selected.saturating_sub(1));
            } else if down {
                opened.select(ctx, (opened.selected + 1).min(last));
            }
        }
    }

    /// The other image, in the same place.
    fn flip(&mut self) {
        self.shows_second = !self.shows_second;
        if matches!(self.look, Look::Split | Look::Difference) {
            self.look = Look::Flip;
        }
    }

    fn record(&self) -> Option<&PairRecord> {
        self.opened.as_ref().ok().map(Opened::record)
    }
}
