//! One participant's session in the window: passes input to the state machine,
//! draws what it says, tells it when that was on the display, and stores rows.
//! It knows no rule of the experiment; those are the session's.

mod drawing;

use std::collections::VecDeque;
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, Ui};

use self::drawing::Draft;
use super::clock::Clock;
use super::gamepad;
use super::pace::{Pace, USUAL_PERIOD};
use super::participant::{self, Given, Look, grey};
use super::pictures::Pictures;
use super::present_feedback::Displayed;
use super::stimulus_view::SizePx;
use crate::protocol::{Protocol, Words};
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
}
