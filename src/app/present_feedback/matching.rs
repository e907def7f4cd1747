//! Which of our frames a report of the display system is about.
//!
//! Reports carry a serial number that the driver counts up with each frame of a
//! swap chain, and come in the order of the frames. Which number our first frame
//! had is not told, and a new swap chain (a window changes size) begins again. So
//! the numbers are only followed from report to report. Wherever they do not go on
//! by what is outstanding, the thread is lost, and taken up again with the first
//! frame after a rest, when no other can be outstanding. Meanwhile reports are
//! dropped: their frames keep their estimates, and none gets another one's time.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Frames that may be outstanding; far more than any swap chain holds.
const OUTSTANDING: usize = 32;

/// A frame cannot wait longer than this for its refresh while others are reported.
const PATIENCE: Duration = Duration::from_secs(1);

/// After a rest this long every report there will be has come.
const REST: Duration = Duration::from_millis(250);

/// A frame that was handed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HandedOver {
    /// When its drawing began.
    pub begun: Instant,
    /// When the call that handed it over returned; names the frame.
    pub at: Instant,
}

/// Frames handed over whose reports have not come yet.
#[derive(Debug, Clone, Default)]
pub struct Matcher {
    outstanding: VecDeque<HandedOver>,
    last_serial: Option<u32>,
    /// The thread is lost.
    adrift: bool,
    /// The last frame or report.
    last_sign: Option<Instant>,
}

impl Matcher {
    /// A frame was handed over.
    pub fn handed_over(&mut self, frame: HandedOver) {
        let rested = self
            .last_sign
            .is_none_or(|sign| frame.begun.saturating_duration_since(sign) >= REST);
        if rested {
            self.begin_anew();
        }
        self.last_sign = self.last_sign.max(Some(frame.at));
        if self.adrift {
            return;
        }
        if self.outstanding.len() == OUTSTANDING {
            self.lose_thread();
        } else {
            self.outstanding.push_back(frame);
        }
    }

    /// A frame was reported as on the display at `at`. Gives which, where that is
    /// certain.
    pub fn reported(&mut self, serial: u32, at: Instant) -> Option<HandedOver> {
        self.last_sign = self.last_sign.max(Some(at));
        let step = self
            .last_serial
            .map_or(1, |last| serial.wrapping_sub(last) as usize);
        self.last_serial = Some(serial);
        let frame = (1..=self.outstanding.len())
            .contains(&step)
            .then(|| self.outstanding.drain(..step).next_back())
            .flatten()
            .filter(|frame| frame.begun <= at && at.saturating_duration_since(frame.at) < PATIENCE);
        if frame.is_none() {
            self.lose_thread();
        }
        frame
    }

    fn lose_thread(&mut self) {
        self.outstanding.clear();
        self.adrift = true;
    }

    fn begin_anew(&mut self) {
        self.outstanding.clear();
        self.last_serial = None;
        self.adrift = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PERIOD: Duration = Duration::from_millis(16);

    /// Frame `n`, handed over a millisecond after it was begun, and on the display
    /// 25 ms later: the next is begun before the report.
    fn frame(start: Instant, n: u32) -> (HandedOver, Instant) {
        let begun = start + PERIOD * n;
        let at = begun + Duration::from_millis(1);
        (HandedOver { begun, at }, at + Duration::from_millis(25))
    }

    /// Hands over the frames in `frames`, with reports as they come due; `serial` gives
    /// a frame's number, or none if its report is lost. Gives the frames matched.
    fn matched(
        matcher: &mut Matcher,
        start: Instant,
        frames: std::ops::Range<u32>,
        serial: impl Fn(u32) -> Option<u32>,
    ) -> Vec<(u32, Option<HandedOver>)> {
        let mut events: Vec<(Instant, u32, bool)> = frames
            .flat_map(|n| {
                let (handed_over, shown) = frame(start, n);
                [(handed_over.at, n, false), (shown, n, true)]
            })
            .collect();
        events.sort();
        let mut found = Vec::new();
        for (at, n, is_report) in events {
            match (is_report, serial(n)) {
                (false, _) => matcher.handed_over(frame(start, n).0),
                (true, Some(serial)) => found.push((n, matcher.reported(serial, at))),
                (true, None) => {}
            }
        }
        found
    }

    #[test]
    fn frames_in_a_row_are_matched_after_a_rest() {
        let (mut matcher, start) = (Matcher::default(), Instant::now());
        let alone = matched(&mut matcher, start, 0..1, |n| Some(100 + n));
        assert_eq!(alone, [(0, Some(frame(start, 0).0))]);
        for (n, found) in matched(&mut matcher, start, 40..200, Some) {
            assert_eq!(found, Some(frame(start, n).0), "frame {n}");
        }
    }

    #[test]
    fn a_new_swap_chain_loses_frames_until_a_rest_but_mixes_none_up() {
        let (mut matcher, start) = (Matcher::default(), Instant::now());
        let found = matched(&mut matcher, start, 10..30, |n| {
            Some(if n < 20 { n } else { n - 19 })
        });
        for (n, found) in found {
            assert!(found.is_none_or(|found| found == frame(start, n).0), "{n}");
            assert!(n >= 20 || found.is_some(), "{n}");
        }
        // A page of text: one frame, then nothing for a while.
        let alone = matched(&mut matcher, start, 100..101, |_| Some(500));
        assert_eq!(alone, [(100, Some(frame(start, 100).0))]);
        for (n, found) in matched(&mut matcher, start, 200..250, |n| Some(301 + n)) {
            assert_eq!(found, Some(frame(start, n).0), "frame {n}");
        }
    }

    #[test]
    fn reports_of_frames_never_handed_over_match_nothing() {
        let mut matcher = Matcher::default();
        let now = Instant::now();
        for serial in 0..10 {
            assert_eq!(matcher.reported(serial, now), None);
        }
    }

    proptest! {
        /// Lost reports cost their own frame, never another one's time.
        #[test]
        fn no_frame_gets_the_time_of_another(
            lost in prop::collection::hash_set(11_u32..200, 0..60),
        ) {
            let (mut matcher, start) = (Matcher::default(), Instant::now());
            let serial = |n| (!lost.contains(&n)).then_some(n);
            let found = matched(&mut matcher, start, 10..200, serial);
            for (n, found) in found {
                prop_assert_eq!(found, Some(frame(start, n).0));
            }
        }
    }
}
