//! The cost panel, for the experimenter: a technique's settings as sliders, and beside them what
//! it draws, what that takes, how wrong it is and what of it can be seen. Two settings can be
//! pinned, compared, and made a stimulus pair of.
//!
//! ```text
//! tuning   what it is opened on          knobs      the settings as the controls hold them
//! worker   what takes time, on a thread  queue      what waits for it, the newest of each kind
//! result   what comes of it              bench      what was asked and what has come
//! controls the side panel                looks      the row over the stage
//! numbers  the table below the stage     pictures   results as textures, and what colours mean
//! pair_file  a stimulus set of two pins
//! ```

mod bench;
mod controls;
mod knobs;
mod looks;
mod numbers;
mod pair_file;
mod pictures;
mod queue;
mod result;
mod tuning;
mod worker;

use eframe::egui::{CentralPanel, Context, Frame, Key, Panel, ProgressBar, Ui};

use self::bench::Bench;
pub use self::knobs::Knobs;
use self::pair_file::{PairFile, blur_trouble};
use self::pictures::Pictures;
pub use self::result::{Look, Numbers, Request, Shown, Slot};
pub use self::tuning::{Tuning, Wishes};
use super::stage::{self, Content, Stage};
use super::theme;
use crate::cost::Configuration;

/// Whose pictures are on the stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// One measurement's.
    Of(Slot),
    /// A left of a divider, B right of it.
    Split,
}

/// The cost panel.
pub struct Tuner {
    tuning: Tuning,
    /// `None` where the scene asks for what a technique does not take; the trouble says what.
    knobs: Option<Knobs>,
    bench: Bench,
    look: Look,
    side: Side,
    stage: Stage,
    pictures: Pictures,
    pair: PairForm,
    /// Why the last change of a control was refused.
    refusal: Option<String>,
    /// The line under the stage.
    reading: String,
}

/// What becomes of the two pins.
struct PairForm {
    file: String,
    /// Where the set was written, or why it was not.
    outcome: Option<String>,
}

impl Tuner {
    /// Opens the panel; the scene is read and traced beside the interface.
    #[must_use]
    pub fn new(ctx: &Context, tuning: Tuning) -> Self {
        theme::install_browser_everywhere(ctx);
        let mut bench = Bench::start(ctx, &tuning);
        let knobs = Knobs::new(&tuning.scene, &tuning.lighting, tuning.reach_m);
        let knobs = match knobs {
            Ok(knobs) => Some(knobs),
            Err(error) => {
                bench.trouble = Some(error.to_string());
                None
            }
        };
        let mut tuner = Self {
            pair: PairForm {
                file: pair_file::default_name(&tuning),
                outcome: None,
            },
            knobs,
            bench,
            look: Look::Image,
            side: Side::Of(Slot::Now),
            stage: Stage::default(),
            pictures: Pictures::default(),
            refusal: None,
            reading: String::from(" "),
            tuning,
        };
        tuner.measure();
        tuner
    }

    /// What was measured, if it was.
    #[must_use]
    pub fn shown(&self, slot: Slot) -> Option<&Shown> {
        self.bench.shown(slot)
    }

    /// Whether something was asked for that has not come.
    #[must_use]
    pub fn is_measuring(&self) -> bool {
        Slot::ALL
            .into_iter()
            .any(|slot| self.bench.is_waiting(slot))
    }

