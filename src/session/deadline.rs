//! When a timed screen ends: decided before each frame, for the frame to come.
//!
//! A display shows whole refreshes, so a duration is a number of frames. Waiting
//! for the clock to pass the deadline and then drawing the next screen would add a
//! frame or two; here the decision falls one frame ahead. Where the period of the
//! display is not known, or the surface does not wait for it, the clock decides.

use super::SessionTime;

/// How far a duration may exceed a whole number of frames and still be that
/// number: 2000 ms are 119.88 frames of a display at 59.94 Hz and become 120, and a
/// period measured 0.1 % too short does not turn 120 frames into 121. A duration may
/// come out shorter than asked by this share of one frame, never by more.
const ROUNDING_FRAMES: f64 = 0.25;

/// The end of a screen that ends by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deadline {
    /// When its first frame was handed over.
    pub onset: SessionTime,
    /// How long it should stand, nanoseconds.
    pub duration_ns: u64,
    /// Time from refresh to refresh, where frames are known to keep to it.
    pub period_ns: Option<u64>,
}

impl Deadline {
    /// The frames the screen should stand, at least one; `None` where frames do
    /// not count.
    #[must_use]
    pub fn frames_asked(&self) -> Option<u64> {
        let period_ns = self.period_ns.filter(|&period| period > 0)?;
        let frames = self.duration_ns as f64 / period_ns as f64 - ROUNDING_FRAMES;
        // Not negative, and saturating: `as` does both here.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let whole = frames.ceil() as u64;
        Some(whole.max(1))
    }

    /// The earliest time at which the screen may give way: of the clock without
    /// a period, else of the next screen's first frame.
    #[must_use]
    pub fn at(&self) -> SessionTime {
        let stand_ns = match (self.frames_asked(), self.period_ns) {
            (Some(frames), Some(period_ns)) => {
                // Half a period of grace: frames are handed over with some jitter.
                frames
                    .saturating_mul(period_ns)
                    .saturating_sub(period_ns / 2)
            }
            _ => self.duration_ns,
        };
        SessionTime {
            ns: self.onset.ns.saturating_add(stand_ns),
        }
    }

    /// Whether the next frame should already show the next screen, when
    /// `frames_shown` frames of this one were handed over and the next will be at
    /// about `expected`. False where frames do not count: see
    /// [`Deadline::has_passed`].
    ///
    /// A frame stands for one refresh at least, so the count alone keeps the screen
    /// from ending early; a frame that came late makes it longer. The time only
    /// guards against a surface that takes frames faster than it shows them.
    #[must_use]
    pub fn next_frame_is_after(&self, frames_shown: u64, expected: SessionTime) -> bool {
        self.frames_asked()
            .is_some_and(|asked| frames_shown >= asked && expected >= self.at())
    }

