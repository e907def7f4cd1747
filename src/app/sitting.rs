//! One participant's session in the window: passes input to the state machine,
//! draws what it says, tells it when that was on the display, and stores rows.
//! It knows no rule of the experiment; those are the session's.

use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, Ui};

use super::clock::Clock;
use super::participant::{
    self, Given, closing, grey, image, instructions, pair_menu, question, saving, trouble,
};
use super::pictures::Pictures;
use super::stimulus_view::SizePx;
use crate::protocol::Protocol;
use crate::protocol::config::GreyArea;
use crate::record::InputDevice;
use crate::session::{Effect, Event, Screen, Session, SessionTime};

/// How long the abort chord must be held: long enough that nobody does it by accident.
const ABORT_HOLD: Duration = Duration::from_secs(1);

/// Does what an effect asks and says how it went.
pub type Store = Box<dyn FnMut(&Effect) -> Event>;

/// A session on the screen.
pub struct Sitting {
    session: Session,
    protocol: Rc<Protocol>,
    clock: Clock,
    store: Store,
    pictures: Pictures,
    image_px: SizePx,
    /// When the earliest key or button of the next pass went down.
    pressed_at: Option<Instant>,
    /// When the abort chord went down, while it is held.
    chord_since: Option<SessionTime>,
    /// Serial of the screen in the last pass, if it could be drawn as it should be.
    painted: Option<u64>,
    /// Serial of the last screen reported as shown.
    shown: Option<u64>,
    /// What keeps the current screen from being drawn, for the experimenter.
    obstacle: Option<String>,
    /// The experimenter has left the last screen.
    left: bool,
}

impl Sitting {
    /// Puts a session on the screen; `clock` started with it.
    #[must_use]
    pub fn new(
        session: Session,
        protocol: Rc<Protocol>,
        clock: Clock,
        store: Store,
        pictures: Pictures,
        image_px: SizePx,
    ) -> Self {
        Self {
            session,
            protocol,
            clock,
            store,
            pictures,
            image_px,
            pressed_at: None,
            chord_since: None,
            painted: None,
            shown: None,
            obstacle: None,
            left: false,
        }
    }

    /// The session.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// True once the experimenter has left the last screen.
    #[must_use]
    pub fn is_left(&self) -> bool {
        self.left
    }

    /// A key or a pointer button went down.
    pub fn pressed(&mut self, at: Instant) {
        self.pressed_at.get_or_insert(at);
    }

    /// One pass: input first, so that a key's screen follows in this very frame;
    /// then the drawing.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let received = self
            .pressed_at
            .take()
            .map_or_else(|| self.clock.now(), |at| self.clock.at(at));
        self.focus(&ctx);
        self.abort_chord(&ctx);
        if let Some(given) = self.keys(&ctx) {
            self.give(given, received);
        }
        self.send(Event::Tick, self.clock.now());
        self.prepare_pictures(&ctx);