    /// One pass of the interface.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.keys(ui.ctx());
        self.bench.poll();
        Panel::top("tuner-looks").show(ui, |ui| looks::show(self, ui));
        Panel::left("tuner-controls")
            .default_size(372.0)
            .size_range(300.0..=560.0)
            .show(ui, |ui| controls::show(self, ui));
        let frame = Frame::side_top_panel(ui.style());
        Panel::bottom("tuner-numbers")
            .frame(frame)
            .show(ui, |ui| numbers::show(self, ui));
        // The stage is drawn last, so the line under it says what it found a pass ago.
        Panel::bottom("tuner-reading").frame(frame).show(ui, |ui| {
            ui.horizontal(|ui| {
                pictures::scale(ui, self.look);
                ui.weak(self.reading.as_str());
            });
        });
        let pointed = CentralPanel::no_frame()
            .show(ui, |ui| self.middle(ui))
            .inner;
        let reading = self.reading_of(pointed);
        if reading != self.reading {
            self.reading = reading;
            ui.ctx().request_repaint();
        }
    }

    /// Every look has a key, so that the eyes can stay on the picture.
    fn keys(&mut self, ctx: &Context) {
        // Letters belong to the file name while it is written.
        if ctx.text_edit_focused() {
            return;
        }
        let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Default::default(), key));
        let keys = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5];
        for (key, (look, _)) in keys.into_iter().zip(Look::ALL) {
            if pressed(key) {
                self.look = look;
            }
        }
        for (key, side) in [
            (Key::N, Side::Of(Slot::Now)),
            (Key::A, Side::Of(Slot::A)),
            (Key::B, Side::Of(Slot::B)),
            (Key::S, Side::Split),
        ] {
            if pressed(key) && self.can_show(side) {
                self.side = side;
            }
        }
        if pressed(Key::Num0) {
            self.stage.fit();
        }
    }

    /// Whether there is something to show.
    fn can_show(&self, side: Side) -> bool {
        let is_pinned = |slot| self.bench.request(slot).is_some();
        match side {
            Side::Of(slot) => is_pinned(slot),
            Side::Split => is_pinned(Slot::A) && is_pinned(Slot::B),
        }
    }

    /// Asks for what the controls say now.
    fn measure(&mut self) {
        if let Some(knobs) = &self.knobs {
            self.bench
                .ask(Slot::Now, knobs.configuration(), &knobs.lighting);
        }
    }

    /// Under another light, or against another truth, everything is measured anew: only so can
    /// it be compared.
    fn measure_all(&mut self) {
        self.measure();
        if let Some(knobs) = &self.knobs {
            self.bench.ask_again([Slot::A, Slot::B], &knobs.lighting);
        }
    }

    /// Keeps what the controls say.
    fn pin(&mut self, slot: Slot) {
        self.pair.outcome = None;
        self.bench.pin(slot);
    }

    /// Both pins, measured or not.
    fn pinned(&self) -> Option<[&Configuration; 2]> {
        let of = |slot| {
            self.bench
                .request(slot)
                .map(|request| &request.configuration)
        };
        Some([of(Slot::A)?, of(Slot::B)?])
    }

    /// Why the pins cannot be made a pair of as they are blurred, if so.
    fn blur_trouble(&self) -> Option<String> {
        blur_trouble(&self.tuning, self.pinned()?)
    }

    /// Pins both again with the scene's blur, which a pair has.
    fn blur_as_the_scene(&mut self) {
        self.pair.outcome = None;
        let Some(lighting) = self.knobs.as_ref().map(|knobs| knobs.lighting.clone()) else {
            return;
        };
        for slot in [Slot::A, Slot::B] {
            let Some(request) = self.bench.request(slot) else {
                continue;
            };
            let mut configuration = request.configuration.clone();
            if configuration.settings.technique.shader.is_some() {
                configuration.blur_radius_px = self.tuning.scene.occlusion.blur_radius_px;
            }
            self.bench.ask(slot, configuration, &lighting);
        }
    }

    fn write_pair(&mut self) {
        let (Some(pinned), Some(knobs)) = (self.pinned(), &self.knobs) else {
            return;
        };
        let pair = PairFile {
            tuning: &self.tuning,
            lighting: &knobs.lighting,
            pinned,
        };
        self.pair.outcome = Some(match pair.write(&self.pair.file) {
            Ok(path) => {
                let path = path.display();
                format!("Written: {path}. Draw it with greyfield render {path}")
            }
            Err(detail) => detail,
        });
    }

    /// The stage; gives the pixel under the pointer.
    fn middle(&mut self, ui: &mut Ui) -> Option<(u32, u32)> {
        let first = match self.side {
            Side::Of(slot) => slot,
            Side::Split => Slot::A,
        };
        let Some(shown) = self.bench.shown(first) else {
            self.waiting(ui);
            return None;
        };
        let left = self.pictures.texture(ui.ctx(), shown, self.look);
        let right = match (self.side, self.bench.shown(Slot::B)) {
            (Side::Split, Some(shown)) => Some(self.pictures.texture(ui.ctx(), shown, self.look)),
            (Side::Split, None) => {
                self.waiting(ui);
                return None;
            }
            (Side::Of(_), _) => None,
        };
        let content = match &right {
            Some(right) => Content::Split(&left, right),
            None => Content::One(&left),
        };
        self.stage.show(ui, &content)
    }

    /// What the stage says while there is no picture.
    fn waiting(&self, ui: &mut Ui) {
        if let Some(detail) = &self.bench.trouble {
            stage::note(ui, detail, false);
            return;
        }
        match &self.bench.progress {
            Some((what, Some(share))) => stage::with_note(ui, |ui| {
                ui.label(format!("{what} …"));
                ui.add(percent(*share).desired_width(360.0));
            }),
            Some((what, None)) => stage::note(ui, &format!("{what} …"), true),
            None => stage::note(ui, "measuring …", true),
        }
    }

    /// The line under the stage: the pixel under the pointer.
    fn reading_of(&self, pointed: Option<(u32, u32)>) -> String {
        let zoom = self.stage.view.map_or(1.0, |view| view.zoom);
        let mut text = format!("{:.0} %", 100.0 * zoom);
        let Some(at @ (x, y)) = pointed else {
            return text;
        };
        text += &format!("   column {x}, row {y}");
        let slots: &[Slot] = match self.side {
            Side::Of(Slot::Now) => &[Slot::Now],
            Side::Of(Slot::A) => &[Slot::A],
            Side::Of(Slot::B) => &[Slot::B],
            Side::Split => &[Slot::A, Slot::B],
        };
        for (index, slot) in slots.iter().enumerate() {
            let Some(pixel) = self.bench.shown(*slot).and_then(|shown| shown.at(at)) else {
                continue;
            };
            if index == 0 {
                text += &format!("   true occlusion {:.3}", pixel.truth);
            }
            text += &format!(
                "   {}: {:.3} ({:+.3}), FLIP {:.3}",
                slot.name(),
                pixel.occlusion,
                pixel.occlusion - pixel.truth,
                pixel.flip
            );
        }
        text
    }
}

/// A bar that says how much is done.
fn percent(share: f32) -> ProgressBar {
    ProgressBar::new(share).text(format!("{:.0} %", 100.0 * share))
}
