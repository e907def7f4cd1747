//! When to ask for the next frame while a picture stands.
//!
//! With vertical sync the surface itself makes the application wait, and the next
//! frame is asked for at once. Some surfaces do not: a software adapter under X
//! copies a frame to the window and returns. There the frames follow a grid of the
//! display's period instead, so that the application sleeps and does not spin.

use std::time::{Duration, Instant};

/// Period where the display states none.
pub const USUAL_PERIOD: Duration = Duration::from_nanos(16_666_667);

/// Frames that must follow each other too fast before the surface is taken for one
/// that does not wait. More than any queue of frames holds.
const FAST_FRAMES: u32 = 8;

/// What share of a period is too fast.
const FAST_SHARE: f64 = 0.9;

/// Keeps frames to the display's period.
#[derive(Debug, Clone)]
pub struct Pace {
    period: Duration,
    last: Option<Instant>,
    fast: u32,
    /// When the next frame is due, once the surface was found not to wait.
    due: Option<Instant>,
    waits: bool,
}

impl Pace {
    /// Frames every `period`, on a surface that is taken to wait until it shows
    /// otherwise.
    #[must_use]
    pub fn new(period: Duration) -> Self {
        Self {
            period,
            last: None,
            fast: 0,
            due: None,
            waits: true,
        }
    }

    /// The period.
    #[must_use]
    pub fn period(&self) -> Duration {
        self.period
    }

    /// Whether the surface keeps frames to the display's refreshes, as far as is
    /// known.
    #[must_use]
    pub fn surface_waits(&self) -> bool {
        self.waits
    }

    /// A frame was handed over at `at`; gives after how long to ask for the next.
    pub fn presented(&mut self, at: Instant) -> Duration {
        if let Some(last) = self.last.replace(at) {
            let interval = at.saturating_duration_since(last);
            self.fast = if interval < self.period.mul_f64(FAST_SHARE) {
                self.fast + 1
            } else {
                0
            };
            self.waits &= self.fast < FAST_FRAMES;
        }
        if self.waits {
            return Duration::ZERO;
        }
        let next = self.due.unwrap_or(at) + self.period;
        // Too late for the grid: it begins again here, so that no frames crowd to catch up.
        let due = if next <= at { at + self.period } else { next };
        self.due = Some(due);
        due - at
    }

    /// No frame will follow for a while.
    pub fn pause(&mut self) {
        self.last = None;
        self.fast = 0;
        self.due = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: Duration = Duration::from_millis(10);

    /// Presents frames that each take `drawing` beyond what the pace asks to wait, on
    /// a surface that waits or does not; gives the times from frame to frame.
    fn intervals(waits: bool, drawing: Duration, frames: usize) -> (Vec<Duration>, Pace) {
        let mut pace = Pace::new(PERIOD);
        let start = Instant::now();
        let mut now = start;
        let mut times = Vec::new();
        for _ in 0..frames {
            now += drawing;
            if waits {
                let periods = (now - start).as_nanos().div_ceil(PERIOD.as_nanos());
                now = start + PERIOD * u32::try_from(periods).unwrap();
            }
            times.push(now);
            now += pace.presented(now);
        }
        (
            times.windows(2).map(|pair| pair[1] - pair[0]).collect(),
            pace,
        )
    }

    #[test]
    fn a_surface_that_waits_sets_the_pace_itself() {
        let (intervals, pace) = intervals(true, Duration::from_millis(3), 100);
        assert!(intervals.iter().all(|interval| *interval == PERIOD));
        assert!(pace.surface_waits());
    }

    #[test]
    fn a_surface_that_does_not_wait_is_paced_after_a_few_frames() {
        let (intervals, pace) = intervals(false, Duration::from_millis(2), 100);
        assert!(!pace.surface_waits());
        let paced = &intervals[10..];
        assert!(
            paced.iter().all(|interval| *interval == PERIOD),
            "{paced:?}"
        );
    }

    #[test]
    fn a_frame_that_came_late_is_not_made_up_for() {
        let (_, mut pace) = intervals(false, Duration::from_millis(2), 20);
        let late = Instant::now() + Duration::from_secs(60);
        assert_eq!(pace.presented(late), PERIOD);
    }

    #[test]
    fn slow_drawing_is_no_sign_of_a_surface_that_does_not_wait() {
        let (_, pace) = intervals(false, Duration::from_millis(12), 100);
        assert!(pace.surface_waits());
    }
}
