//! A second of grey before a session: does the display keep time, does the window
//! cover it, would keys arrive?
//!
//! The application drives a [`DisplayCheck`] like a page: [`DisplayCheck::ui`] in
//! every pass, [`DisplayCheck::presented`] after it, until
//! [`DisplayCheck::finished`] gives figures and verdict.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, Ui, ViewportCommand};
use winit::window::Window;

use super::display::DisplayFacts;
use super::full_screen::FullScreen;
use super::pace::{Pace, USUAL_PERIOD};
use super::present_feedback::PresentFeedback;
use super::{AppError, START_PAGE, check_display, stimulus_view, theme, window};
use crate::protocol::DisplayRequirements;
use crate::session::display_gate::{FrameTimes, judge};
use crate::session::{DisplayFigures, FrameMeter, SessionTime, Verdict};

/// Grey before anything is counted: the first frames make shaders and textures.
const WARM_UP: Duration = Duration::from_millis(300);

/// After this, what was measured has to do.
const PATIENCE: Duration = Duration::from_secs(15);

/// The check, while it runs.
#[derive(Debug)]
pub struct DisplayCheck {
    asked: DisplayRequirements,
    level_srgb: u8,
    measure_for: Duration,
    started: Instant,
    /// When the window last changed its size or was not painted.
    settled: Instant,
    window_px: [u32; 2],
    /// Whether the last pass was drawn.
    painted: bool,
    measuring: Option<Measuring>,
    result: Option<(DisplayFigures, Verdict)>,
}

#[derive(Debug)]
struct Measuring {
    began: Instant,
    meter: FrameMeter,
    pace: Pace,
}

impl DisplayCheck {
    /// A check of what a protocol asks, on a grey of this level (8-bit sRGB). It
    /// measures the frames asked, and for `at_least` this long.
    #[must_use]
    pub fn new(asked: DisplayRequirements, level_srgb: u8, at_least: Duration) -> Self {
        let now = Instant::now();
        Self {
            asked,
            level_srgb,
            measure_for: at_least,
            started: now,
            settled: now,
            window_px: [0; 2],
            painted: false,
            measuring: None,
            result: None,
        }
    }

    /// One pass: grey, and nothing else.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx();
        ctx.set_cursor_icon(egui::CursorIcon::None);
        stimulus_view::paint_grey(ctx, self.level_srgb);
        self.painted = true;
    }

    /// The pass was handed to the display; the call returned at `at`. `feedback` is
    /// what the display system tells about the window, if anything.
    pub fn presented(
        &mut self,
        ctx: &Context,
        window: Option<&Window>,
        feedback: Option<&mut PresentFeedback>,
        at: Instant,
    ) {
        if self.result.is_some() {
            return;
        }
        let facts = DisplayFacts::read(ctx, window);
        let painted = std::mem::take(&mut self.painted);
        if !painted || facts.window_px != self.window_px {
            self.window_px = facts.window_px;
            self.settled = at;
            self.measuring = None;
        }
        let mut told = None;
        if let Some(feedback) = feedback {
            feedback.displayed();
            told = feedback.refresh_period();
            feedback.ask_refresh();
        }
        let wait = self.measure(&facts, at);
        if self.is_enough(at) {
            self.result = Some(self.conclude(ctx, &facts, told));
        }
        // At once, and once: without a delay egui would draw it twice.
        ctx.request_repaint_after(wait.max(Duration::from_nanos(1)));
    }

    /// Counts a frame, once the window has settled; gives how long to wait for the
    /// next.
    fn measure(&mut self, facts: &DisplayFacts, at: Instant) -> Duration {
        let stated = facts
            .refresh_hz
            .and_then(|hz| Duration::try_from_secs_f64(1.0 / hz).ok())
            .filter(|period| !period.is_zero());
        let period = stated.unwrap_or(USUAL_PERIOD);
        let measuring = self.measuring.get_or_insert_with(|| Measuring {
            began: at,
            meter: FrameMeter::new(u64::try_from(period.as_nanos()).unwrap_or(u64::MAX)),
            pace: Pace::new(period),
        });
        let waited = measuring.pace.surface_waits();
        let wait = measuring.pace.presented(at);
        if at.saturating_duration_since(self.settled) < WARM_UP
            || measuring.pace.surface_waits() != waited
        {
            // Not yet, or not at this pace: the figures begin here.
            measuring.meter = FrameMeter::new(measuring.meter.period_ns());
            measuring.began = at;
        }
        let since = at.saturating_duration_since(measuring.began).as_nanos();
        measuring.meter.presented(SessionTime {
            ns: u64::try_from(since).unwrap_or(u64::MAX),
        });
        wait
    }

    fn is_enough(&self, at: Instant) -> bool {
        let enough = self.measuring.as_ref().is_some_and(|measuring| {
            let frames = measuring.meter.figures().valid_frames;
            frames >= u64::from(self.asked.minimum_frames.get())
                && at.saturating_duration_since(measuring.began) >= self.measure_for
        });
        enough || at.saturating_duration_since(self.started) >= PATIENCE + self.measure_for
    }

    fn conclude(
        &self,
        ctx: &Context,
        facts: &DisplayFacts,
        told: Option<Duration>,
    ) -> (DisplayFigures, Verdict) {
        let mut figures = DisplayFigures {
            mean_refresh_hz: None,
            jitter_sd_ms: None,
            longest_ms: 0.0,
            valid_frames: 0,
            missed: 0,
            stated_refresh_hz: facts.refresh_hz,
            told_refresh_hz: told.map(|period| 1.0 / period.as_secs_f64()),
            scale_factor: f64::from(facts.scale_factor),
            window_px: facts.window_px,
            monitor_px: facts.monitor_px,
            // Without a window manager a window may believe it covers the screen.
            full_screen: facts
                .monitor_px
                .map_or(facts.full_screen, |monitor| monitor == facts.window_px),
            focused: ctx.input(|input| input.focused),
            method: FrameTimes::PresentCall,
        };
        if let Some(measuring) = &self.measuring {
            let method = if measuring.pace.surface_waits() {
                FrameTimes::PresentCall
            } else {
                FrameTimes::Timer
            };
            figures = figures.with_frames(&measuring.meter.figures(), method);
        }
        let verdict = judge(&figures, &self.asked);
        tracing::info!(?figures, ?verdict, "the display was checked");
        (figures, verdict)
    }

    /// Figures and verdict, once there are any.
    #[must_use]
    pub fn finished(&self) -> Option<&(DisplayFigures, Verdict)> {
        self.result.as_ref()
    }
}

