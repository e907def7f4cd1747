//! Is the display good enough for the session? A pure judgement of measured figures.

use serde::{Deserialize, Serialize};

use super::frames::FrameFigures;
use crate::protocol::DisplayRequirements;
use crate::protocol::display::Strictness;

/// How far the stated rate may lie from the measured one and still be the same.
const SAME_RATE: f64 = 0.01;

/// Standard deviation of a steady run, as a share of its period.
const STEADY: f64 = 0.05;

/// What a display was found to be; kept with the data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DisplayFigures {
    /// Frames a second, from the mean time between frames; absent if too few came.
    pub mean_refresh_hz: Option<f64>,
    /// Sample standard deviation of the time from frame to frame.
    pub jitter_sd_ms: Option<f64>,
    /// Longest time from frame to frame.
    pub longest_ms: f64,
    /// Frames these figures are of.
    pub valid_frames: u64,
    /// Refreshes that passed without a new frame.
    pub missed: u64,
    /// The rate the system states, hertz; some state none.
    pub stated_refresh_hz: Option<f64>,
    /// The rate of the refreshes the display system told the times of, hertz; few do.
    pub told_refresh_hz: Option<f64>,
    /// Physical pixels a point of the interface.
    pub scale_factor: f64,
    /// Size of the window's content, physical pixels.
    pub window_px: [u32; 2],
    /// Size of the monitor, physical pixels; unknown on some systems.
    pub monitor_px: Option<[u32; 2]>,
    /// Whether the window covers the monitor.
    pub full_screen: bool,
    /// Whether the window has the keyboard focus.
    pub focused: bool,
    /// What the times of the frames are.
    pub method: FrameTimes,
}

/// Where the times of frames come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrameTimes {
    /// When the call that hands a frame over returned; the surface makes it wait for
    /// the display.
    PresentCall,
    /// The same, but the surface does not wait: the frames keep to a timer, and
    /// say nothing about the display.
    Timer,
}

impl DisplayFigures {
    /// Takes over what a meter measured.
    #[must_use]
    pub fn with_frames(self, frames: &FrameFigures, method: FrameTimes) -> Self {
        Self {
            mean_refresh_hz: frames
                .mean_period_ns
                .filter(|&period_ns| period_ns > 0.0)
                .map(|period_ns| 1e9 / period_ns),
            jitter_sd_ms: frames.jitter_sd_ns.map(|sd_ns| sd_ns / 1e6),
            longest_ms: frames.longest_ns as f64 / 1e6,
            valid_frames: frames.valid_frames,
            missed: frames.missed_frames,
            method,
            ..self
        }
    }

    /// The time from refresh to refresh, nanoseconds. As the display system tells or
    /// states it where that agrees with what was measured, because a mean of a
    /// second's frames is not exact; as measured where the frames were steady; else
    /// they were late, and what the system says is all there is.
    #[must_use]
    pub fn period_ns(&self) -> Option<u64> {
        let said = self.told_refresh_hz.or(self.stated_refresh_hz);
        let measured = self.mean_refresh_hz.filter(|_| self.is_steady());
        self.agreed_hz()
            .or(measured)
            .or(said)
            .or(self.mean_refresh_hz)
            .and_then(period_ns)
    }

    /// The same, where a frame that is handed over stands for one refresh at least:
    /// then timed screens can be counted in frames
    /// (see [`SessionInfo::refresh_period_ns`](super::SessionInfo::refresh_period_ns)).
    /// A surface that keeps exactly the rate that the system says does so.
    #[must_use]
    pub fn counted_period_ns(&self) -> Option<u64> {
        match self.method {
            FrameTimes::PresentCall => self.agreed_hz().and_then(period_ns),
            FrameTimes::Timer => None,
        }
    }

    /// The rate the system says, if frames came at it.
    fn agreed_hz(&self) -> Option<f64> {
        let measured = self.mean_refresh_hz?;
        [self.told_refresh_hz, self.stated_refresh_hz]
            .into_iter()
            .flatten()
            .find(|said| (said / measured - 1.0).abs() <= SAME_RATE)
    }

    /// Whether every frame came when the one before said it would.
    fn is_steady(&self) -> bool {
        let jitter = self.jitter_sd_ms.zip(self.mean_refresh_hz);
        self.method == FrameTimes::PresentCall
            && self.missed == 0
            && jitter.is_some_and(|(sd_ms, hz)| sd_ms / 1000.0 * hz < STEADY)
    }
}

