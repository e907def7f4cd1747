//! One participant's session in the window: passes input to the state machine,
//! draws what it says, tells it when that was on the display, and stores rows.
//! It knows no rule of the experiment; those are the session's.

use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, Ui};

use super::clock::Clock;
use super::gamepad;
use super::pace::{Pace, USUAL_PERIOD};
use super::participant::{
    self, Given, Look, Page, closing, comparison, consent, form, grey, image, instructions,
    pair_menu, pause, question, ranking, rating, saving, trouble,
};
use super::pictures::Pictures;
use super::present_feedback::Displayed;
use super::stimulus_view::{self, SizePx};
use crate::protocol::{Pause, Protocol, Words};
use crate::record::InputDevice;
use crate::session::{Effect, Event, FrameFigures, FrameMeter, Screen, Session, SessionTime};

/// How long the abort chord must be held: long enough that nobody does it by accident.
const ABORT_HOLD: Duration = Duration::from_secs(1);

/// First frames whose reports may still come.
const REMEMBERED: usize = 16;

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
    /// Serial of the screen in the last pass, if it could be drawn as it should be;
    /// taken when its frame is handed over, so that a frame without a pass (of a
    /// hidden window) counts for nothing.
    painted: Option<u64>,
    /// Counts late frames, where the display's period is known.
    meter: Option<FrameMeter>,
    pace: Pace,
    /// When the last frame was handed over.
    presented_at: Option<SessionTime>,
    /// First frames of screens, by the time they were handed over, and their
    /// screen's serial; the latest few, for what the display system tells of them.
    first_frames: VecDeque<(Instant, u64)>,
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
            meter: None,
            pace: Pace::new(USUAL_PERIOD),
            presented_at: None,
            first_frames: VecDeque::new(),
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

    /// The same on a display with this time from refresh to refresh, as stated or
    /// measured. Without it nobody counts late frames.
    #[must_use]
    pub fn with_refresh_period(mut self, period: Option<Duration>) -> Self {
        let period = period.filter(|period| !period.is_zero());
        self.meter = period
            .and_then(|period| u64::try_from(period.as_nanos()).ok())
            .map(FrameMeter::new);
        self.pace = Pace::new(period.unwrap_or(USUAL_PERIOD));
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
        self.next_frame();
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
        let time = self.clock.at(at);
        self.presented_at = Some(time);
        let painted = self.painted.take();
        if painted.is_some() {
            self.count(time);
        }
        if painted == Some(serial) {
            if self.shown.replace(serial) != Some(serial) {
                tracing::debug!(screen = ?self.session.screen(), at_ns = time.ns, "shown");
                self.first_frames.push_back((at, serial));
                if self.first_frames.len() > REMEMBERED {
                    self.first_frames.pop_front();
                }
            }
            self.send(Event::Shown, time);
        }
        // A timed screen may have ended with this very frame.
        let changed = self.session.screen_serial() != serial;
        if painted.is_some() && (changed || self.is_moving()) {
            // At once, and once: without a delay egui would draw it twice.
            let wait = self.pace.presented(at).max(Duration::from_nanos(1));
            ctx.request_repaint_after(wait);
        } else {
            self.pause();
        }
        // Wakes the window where a screen ends by itself and frames do not do it.
        if let Some(wake) = self.session.wake_at() {
            let left_ns = wake.ns.saturating_sub(self.clock.now().ns);
            ctx.request_repaint_after(Duration::from_nanos(left_ns));
        }
    }

    /// The display system has told when a frame was on the display.
    pub fn displayed(&mut self, frame: Displayed) {
        let first = self
            .first_frames
            .iter()
            .find(|(handed_over, _)| *handed_over == frame.handed_over);
        if let Some(&(_, screen_serial)) = first {
            let event = Event::OnsetKnown {
                screen_serial,
                at: self.clock.at(frame.at),
                uncertainty_ns: u64::try_from(self.pace.period().as_nanos()).unwrap_or(u64::MAX),
            };
            self.send(event, self.clock.now());
        }
    }

    /// What the frames of the session so far were like; `None` where nobody counts.
    #[must_use]
    pub fn frame_figures(&self) -> Option<FrameFigures> {
        self.meter.as_ref().map(FrameMeter::figures)
    }

    /// Grey level behind everything (8-bit sRGB).
    #[must_use]
    pub fn surround(&self) -> u8 {
        grey::surround(&self.protocol.grey)
    }

    /// Frames follow each other without a break while a picture or a timed screen
    /// stands: the next screen is then a frame away at any time, and a frame that
    /// comes late is noticed. Pages of text rest.
    fn is_moving(&self) -> bool {
        matches!(
            self.session.screen(),
            Screen::Image { .. } | Screen::Grey { .. }
        ) || self.session.wake_at().is_some()
    }

    /// Tells the session when the frame of this pass will be handed over: a period
    /// after the one before, or now if it is late.
    fn next_frame(&mut self) {
        let now = self.clock.now();
        let period_ns = u64::try_from(self.pace.period().as_nanos()).unwrap_or(u64::MAX);
        let next = |last: SessionTime| SessionTime {
            ns: last.ns.saturating_add(period_ns),
        };
        let expected = self.presented_at.map_or(now, next).max(now);
        self.send(Event::NextFrame { expected }, now);
    }

    /// Counts a frame that was handed over.
    fn count(&mut self, at: SessionTime) {
        let missed = self.meter.as_mut().and_then(|meter| meter.presented(at));
        if let Some(missed) = missed {
            if missed > 0 {
                tracing::debug!(missed, at_ns = at.ns, "a frame came late");
            }
            self.send(Event::MissedFrames(missed), at);
        }
    }

    fn pause(&mut self) {
        self.pace.pause();
        if let Some(meter) = &mut self.meter {
            meter.pause();
        }
    }

    /// A button of a game-pad went down.
    pub fn pad(&mut self, press: gamepad::Press) {
        if let Some(given) = gamepad::given(press.pad, self.session.screen()) {
            let at = self.clock.at(press.at);
            self.give(given, at);
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
