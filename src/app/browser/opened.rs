//! A folder that could be opened, and what is selected in it.

use eframe::egui::{Context, ScrollArea, TextureHandle, Ui};

use super::Look;
use super::buffers;
use super::facts::{self, Sheet};
use super::folder::Folder;
use super::gallery::Gallery;
use super::pair::Pair;
use crate::app::background::Task;
use crate::app::stage::{self, Content, Stage};
use crate::render::Buffer;
use crate::stimulus::manifest::{PairRecord, Picture};
use crate::stimulus::set::{ImageSource, RenderedPair};

/// A folder that could be opened.
pub(super) struct Opened {
    pub folder: Folder,
    pub selected: usize,
    pub gallery: Gallery,
    pub pair: Pair,
    plans: Option<Task<String>>,
    /// Of the first and of the second image.
    buffers: [Option<Buffers>; 2],
}

/// The targets of one image, on their way or there.
struct Buffers {
    task: Task<Vec<(Buffer, Picture)>>,
    textures: Vec<(Buffer, TextureHandle)>,
}

impl Opened {
    pub fn new(ctx: &Context, folder: Folder) -> Result<Self, String> {
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
            buffers: [None, None],
            selected: 0,
            folder,
        })
    }

    pub fn record(&self) -> &PairRecord {
        // `selected` is only ever set to a pair there is.
        &self.folder.manifest.pairs[self.selected]
    }

    pub fn select(&mut self, ctx: &Context, index: usize) {
        let Some(record) = self.folder.pair(index).cloned() else {
            return;
        };
        if index == self.selected {
            return;
        }
        self.selected = index;
        self.pair = Pair::load(ctx, self.folder.path.clone(), record);
        self.plans = None;
        self.buffers = [None, None];
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

    pub fn side(&mut self, ui: &mut Ui, sheet: &mut Sheet) {
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
        if let Some(buffers) = &mut self.buffers[usize::from(shows_second)] {
            if buffers.task.poll()
                && let Task::Done(pictures) = &buffers.task
            {
                let upload = |(buffer, picture): &(Buffer, Picture)| {
                    (*buffer, stage::upload(ctx, buffer.name(), picture))
                };
                buffers.textures = pictures.iter().map(upload).collect();
            }
            return;
        }
        let (Some(set), Some(pair)) = (self.folder.set.clone(), self.rendered().cloned()) else {
            return;
        };
        self.buffers[usize::from(shows_second)] = Some(Buffers {
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
    pub fn stage(
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
        let Some(buffers) = &self.buffers[usize::from(shows_second)] else {
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
                    "There is no {} buffer: no pass of this frame writes it.",
                    buffer.name()
                );
                stage::note(ui, &text, false);
            }
        }
        None
    }

    /// The line under the stage: the pixel under the pointer in both images.
    pub fn reading(&self, pointed: Option<(u32, u32)>, stage: &Stage) -> String {
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