fn period_ns(hz: f64) -> Option<u64> {
    // Positive and far below the limit for every rate there is.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    (hz > 0.0).then(|| (1e9 / hz).round() as u64)
}

/// Something about a display that is not as the protocol asks.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Shortfall {
    /// The measurement is too short to say anything.
    #[error(
        "only {found} frames were measured, {needed} are needed: is the window hidden, or the display asleep?"
    )]
    TooFewFrames {
        /// Frames measured.
        found: u64,
        /// Frames asked.
        needed: u32,
    },
    /// The frames do not come regularly.
    #[error(
        "the time from frame to frame varies by {found_ms:.2} ms (standard deviation), allowed is {allowed_ms:.2} ms: close other programs, switch power saving and adaptive refresh rates off, or raise display.maximum_jitter_ms"
    )]
    Jitter {
        /// Standard deviation measured.
        found_ms: f64,
        /// Largest allowed.
        allowed_ms: f64,
    },
    /// The display refreshes too slowly or too fast.
    #[error(
        "the display shows {found_hz:.2} frames a second, allowed is {low_hz} to {high_hz}: set its refresh rate in the system's settings"
    )]
    RefreshRate {
        /// Mean rate measured.
        found_hz: f64,
        /// Lowest allowed.
        low_hz: f64,
        /// Highest allowed.
        high_hz: f64,
    },
    /// Something besides the window is on the screen.
    #[error(
        "the window does not cover the screen: it has {}×{} pixels{}. Let it go full screen",
        window_px[0], window_px[1],
        monitor_px.map(|[x, y]| format!(", the monitor {x}×{y}")).unwrap_or_default()
    )]
    NotFullScreen {
        /// Size of the window.
        window_px: [u32; 2],
        /// Size of the monitor, where known.
        monitor_px: Option<[u32; 2]>,
    },
    /// Keys would go elsewhere.
    #[error(
        "the window does not have the keyboard focus: click into it, and close what takes it away"
    )]
    NoFocus,
}

/// What follows from a display's figures.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// All as asked.
    Good,
    /// Not as asked; the experimenter decides.
    Warned(Vec<Shortfall>),
    /// Not as asked; no session.
    Refused(Vec<Shortfall>),
}

impl Verdict {
    /// What is not as asked.
    #[must_use]
    pub fn shortfalls(&self) -> &[Shortfall] {
        match self {
            Self::Good => &[],
            Self::Warned(shortfalls) | Self::Refused(shortfalls) => shortfalls,
        }
    }

    /// Whether a session may not begin.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        matches!(self, Self::Refused(_))
    }
}

/// Compares a display with what a protocol asks.
#[must_use]
pub fn judge(figures: &DisplayFigures, asked: &DisplayRequirements) -> Verdict {
    let shortfalls = shortfalls(figures, asked);
    match asked.verdict {
        _ if shortfalls.is_empty() => Verdict::Good,
        Strictness::Refuse => Verdict::Refused(shortfalls),
        Strictness::Warn => Verdict::Warned(shortfalls),
    }
}

fn shortfalls(figures: &DisplayFigures, asked: &DisplayRequirements) -> Vec<Shortfall> {
    let mut found = Vec::new();
    let needed = asked.minimum_frames.get();
    if figures.valid_frames < u64::from(needed) {
        found.push(Shortfall::TooFewFrames {
            found: figures.valid_frames,
            needed,
        });
    }
    let allowed_ms = f64::from(asked.maximum_jitter.get());
    if let Some(found_ms) = figures.jitter_sd_ms.filter(|&sd_ms| sd_ms > allowed_ms) {
        found.push(Shortfall::Jitter {
            found_ms,
            allowed_ms,
        });
    }
    if let (Some(range), Some(found_hz)) = (asked.refresh_hz, figures.mean_refresh_hz) {
        let (low_hz, high_hz) = (range.low_hz(), range.high_hz());
        if !(low_hz..=high_hz).contains(&found_hz) {
            found.push(Shortfall::RefreshRate {
                found_hz,
                low_hz,
                high_hz,
            });
        }
    }
    if asked.full_screen && !figures.full_screen {
        found.push(Shortfall::NotFullScreen {
            window_px: figures.window_px,
            monitor_px: figures.monitor_px,
        });
    }
    if asked.focus && !figures.focused {
        found.push(Shortfall::NoFocus);
    }
    found
}

#[cfg(test)]
mod tests;
