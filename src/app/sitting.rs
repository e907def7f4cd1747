//! One participant's session in the window: passes input to the state machine,
//! draws what it says, tells it when that was on the display, and stores rows.
//! It knows no rule of the experiment; those are the session's.

use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, Ui};

use super::clock::Clock;
use super::participant::{
    self, Given, Look, Page, closing, comparison, consent, form, grey, image, instructions,
    pair_menu, pause, question, ranking, rating, saving, trouble,
};
use super::pictures::Pictures;
use super::stimulus_view::{self, SizePx};
use crate::protocol::{Pause, Protocol, Words};
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
    words: Rc<Words>,
    look: Look,
    clock: Clock,
    store: Store,
    pictures: Pictures,
    image_px: SizePx,
    /// What is being filled in on the current screen.
    draft: Draft,
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

/// What is chosen or typed on the screen that stands, before it is an answer.
#[derive(Debug, Default)]
struct Draft {
    form: form::Draft,
    rating: rating::Draft,
    ranking: ranking::Draft,
    /// Serial of the screen it belongs to.
    screen: u64,
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
            words: Rc::new(protocol.words(session.language())),
            look: Look {
                level: protocol.grey.level_srgb.get(),
                text_scale: 1.0,
                high_contrast: false,
            },
            draft: Draft::default(),
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

