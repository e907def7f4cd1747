//! Whether frames came in time: a meter of the times at which they were handed
//! to the display. Pure; the caller brings the times.

use super::SessionTime;

/// A frame is late when it comes more than this many periods after the one before.
const LATE_PERIODS: f64 = 1.5;

/// Measures a run of frames against the period they should keep.
///
/// Only the time between two frames that follow each other without a break counts:
/// where nothing was to be drawn, say so with [`FrameMeter::pause`].
#[derive(Debug, Clone, PartialEq)]
pub struct FrameMeter {
    period_ns: u64,
    last: Option<SessionTime>,
    /// Intervals so far, their mean and the sum of squared distances from it, as
    /// Welford (1962) updates them: exact enough for hours of frames.
    count: u64,
    mean_ns: f64,
    squares_ns2: f64,
    longest_ns: u64,
    missed: u64,
}

/// What a run of frames was like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameFigures {
    /// Frames that came without a break after another one.
    pub valid_frames: u64,
    /// Mean time from frame to frame; absent without any.
    pub mean_period_ns: Option<f64>,
    /// Sample standard deviation of that time; absent below two.
    pub jitter_sd_ns: Option<f64>,
    /// Longest of these times; 0 without any.
    pub longest_ns: u64,
    /// Refreshes that passed without a new frame.
    pub missed_frames: u64,
}

impl FrameMeter {
    /// A meter for frames that should come every `period_ns` nanoseconds, at least 1.
    #[must_use]
    pub fn new(period_ns: u64) -> Self {
        Self {
            period_ns: period_ns.max(1),
            last: None,
            count: 0,
            mean_ns: 0.0,
            squares_ns2: 0.0,
            longest_ns: 0,
            missed: 0,
        }
    }

    /// The period frames should keep, nanoseconds.
    #[must_use]
    pub fn period_ns(&self) -> u64 {
        self.period_ns
    }

    /// A frame was presented. Gives how many frames were missed since the one
    /// before; `None` for the first one after a break. A time before the last
    /// one counts as that one.
    pub fn presented(&mut self, at: SessionTime) -> Option<u32> {
        let before = self.last.replace(at.max(self.last.unwrap_or_default()))?;
        let interval_ns = at.ns.saturating_sub(before.ns);
        self.count += 1;
        let distance = interval_ns as f64 - self.mean_ns;
        self.mean_ns += distance / self.count as f64;
        self.squares_ns2 += distance * (interval_ns as f64 - self.mean_ns);
        self.longest_ns = self.longest_ns.max(interval_ns);
        let missed = missed_in(interval_ns, self.period_ns);
        self.missed += u64::from(missed);
        Some(missed)
    }

    /// Nothing is to be drawn for a while: the time until the next frame is no
    /// interval.
    pub fn pause(&mut self) {
        self.last = None;
    }

    /// The figures so far.
    #[must_use]
    pub fn figures(&self) -> FrameFigures {
        FrameFigures {
            valid_frames: self.count,
            mean_period_ns: (self.count > 0).then_some(self.mean_ns),
            jitter_sd_ns: (self.count > 1)
                .then(|| (self.squares_ns2.max(0.0) / (self.count - 1) as f64).sqrt()),
            longest_ns: self.longest_ns,
            missed_frames: self.missed,
        }
    }
}

