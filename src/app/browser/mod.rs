//! The stimulus browser, for the experimenter: every pair of a set, side by side, one over the
//! other, their difference, what they are made of and where they came from.
//!
//! No session leads here, so that no participant ever sees which technique made an image.
//!
//! ```text
//! folder   what is looked at         gallery  the list of conditions
//! pair     two pictures, compared    stage    the middle: zoom, pan, divider
//! view     the arithmetic of zoom    facts    the side panel
//! buffers  a frame's targets         background  work beside the interface
//! ```

mod background;
pub mod buffers;
mod controls;
mod facts;
mod folder;
mod gallery;
mod pair;
mod stage;
pub mod view;

use std::path::Path;

use eframe::egui::{CentralPanel, Context, Frame, Key, Panel, ScrollArea, TextureHandle, Ui};

use self::background::Task;
use self::buffers::Buffer;
use self::facts::Sheet;
pub use self::folder::Folder;
use self::gallery::Gallery;
use self::pair::Pair;
use self::stage::{Content, Stage};
use super::theme;
use crate::stimulus::manifest::{PairRecord, Picture};
use crate::stimulus::set::{ImageSource, RenderedPair};

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

/// A folder that could be opened.
struct Opened {
    folder: Folder,
    selected: usize,
    gallery: Gallery,
    pair: Pair,
    plans: Option<Task<String>>,
    buffers: Option<Buffers>,
}

/// The targets of one image, on their way or there.
struct Buffers {
    shows_second: bool,
    task: Task<Vec<(Buffer, Picture)>>,
    textures: Vec<(Buffer, TextureHandle)>,
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

impl Opened {
    fn new(ctx: &Context, folder: Folder) -> Result<Self, String> {
        let Some(record) = folder.pair(0).cloned() else {
            return Err(format!(
                "{}: there are no images here",
                folder.path.display()
            ));
        };
        Ok(Self {
            gallery: Gallery::load(ctx, &folder),
            pair: Pair::load(ctx, folder.path.clone(), record),
            plans: None,
            buffers: None,
            selected: 0,
            folder,
        })
    }

    fn record(&self) -> &PairRecord {
        // `selected` is only ever set to a pair there is.
        &self.folder.manifest.pairs[self.selected]
    }

    fn select(&mut self, ctx: &Context, index: usize) {
        let Some(record) = self.folder.pair(index).cloned() else {
            return;
        };
        if index == self.selected {
            return;
        }
        self.selected = index;
        self.pair = Pair::load(ctx, self.folder.path.clone(), record);
        self.plans = None;
        self.buffers = None;
    }

    /// What the selected pair is rendered from, where that is known.
    fn rendered(&self) -> Option<&RenderedPair> {
        let set = self.folder.set.as_ref()?;
        let id = &self.record().condition;
        let condition = set.conditions.iter().find(|c| c.id == *id)?;
        match &condition.images {
            ImageSource::Rendered(pair) => Some(pair),
            ImageSource::Loaded(_) => None,
        }
    }

    /// Why nothing can be drawn again.
    fn why_not_rendered(&self) -> &str {
        match &self.folder.note {
            Some(note) => note,
            None => "These images were made elsewhere: nothing is rendered.",
        }
    }

    fn side(&mut self, ui: &mut Ui, sheet: &mut Sheet) {
        ui.horizontal(|ui| {
            for (this, name) in Sheet::ALL {
                ui.selectable_value(sheet, this, name);
            }
        });
        ui.separator();
        if *sheet == Sheet::Plan {
            self.start_plans(ui.ctx());
        }
        ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| match sheet {
                Sheet::Pair => facts::pair(ui, self.record(), self.pair.loaded()),
                Sheet::Provenance => facts::provenance(ui, &self.folder, self.record()),
                Sheet::Plan => facts::plan(
                    ui,
                    self.record(),
                    self.plans.as_ref(),
                    Some(self.why_not_rendered()),
                ),
            });
    }