        let serial = self.session.screen_serial();
        self.obstacle = None;
        let given = self.draw(ui);
        self.painted = self.obstacle.is_none().then_some(serial);
        if let Some(given) = given {
            self.give(given, received);
        }
        if self.session.screen_serial() != serial {
            // At once, and once: without a delay egui would draw it twice.
            ctx.request_repaint_after(Duration::from_nanos(1));
        }
    }

    /// The last pass was handed to the display; the call returned at `at`.
    pub fn presented(&mut self, ctx: &Context, at: Instant) {
        let serial = self.session.screen_serial();
        if self.painted == Some(serial) && self.shown != Some(serial) {
            self.shown = Some(serial);
            let at = self.clock.at(at);
            self.send(Event::Shown, at);
            tracing::debug!(screen = ?self.session.screen(), at_ns = at.ns, "shown");
        }
        // Nothing else wakes the window while a screen stands.
        if let Some(wake) = self.session.wake_at() {
            let left_ns = wake.ns.saturating_sub(self.clock.now().ns);
            ctx.request_repaint_after(Duration::from_nanos(left_ns));
        }
    }

    /// Grey level behind everything (8-bit sRGB).
    #[must_use]
    pub fn surround(&self) -> u8 {
        let grey = &self.protocol.grey;
        match grey.area {
            GreyArea::Screen => grey.level_srgb.get(),
            // Black, as a display is where it shows nothing.
            GreyArea::Image => 0,
        }
    }

    fn give(&mut self, (event, device): Given, at: SessionTime) {
        self.send(Event::UsedDevice(device), at);
        self.send(event, at);
    }

    fn send(&mut self, event: Event, at: SessionTime) {
        let mut queue = VecDeque::from([(event, at)]);
        while let Some((event, at)) = queue.pop_front() {
            for effect in self.session.handle(event, at) {
                let outcome = (self.store)(&effect);
                if let Event::StoreFailed(detail) = &outcome {
                    tracing::error!(detail, "an answer could not be stored");
                }
                queue.push_back((outcome, self.clock.now()));
            }
        }
    }

    fn focus(&mut self, ctx: &Context) {
        let changes: Vec<bool> = ctx.input(|input| {
            let focused = |event: &egui::Event| match event {
                egui::Event::WindowFocused(focused) => Some(*focused),
                _ => None,
            };
            input.events.iter().filter_map(focused).collect()
        });
        for focused in changes {
            let event = if focused {
                Event::FocusGained
            } else {
                Event::FocusLost
            };
            self.send(event, self.clock.now());
        }
    }

    /// Ends the session once the experimenter's chord was held long enough.
    fn abort_chord(&mut self, ctx: &Context) {
        let key = participant::egui_key(self.protocol.keys.abort_with_ctrl_shift);
        let held = ctx.input(|input| {
            input.modifiers.ctrl
                && input.modifiers.shift
                && key.is_some_and(|key| input.key_down(key))
        });
        if !held || self.session.is_over() {
            self.chord_since = None;
            return;
        }
        let now = self.clock.now();
        let since = *self.chord_since.get_or_insert(now);
        let held_for = Duration::from_nanos(now.ns.saturating_sub(since.ns));
        if held_for >= ABORT_HOLD {
            tracing::info!("the experimenter ended the session");
            self.send(Event::Abort, now);
        } else {
            ctx.request_repaint_after(ABORT_HOLD - held_for);
        }
    }

    fn keys(&self, ctx: &Context) -> Option<Given> {
        let keys = &self.protocol.keys;
        match self.session.screen() {
            Screen::Image { .. } => ctx.input(|input| image::input(input, keys)),
            Screen::Question { .. } => ctx.input(|input| question::input(input, keys)),
            _ => None,
        }
    }

    /// Decodes the next trial's images while a page of text stands.
    fn prepare_pictures(&mut self, ctx: &Context) {
        match *self.session.screen() {
            Screen::Instructions if self.session.stored() < self.session.plan().trials.len() => {
                self.pictures.prepare(ctx, self.session.stored());
            }
            Screen::PairMenu { next, .. } => self.pictures.prepare(ctx, next),
            Screen::Closing | Screen::Aborted => self.pictures.release(),
            _ => {}
        }
    }

    fn draw(&mut self, ui: &mut Ui) -> Option<Given> {
        let protocol = Rc::clone(&self.protocol);
        let (texts, level) = (&protocol.texts, protocol.grey.level_srgb.get());
        match self.session.screen().clone() {
            Screen::Instructions => instructions::show(ui, level, texts),
            Screen::PairMenu { next, total } => pair_menu::show(ui, level, texts, next, total),
            Screen::Image { .. } | Screen::Grey { .. } => {
                if let Err(detail) = self.draw_stimulus(ui.ctx()) {
                    if trouble::show(ui, level, texts, &detail) {
                        self.pictures.retry(ui.ctx());
                        ui.ctx().request_repaint();
                    }
                    self.obstacle = Some(detail);
                }
                None
            }
            Screen::Question { .. } => question::show(ui, level, texts, &protocol.keys),
            Screen::Saving { .. } => {
                saving::show(ui, level, texts);
                None
            }
            Screen::StorageTrouble { detail, .. } => trouble::show(ui, level, texts, &detail)
                .then_some((Event::RetryStore, InputDevice::Mouse)),
            Screen::Closing => {
                self.left |= closing::show(ui, level, &texts.closing);
                None
            }
            Screen::Aborted => {
                self.left |= closing::show(ui, level, &texts.aborted);
                None
            }
        }
    }

    /// Draws an image or the grey; the error is for the experimenter.
    fn draw_stimulus(&mut self, ctx: &Context) -> Result<(), String> {
        let surround = self.surround();
        let drawn = match *self.session.screen() {
            Screen::Image { trial, position } => {
                let texture = self.pictures.texture(ctx, trial, position)?;
                image::show(ctx, texture, surround)
            }
            _ => {
                let level = self.protocol.grey.level_srgb.get();
                grey::show(ctx, self.image_px, level, surround)
            }
        };
        drawn.map_err(|error| error.to_string())
    }
}