/// Refreshes without a new frame in an interval.
fn missed_in(interval_ns: u64, period_ns: u64) -> u32 {
    let periods = interval_ns as f64 / period_ns as f64;
    if periods <= LATE_PERIODS {
        return 0;
    }
    // Not negative, and saturating: `as` does both here.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let whole = periods.round() as u32;
    whole - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PERIOD_NS: u64 = 16_666_667;

    fn at(ns: u64) -> SessionTime {
        SessionTime { ns }
    }

    /// The figures of frames this far apart.
    fn figures(period_ns: u64, intervals_ns: &[u64]) -> FrameFigures {
        let mut meter = FrameMeter::new(period_ns);
        let mut now = 1_000_000;
        meter.presented(at(now));
        for interval in intervals_ns {
            now += interval;
            meter.presented(at(now));
        }
        meter.figures()
    }

    #[test]
    fn a_regular_run_has_its_period_and_no_jitter() {
        let run = figures(10, &[10; 500]);
        assert_eq!(
            run,
            FrameFigures {
                valid_frames: 500,
                mean_period_ns: Some(10.0),
                jitter_sd_ns: Some(0.0),
                longest_ns: 10,
                missed_frames: 0,
            }
        );
    }

    #[test]
    fn mean_and_sample_deviation_are_those_of_the_textbook() {
        // 2, 4, 4, 4, 5, 5, 7, 9: mean 5, squared distances 32 in all, 32/7 a degree of freedom.
        let run = figures(6, &[2, 4, 4, 4, 5, 5, 7, 9]);
        assert!((run.mean_period_ns.unwrap() - 5.0).abs() < 1e-12);
        assert!((run.jitter_sd_ns.unwrap() - (32.0_f64 / 7.0).sqrt()).abs() < 1e-12);
        assert_eq!(run.longest_ns, 9);
    }

    #[test]
    fn a_frame_is_late_only_beyond_one_and_a_half_periods() {
        for (interval, missed) in [
            (10, 0),
            (15, 0),
            (16, 1),
            (20, 1),
            (24, 1),
            (26, 2),
            (1000, 99),
        ] {
            assert_eq!(
                figures(10, &[10, interval, 10]).missed_frames,
                missed,
                "{interval}"
            );
        }
    }

    #[test]
    fn a_pause_is_no_interval() {
        let mut meter = FrameMeter::new(10);
        assert_eq!(meter.presented(at(0)), None);
        assert_eq!(meter.presented(at(10)), Some(0));
        meter.pause();
        assert_eq!(meter.presented(at(10_000)), None);
        assert_eq!(meter.presented(at(10_010)), Some(0));
        let run = meter.figures();
        assert_eq!((run.valid_frames, run.missed_frames), (2, 0));
        assert_eq!(run.longest_ns, 10);
    }

    #[test]
    fn one_frame_alone_has_no_figures() {
        let mut meter = FrameMeter::new(10);
        meter.presented(at(5));
        let run = meter.figures();
        assert_eq!((run.valid_frames, run.mean_period_ns), (0, None));
        assert_eq!(run.jitter_sd_ns, None);
    }

    /// Frame times on a grid, each off by less than a quarter of a period; then some
    /// of them late by whole periods.
    fn times(jitter: &[f64], stalls: &[(usize, u64)]) -> Vec<u64> {
        let mut shift = 0;
        jitter
            .iter()
            .enumerate()
            .map(|(frame, jitter)| {
                shift += stalls
                    .iter()
                    .filter(|stall| stall.0 == frame)
                    .map(|stall| stall.1)
                    .sum::<u64>();
                let grid = (frame as u64 + 10 + shift) * PERIOD_NS;
                (grid as f64 + jitter * PERIOD_NS as f64) as u64
            })
            .collect()
    }

    proptest! {
        #[test]
        fn every_stall_is_found_where_it_is_and_nothing_else(
            jitter in prop::collection::vec(-0.2499..0.2499_f64, 2..200),
            stalls in prop::collection::vec((1_usize..200, 1_u64..5), 0..6),
        ) {
            let mut meter = FrameMeter::new(PERIOD_NS);
            let mut missed = vec![0; jitter.len()];
            for (frame, count) in stalls.iter().filter(|stall| stall.0 < jitter.len()) {
                missed[*frame] += count;
            }
            for (frame, time) in times(&jitter, &stalls).into_iter().enumerate() {
                let found = meter.presented(at(time)).map(u64::from);
                prop_assert_eq!(found, (frame > 0).then_some(missed[frame]), "frame {}", frame);
            }
            prop_assert_eq!(meter.figures().missed_frames, missed.iter().sum::<u64>());
        }

        #[test]
        fn late_times_lose_no_precision(start in 0_u64..1 << 60) {
            let mut meter = FrameMeter::new(PERIOD_NS);
            for frame in 0..1000_u64 {
                // Alternately one millisecond early and late: 1 ms from the mean at every frame but one.
                let shift = if frame % 2 == 0 { 0 } else { 1_000_000 };
                meter.presented(at(start + frame * PERIOD_NS + shift));
            }
            let run = meter.figures();
            let sd_ms = run.jitter_sd_ns.unwrap() / 1e6;
            prop_assert!((sd_ms - 1.0).abs() < 1e-3, "{}", sd_ms);
        }
    }
}