    fn start_plans(&mut self, ctx: &Context) {
        if let Some(plans) = &mut self.plans {
            plans.poll();
            return;
        }
        let (Some(set), Some(pair)) = (self.folder.set.clone(), self.rendered().cloned()) else {
            return;
        };
        let record = self.record().clone();
        self.plans = Some(Task::start(ctx, move || {
            buffers::plans(&set, &pair, &record)
        }));
    }

    fn start_buffers(&mut self, ctx: &Context, shows_second: bool) {
        if let Some(buffers) = &mut self.buffers
            && buffers.shows_second == shows_second
        {
            if buffers.task.poll()
                && let Task::Done(pictures) = &buffers.task
            {
                let upload = |(buffer, picture): &(Buffer, Picture)| {
                    (*buffer, pair::upload(ctx, buffer.name(), picture))
                };
                buffers.textures = pictures.iter().map(upload).collect();
            }
            return;
        }
        let (Some(set), Some(pair)) = (self.folder.set.clone(), self.rendered().cloned()) else {
            return;
        };
        self.buffers = Some(Buffers {
            shows_second,
            task: Task::start(ctx, move || {
                let technique = if shows_second {
                    &pair.second
                } else {
                    &pair.first
                };
                buffers::redraw(&set, &pair, technique)
            }),
            textures: Vec::new(),
        });
    }

    /// Draws the middle; gives the image pixel under the pointer.
    fn stage(
        &mut self,
        ui: &mut Ui,
        stage: &mut Stage,
        look: Look,
        shows_second: bool,
        gain: u32,
    ) -> Option<(u32, u32)> {
        if let Task::Failed(detail) = self.pair.poll(ui.ctx()) {
            stage::note(ui, &format!("This pair cannot be shown. {detail}"), false);
            return None;
        }
        if let Look::Buffer(buffer) = look {
            return self.buffer(ui, stage, buffer, shows_second);
        }
        if look == Look::Difference {
            let Some(texture) = self.pair.difference(ui.ctx(), gain) else {
                stage::note(ui, "There is no difference to show.", false);
                return None;
            };
            return stage.show(ui, &Content::One(texture));
        }
        let Some([first, second]) = self.pair.textures() else {
            stage::note(ui, "Reading the images …", true);
            return None;
        };
        let content = match look {
            Look::Split => Content::Split(first, second),
            _ if shows_second => Content::One(second),
            _ => Content::One(first),
        };
        stage.show(ui, &content)
    }

    fn buffer(
        &mut self,
        ui: &mut Ui,
        stage: &mut Stage,
        buffer: Buffer,
        shows_second: bool,
    ) -> Option<(u32, u32)> {
        self.start_buffers(ui.ctx(), shows_second);
        let Some(buffers) = &self.buffers else {
            stage::note(ui, self.why_not_rendered(), false);
            return None;
        };
        match &buffers.task {
            Task::Running(_) => stage::note(ui, "Drawing the image again …", true),
            Task::Failed(detail) => stage::note(ui, detail, false),
            Task::Done(_) => {
                let found = buffers.textures.iter().find(|(this, _)| *this == buffer);
                if let Some((_, texture)) = found {
                    return stage.show(ui, &Content::One(texture));
                }
                let text = format!(
                    "There is no {} buffer: no pass of this frame writes one that can be read.",
                    buffer.name().to_lowercase()
                );
                stage::note(ui, &text, false);
            }
        }
        None
    }

    /// The line under the stage: the pixel under the pointer in both images.
    fn reading(&self, pointed: Option<(u32, u32)>, stage: &Stage) -> String {
        let zoom = stage.view.map_or(1.0, |view| view.zoom);
        let mut text = format!("{:.0} %", 100.0 * zoom);
        if let (Some((x, y)), Some(loaded)) = (pointed, self.pair.loaded()) {
            let colour = |picture: &Picture| {
                let at = 4 * (y as usize * picture.width_px as usize + x as usize);
                picture.rgba8.get(at..at + 3).map(|c| format!("{c:?}"))
            };
            let [first, second] = loaded.pictures.each_ref().map(colour);
            if let (Some(first), Some(second)) = (first, second) {
                text += &format!("   column {x}, row {y}   A {first}   B {second}");
            }
        }
        text
    }
}
