//! Between the start page and a session: the display is checked, and where it falls
//! short and the protocol only warns, the experimenter decides.

use std::time::{Duration, Instant};

use eframe::egui::{Context, CursorIcon, Rect, Ui, UiBuilder, vec2};
use winit::window::Window;

use super::display_check::DisplayCheck;
use super::present_feedback::PresentFeedback;
use super::start_page::Request;
use super::{stimulus_view, theme};
use crate::protocol::Protocol;
use crate::record::DisplayVerdict;
use crate::session::display_gate::Shortfall;
use crate::session::{DisplayFigures, DisplayOnRecord, Verdict};

/// How long the display is looked at, at least.
const AT_LEAST: Duration = Duration::from_secs(1);

/// Widest the page gets, points.
const WIDTH: f32 = 860.0;

/// A session that was asked for and waits for its display.
#[derive(Debug)]
pub struct Readiness {
    request: Request,
    check: DisplayCheck,
}

/// A display that was found good enough, or that nobody looked at.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Checked {
    /// What was measured; absent where nothing was.
    pub figures: Option<DisplayFigures>,
    /// What was said of it.
    pub verdict: DisplayVerdict,
}

impl Checked {
    /// What goes into every row.
    #[must_use]
    pub fn on_record(&self) -> DisplayOnRecord {
        let figures = self.figures.as_ref();
        DisplayOnRecord {
            refresh_period_ms: figures
                .and_then(DisplayFigures::period_ns)
                .map(|period_ns| period_ns as f64 / 1e6),
            refresh_jitter_sd_ms: figures.and_then(|figures| figures.jitter_sd_ms),
            verdict: self.verdict,
        }
    }
}

/// What becomes of the session.
#[derive(Debug)]
pub enum Outcome {
    /// It begins.
    Begin(Request, Checked),
    /// It does not, and why.
    Back(String),
}

impl Readiness {
    /// Begins the check of what the protocol asks.
    #[must_use]
    pub fn new(request: Request, protocol: &Protocol) -> Self {
        let level = protocol.grey.level_srgb.get();
        Self {
            request,
            check: DisplayCheck::new(protocol.display, level, AT_LEAST),
        }
    }

    /// One pass: the grey of the check, or the page that tells what it found.
    pub fn ui(&mut self, ui: &mut Ui) -> Option<Outcome> {
        let Some((figures, verdict)) = self.check.finished().cloned() else {
            self.check.ui(ui);
            return None;
        };
        ui.ctx().set_cursor_icon(CursorIcon::Default);
        let begin = |verdict| {
            let figures = Some(figures.clone());
            Outcome::Begin(self.request.clone(), Checked { figures, verdict })
        };
        match verdict {
            Verdict::Good => Some(begin(DisplayVerdict::Passed)),
            Verdict::Refused(shortfalls) => Some(Outcome::Back(format!(
                "The display is not as the protocol asks: {}",
                sentences(&shortfalls)
            ))),
            Verdict::Warned(shortfalls) => match warning(ui, &shortfalls)? {
                true => Some(begin(DisplayVerdict::Warned)),
                false => Some(Outcome::Back(String::new())),
            },
        }
    }

    /// The pass was handed to the display.
    pub fn presented(
        &mut self,
        ctx: &Context,
        window: Option<&Window>,
        feedback: Option<&mut PresentFeedback>,
        at: Instant,
    ) {
        self.check.presented(ctx, window, feedback, at);
    }
}

fn sentences(shortfalls: &[Shortfall]) -> String {
    let texts: Vec<String> = shortfalls.iter().map(ToString::to_string).collect();
    texts.join("; ")
}

/// The page for the experimenter; true to begin, false to go back.
fn warning(ui: &mut Ui, shortfalls: &[Shortfall]) -> Option<bool> {
    stimulus_view::paint_grey(ui.ctx(), theme::PAGE);
    let screen = ui.ctx().viewport_rect();
    let width = WIDTH.min(screen.width() - 48.0).max(1.0);
    let corner = screen.center_top() + vec2(-width / 2.0, screen.height() * 0.1);
    let column = Rect::from_min_size(corner, vec2(width, screen.height() * 0.8));
    ui.scope_builder(UiBuilder::new().max_rect(column), |ui| {
        theme::card().show(ui, |ui| decision(ui, shortfalls)).inner
    })
    .inner
}

fn decision(ui: &mut Ui, shortfalls: &[Shortfall]) -> Option<bool> {
    ui.set_min_width(ui.available_width());
    ui.heading("The display is not as the protocol asks");
    ui.add_space(8.0);
    for shortfall in shortfalls {
        ui.label(format!("– {shortfall}"));
    }
    ui.add_space(8.0);
    ui.label(theme::quiet(
        "The protocol leaves it to you. What was found goes on record with every row.",
    ));
    ui.add_space(12.0);
    ui.horizontal(|ui| {
        let begin = ui.add(theme::primary_button(
            "Begin all the same",
            vec2(220.0, 44.0),
        ));
        let back = ui.button("Back");
        match (begin.clicked(), back.clicked()) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    })
    .inner
}