/// Opens a window on the grey, checks the display and closes it again; with
/// `windowed`, without covering the screen. `None` if it was closed before.
///
/// # Errors
/// [`AppError`] if there is no display, no graphics adapter, or the window system
/// fails.
pub fn run(
    asked: DisplayRequirements,
    at_least: Duration,
    windowed: bool,
) -> Result<Option<(DisplayFigures, Verdict)>, AppError> {
    check_display()?;
    let alone = Rc::new(RefCell::new(CheckWindow {
        asked,
        at_least,
        windowed,
        full_screen: FullScreen::default(),
        window: None,
        feedback: None,
        check: None,
        begun: None,
    }));
    window::run(
        "Greyfield: display check",
        START_PAGE,
        &(Rc::clone(&alone) as _),
    )?;
    let result = alone
        .borrow()
        .check
        .as_ref()
        .and_then(|check| check.result.clone());
    Ok(result)
}

/// A window of its own for the check alone.
struct CheckWindow {
    asked: DisplayRequirements,
    at_least: Duration,
    windowed: bool,
    full_screen: FullScreen,
    window: Option<Arc<Window>>,
    feedback: Option<PresentFeedback>,
    /// From when the window has had its time to cover the screen.
    check: Option<DisplayCheck>,
    begun: Option<Instant>,
}

/// Level of the grey where no protocol names one.
const MID_GREY: u8 = 128;

impl window::Content for CheckWindow {
    fn ui(&mut self, ui: &mut Ui) {
        self.begun = Some(Instant::now());
        self.full_screen.keep(ui.ctx(), self.window.as_deref());
        match &mut self.check {
            Some(check) => check.ui(ui),
            None => stimulus_view::paint_grey(ui.ctx(), MID_GREY),
        }
    }

    fn opened(&mut self, ctx: &Context, window: Option<Arc<Window>>) {
        theme::install(ctx);
        self.feedback = window.as_deref().and_then(PresentFeedback::listen);
        self.window = window;
        if !self.windowed {
            self.full_screen.enter(ctx);
        }
    }

    fn pressed(&mut self, _at: Instant) {}

    fn presented(&mut self, ctx: &Context, at: Instant) {
        if let (Some(feedback), Some(begun)) = (&mut self.feedback, self.begun.take()) {
            feedback.handed_over(begun, at);
        }
        if self.check.is_none() && self.full_screen.is_settled() {
            self.check = Some(DisplayCheck::new(self.asked, MID_GREY, self.at_least));
            ctx.request_repaint();
        }
        if let Some(check) = &mut self.check {
            check.presented(ctx, self.window.as_deref(), self.feedback.as_mut(), at);
            if check.finished().is_some() {
                ctx.send_viewport_cmd(ViewportCommand::Close);
                // The command is taken in one pass and followed in the next.
                ctx.request_repaint();
            }
        }
    }

    fn clear_level(&self) -> u8 {
        MID_GREY
    }
}