    /// Whether the time is over by the clock; false where frames count instead.
    #[must_use]
    pub fn has_passed(&self, now: SessionTime) -> bool {
        self.frames_asked().is_none() && now >= self.at()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn deadline(duration_ns: u64, period_ns: u64) -> Deadline {
        Deadline {
            onset: SessionTime { ns: 0 },
            duration_ns,
            period_ns: Some(period_ns),
        }
    }

    #[test]
    fn two_seconds_are_the_whole_frames_nearest_from_above() {
        for (hz, frames) in [
            (60.0, 120),
            (59.94, 120),
            (59.95, 120),
            // Twice the exact number, and a measured period a little off either way.
            (120.0, 240),
            (60.05, 120),
            (59.9, 120),
            (75.0, 150),
            (143.98, 288),
            (144.0, 288),
            (165.0, 330),
            (240.0, 480),
        ] {
            let period_ns = (1e9 / hz) as u64;
            assert_eq!(
                deadline(2_000_000_000, period_ns).frames_asked(),
                Some(frames),
                "{hz} Hz"
            );
        }
    }

    #[test]
    fn no_duration_is_still_a_frame() {
        assert_eq!(deadline(0, 16_666_667).frames_asked(), Some(1));
        assert_eq!(deadline(1, 16_666_667).frames_asked(), Some(1));
    }

    #[test]
    fn without_a_period_the_clock_decides_and_never_early() {
        let clocked = Deadline {
            onset: SessionTime { ns: 5 },
            duration_ns: 100,
            period_ns: None,
        };
        assert!(!clocked.has_passed(SessionTime { ns: 104 }));
        assert!(clocked.has_passed(SessionTime { ns: 105 }));
        assert!(!clocked.next_frame_is_after(u64::MAX, SessionTime { ns: u64::MAX }));
    }

    #[test]
    fn a_surface_that_takes_frames_too_fast_does_not_cut_the_screen_short() {
        let deadline = deadline(1000, 100);
        assert!(!deadline.next_frame_is_after(10, SessionTime { ns: 949 }));
        assert!(deadline.next_frame_is_after(10, SessionTime { ns: 950 }));
        assert!(!deadline.next_frame_is_after(9, SessionTime { ns: 2000 }));
        assert!(
            !deadline.has_passed(SessionTime { ns: 2000 }),
            "frames count here"
        );
    }

    proptest! {
        #[test]
        fn the_frames_asked_are_at_most_a_quarter_of_one_short_and_less_than_one_long(
            duration_ns in 1_000_000_u64..20_000_000_000,
            period_ns in 2_000_000_u64..50_000_000,
        ) {
            let asked = deadline(duration_ns, period_ns).frames_asked().unwrap();
            let surplus = asked as f64 - duration_ns as f64 / period_ns as f64;
            prop_assert!(asked == 1 || (-0.25 - 1e-9..0.75 + 1e-9).contains(&surplus), "{}", surplus);
        }
    }

    /// A display with vertical sync: frames queue up, `images` at most at a time
    /// with the one on the screen, and each refresh takes one from the queue.
    struct Fifo {
        period_ns: u64,
        images: usize,
        /// Refresh at which each frame so far appears.
        shown_at_refresh: Vec<u64>,
    }

    impl Fifo {
        /// Hands a frame over from `start_ns`; gives when the call returns. It waits
        /// until an image is free, and the frame appears at the first refresh
        /// after the call that no earlier frame has taken.
        fn present(&mut self, start_ns: u64, drawing_ns: u64) -> u64 {
            let count = self.shown_at_refresh.len();
            // An image is free again when the frame after the one in it appears.
            let free_ns = (count >= self.images)
                .then(|| self.shown_at_refresh[count - self.images + 1] * self.period_ns);
            let returned_ns = start_ns.max(free_ns.unwrap_or(0)) + drawing_ns;
            let next_free = self.shown_at_refresh.last().map_or(0, |last| last + 1);
            self.shown_at_refresh
                .push((returned_ns / self.period_ns + 1).max(next_free));
            returned_ns
        }
    }

    /// Shows a timed screen from frame `before` on, and the next one after it; gives
    /// for how many refreshes it stood.
    fn refreshes_shown(
        images: usize,
        period_ns: u64,
        duration_ns: u64,
        before: usize,
        drawing_ns: &[u64],
        stalls: &[(usize, u64)],
    ) -> (u64, u64) {
        let mut fifo = Fifo {
            period_ns,
            images,
            shown_at_refresh: Vec::new(),
        };
        let (mut now, mut last) = (3 * period_ns, 0);
        let mut screen: Option<Deadline> = None;
        let mut shown = 0;
        for frame in 0.. {
            now += stalls
                .iter()
                .filter(|s| s.0 == frame)
                .map(|s| s.1)
                .sum::<u64>();
            let expected = SessionTime {
                ns: now.max(last + period_ns),
            };
            if screen.is_some_and(|screen| screen.next_frame_is_after(shown, expected)) {
                break;
            }
            now = fifo.present(now, drawing_ns[frame % drawing_ns.len()]);
            last = now;
            if frame >= before {
                shown += 1;
                screen.get_or_insert(Deadline {
                    onset: SessionTime { ns: now },
                    ..deadline(duration_ns, period_ns)
                });
            }
        }
        // The frame of the next screen.
        fifo.present(now, drawing_ns[0]);
        let at = &fifo.shown_at_refresh;
        let asked = deadline(duration_ns, period_ns).frames_asked().unwrap();
        (at[at.len() - 1] - at[before], asked)
    }

    proptest! {
        #[test]
        fn the_grey_stands_exactly_as_long_as_asked_on_a_display_that_keeps_up(
            images in 2_usize..4,
            period_ns in 4_000_000_u64..20_000_000,
            duration_ns in 1_000_000_u64..2_500_000_000,
            before in 5_usize..20,
            // Less than half a period of drawing, jitter included.
            share in prop::collection::vec(0.01..0.49_f64, 1..40),
        ) {
            let drawing: Vec<u64> = share.iter().map(|s| (s * period_ns as f64) as u64).collect();
            let (shown, asked) =
                refreshes_shown(images, period_ns, duration_ns, before, &drawing, &[]);
            prop_assert_eq!(shown, asked);
        }

        #[test]
        fn the_grey_is_never_shorter_whatever_stalls(
            images in 2_usize..4,
            period_ns in 4_000_000_u64..20_000_000,
            duration_ns in 1_000_000_u64..1_500_000_000,
            before in 0_usize..20,
            share in prop::collection::vec(0.0..1.8_f64, 1..40),
            stalls in prop::collection::vec((0_usize..150, 0_u64..100_000_000), 0..6),
        ) {
            let drawing: Vec<u64> = share.iter().map(|s| (s * period_ns as f64) as u64).collect();
            let (shown, asked) =
                refreshes_shown(images, period_ns, duration_ns, before, &drawing, &stalls);
            prop_assert!(shown >= asked, "{} of {}", shown, asked);
        }
    }
}