    /// The same with larger type or stronger contrast on the pages of text.
    #[must_use]
    pub fn with_type(mut self, text_scale: f32, high_contrast: bool) -> Self {
        self.look.text_scale = text_scale;
        self.look.high_contrast = high_contrast;
        self
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
        grey::surround(&self.protocol.grey)
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

    fn keys(&mut self, ctx: &Context) -> Option<Given> {
        let protocol = Rc::clone(&self.protocol);
        let (keys, cannot_tell) = (&protocol.keys, protocol.cannot_tell);
        self.fresh_draft();
        match *self.session.screen() {
            Screen::Image { .. } => ctx.input(|input| image::input(input, keys)),
            Screen::Question { .. } | Screen::Comparison { .. } => {
                ctx.input(|input| question::input(input, keys, cannot_tell))
            }
            Screen::Rating { .. } => {
                let draft = &mut self.draft.rating;
                ctx.input(|input| rating::input(input, keys.go_on, &protocol.scales, draft))
            }
            Screen::Ranking { trial } => {
                let count = self.session.plan().trials[trial].places.len();
                let draft = &mut self.draft.ranking;
                ctx.input(|input| ranking::input(input, keys.go_on, count, draft))
            }
            _ => None,
        }
    }

    /// A screen begins with nothing filled in.
    fn fresh_draft(&mut self) {
        let serial = self.session.screen_serial();
        if self.draft.screen != serial {
            self.draft = Draft {
                screen: serial,
                ..Draft::default()
            };
        }
    }

    /// Decodes the next trial's images while a page stands before it.
    fn prepare_pictures(&mut self, ctx: &Context) {
        match *self.session.screen() {
            Screen::Instructions
            | Screen::Pause(_)
            | Screen::PairMenu { .. }
            | Screen::Ready { .. }
            | Screen::Grey { .. } => {
                let next = self.session.stored();
                if next < self.session.plan().trials.len() {
                    self.pictures.prepare(ctx, next);
                }
            }
            Screen::Closing | Screen::Declined | Screen::Aborted => self.pictures.release(),
            _ => {}
        }
    }

    fn draw(&mut self, ui: &mut Ui) -> Option<Given> {
        self.fresh_draft();
        let (protocol, words) = (Rc::clone(&self.protocol), Rc::clone(&self.words));
        let page = Page {
            look: self.look,
            words: &words,
        };
        let cannot_tell = protocol.cannot_tell;
        match self.session.screen().clone() {
            Screen::Consent => consent::show(ui, page),
            Screen::Form => form::show(ui, page, &protocol.metadata, &mut self.draft.form),
            Screen::Instructions => instructions::show(ui, page),
            Screen::Pause(which) => {
                let text = match which {
                    Pause::PracticeOver => &words.practice_over,
                    Pause::Break => &words.pause,
                };
                pause::show(ui, page, text, Event::Begin)
            }
            Screen::PairMenu { next, total } => pair_menu::show(ui, page, next, total),
            Screen::Ready { next, total } => pause::show(
                ui,
                page,
                &words.ready_for(next, total),
                Event::StartPair(next),
            ),
            Screen::Question { .. } => question::show(ui, page, &protocol.keys, cannot_tell),
            Screen::Rating { .. } => {
                rating::show(ui, page, &protocol.scales, &mut self.draft.rating)
            }
            Screen::Saving => {
                saving::show(ui, page);
                None
            }
            Screen::StorageTrouble { detail } => {
                trouble::show(ui, page, &detail).then_some((Event::RetryStore, InputDevice::Mouse))
            }
            Screen::Closing => self.last_page(ui, page, &words.closing),
            Screen::Declined => self.last_page(ui, page, &words.declined),
            Screen::Aborted => self.last_page(ui, page, &words.aborted),
            Screen::Image { .. }
            | Screen::Grey { .. }
            | Screen::Comparison { .. }
            | Screen::Ranking { .. } => self.draw_stimulus_or_trouble(ui, page),
        }
    }

    fn last_page(&mut self, ui: &mut Ui, page: Page<'_>, text: &str) -> Option<Given> {
        self.left |= closing::show(ui, page, text);
        None
    }

    fn draw_stimulus_or_trouble(&mut self, ui: &mut Ui, page: Page<'_>) -> Option<Given> {
        match self.draw_stimulus(ui, page) {
            Ok(given) => given,
            Err(detail) => {
                if trouble::show(ui, page, &detail) {
                    self.pictures.retry(ui.ctx());
                    ui.ctx().request_repaint();
                }
                self.obstacle = Some(detail);
                None
            }
        }
    }

    /// Draws images or the grey; the error is for the experimenter.
    fn draw_stimulus(&mut self, ui: &mut Ui, page: Page<'_>) -> Result<Option<Given>, String> {
        let (ctx, surround) = (ui.ctx().clone(), self.surround());
        match *self.session.screen() {
            Screen::Image { trial, place } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let texture = textures.get(place).ok_or("the trial has no such image")?;
                image::show(&ctx, texture, surround).map_err(|error| error.to_string())?;
                Ok(None)
            }
            Screen::Comparison { trial } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let [left, right, reference] = textures else {
                    return Err("the trial needs two images and a reference".to_owned());
                };
                let surface = stimulus_view::surface_px(&ctx);
                let scale = ctx.pixels_per_point();
                let arranged = comparison::arrange(surface, self.image_px, scale)
                    .map_err(|error| error.to_string())?;
                let pictures: Vec<_> = [left, reference, right]
                    .into_iter()
                    .zip(arranged.corners.iter().copied())
                    .collect();
                stimulus_view::paint_pictures(&ctx, &pictures, page.look.level);
                let keys = self.protocol.keys;
                let cannot_tell = self.protocol.cannot_tell;
                Ok(comparison::show(ui, page, &keys, cannot_tell, &arranged))
            }
            Screen::Ranking { trial } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let surface = stimulus_view::surface_px(&ctx);
                let scale = ctx.pixels_per_point();
                let arranged = ranking::arrange(surface, self.image_px, textures.len(), scale)
                    .map_err(|error| error.to_string())?;
                let corners = arranged.corners.iter().copied();
                let pictures: Vec<_> = textures.iter().zip(corners).collect();
                stimulus_view::paint_pictures(&ctx, &pictures, page.look.level);
                Ok(ranking::show(ui, page, &arranged, &mut self.draft.ranking))
            }
            _ => {
                let level = self.look.level;
                grey::show(&ctx, self.image_px, level, surround)
                    .map_err(|error| error.to_string())?;
                Ok(None)
            }
        }
    }
}
