//! Covering the monitor, also where nobody helps.

use std::time::{Duration, Instant};

use eframe::egui::{Context, ViewportCommand};
use winit::window::Window;

use super::display::DisplayFacts;

/// How long the window system has to cover the screen. Nobody reads instructions
/// faster, so no image is on screen yet.
const PATIENCE: Duration = Duration::from_millis(700);

/// A window on its way to the full screen.
#[derive(Debug, Default)]
pub struct FullScreen {
    /// Since when the window should cover the screen; `None` once that is settled.
    since: Option<Instant>,
}

impl FullScreen {
    /// Asks for the full screen.
    pub fn enter(&mut self, ctx: &Context) {
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        self.since = Some(Instant::now());
    }

    /// Back to a window.
    pub fn leave(&mut self, ctx: &Context) {
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(false));
        self.since = None;
    }

    /// Whether the window has had the time it needs.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.since.is_none()
    }

    /// To be called in every pass. Makes the window as large as the monitor where
    /// asking for the full screen was not enough: without a window manager nobody
    /// else does it.
    pub fn keep(&mut self, ctx: &Context, window: Option<&Window>) {
        let Some(since) = self.since else {
            return;
        };
        let found = DisplayFacts::read(ctx, window);
        let Some(monitor_px) = found.monitor_px else {
            self.since = None;
            return;
        };
        if let Some(left) = PATIENCE.checked_sub(since.elapsed()) {
            ctx.request_repaint_after(left);
            return;
        }
        self.since = None;
        if found.window_px != monitor_px {
            tracing::warn!(?found, "the full screen was refused; enlarging the window");
            let points = monitor_px.map(|px| px as f32 / found.scale_factor);
            ctx.send_viewport_cmd(ViewportCommand::InnerSize(points.into()));
        }
    }
}
