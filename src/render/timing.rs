//! How long a technique takes: the passes that come to its estimate, drawn again and again on
//! the same surfaces.
//!
//! Time is the GPU's own where the adapter has timestamps. Where it has none it is the wall
//! clock's, from handing a frame over until the adapter says that it is done: the price of the
//! hand-over is in it, and passes cannot be told apart.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::pass::Drawable;
use super::plan::PassKind;
use super::recorder::Recorder;
use super::{FrameRequest, Gpu, RenderError, View};

/// What measured the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// Timestamps that the adapter writes before and after each pass.
    GpuTimestamps,
    /// This machine's clock, round handing over a frame and waiting for it.
    WallClock,
}

impl Clock {
    /// For people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::GpuTimestamps => "GPU timestamps",
            Self::WallClock => "wall clock with a fence",
        }
    }
}

/// How long to go on measuring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeats {
    /// Frames that are enough.
    pub frames: u32,
    /// Frames that are measured however long they take.
    pub at_least: u32,
    /// Seconds after which no further frame is begun.
    pub within_s: f64,
    /// Never the GPU's own time, even where it can be had.
    pub wall_clock: bool,
}

/// Seconds of work before anything is measured: shaders are compiled, and the adapter leaves
/// its idle clock. One frame at least.
const WARM_UP_S: f64 = 0.1;

/// What the wall clock measures instead of single passes.
const ALL_PASSES: &str = "all";

/// Times of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct PassTimes {
    /// What measured them.
    pub clock: Clock,
    /// Names of the passes.
    pub passes: Vec<String>,
    /// For each frame what each pass took, milliseconds.
    pub frames_ms: Vec<Vec<f64>>,
}

impl PassTimes {
    /// What each frame took, milliseconds.
    #[must_use]
    pub fn totals_ms(&self) -> Vec<f64> {
        self.frames_ms
            .iter()
            .map(|frame| frame.iter().sum())
            .collect()
    }

    /// What the passes of these names took in each frame, milliseconds; empty where the clock
    /// cannot tell passes apart.
    #[must_use]
    pub fn of_ms(&self, is_meant: impl Fn(&str) -> bool) -> Vec<f64> {
        if self.clock == Clock::WallClock {
            return Vec::new();
        }
        let sum = |frame: &Vec<f64>| {
            let times = self.passes.iter().zip(frame);
            times
                .filter(|(pass, _)| is_meant(pass))
                .map(|(_, ms)| ms)
                .sum()
        };
        self.frames_ms.iter().map(sum).collect()
    }
}

impl View<'_> {
    /// Times the passes of an image that come to its estimate of occlusion: the technique, its
    /// blur, its upsampling. No frames where no pass runs.
    ///
    /// # Errors
    /// As [`View::render`].
    pub fn time_occlusion(
        &mut self,
        request: &FrameRequest,
        repeats: &Repeats,
    ) -> Result<PassTimes, RenderError> {
        let passes = self.estimating(request)?;
        let gpu = self.gpu();
        let clock = match gpu.timestamp_period_ns {
            Some(_) if !repeats.wall_clock => Clock::GpuTimestamps,
            _ => Clock::WallClock,
        };
        let mut times = PassTimes {
            clock,
            passes: names(&passes, clock),
            frames_ms: Vec::new(),
        };
        if passes.is_empty() {
            return Ok(times);
        }
        let started = Instant::now();
        loop {
            frame(gpu, &passes, clock)?;
            if started.elapsed().as_secs_f64() >= WARM_UP_S {
                break;
            }
        }
        let started = Instant::now();
        while times.frames_ms.len() < repeats.frames as usize {
            let is_enough = times.frames_ms.len() >= repeats.at_least.max(1) as usize;
            if is_enough && started.elapsed().as_secs_f64() >= repeats.within_s {
                break;
            }
            times.frames_ms.push(frame(gpu, &passes, clock)?);
        }
        Ok(times)
    }
}

fn names(passes: &[(PassKind, Vec<Drawable>)], clock: Clock) -> Vec<String> {
    match clock {
        Clock::WallClock => vec![ALL_PASSES.to_owned()],
        Clock::GpuTimestamps => passes
            .iter()
            .map(|(kind, _)| kind.name().to_owned())
            .collect(),
    }
}

/// Draws one frame and waits for it: milliseconds by pass, or of all.
fn frame(
    gpu: &Gpu,
    passes: &[(PassKind, Vec<Drawable>)],
    clock: Clock,
) -> Result<Vec<f64>, RenderError> {
    let mut recorder = Recorder::new(gpu, passes.len());
    for (kind, drawables) in passes {
        recorder.pass(*kind, |encoder| {
            for drawable in drawables {
                drawable.draw(encoder);
            }
        });
    }
    let started = Instant::now();
    let records = recorder.finish();
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| RenderError::Device(error.to_string()))?;
    let wall_ms = started.elapsed().as_secs_f64() * 1e3;
    if clock == Clock::WallClock {
        return Ok(vec![wall_ms]);
    }
    let times: Option<Vec<f64>> = records.iter().map(|record| record.gpu_ms).collect();
    times.ok_or_else(|| RenderError::Device(String::from("the adapter gave no pass times")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::testing::{floor_and_wall, renderer, request};

    const FEW: Repeats = Repeats {
        frames: 3,
        at_least: 2,
        within_s: 60.0,
        wall_clock: false,
    };

    fn time(technique: &str, repeats: &Repeats) -> PassTimes {
        let scene = renderer().upload(&floor_and_wall([0.5; 3])).unwrap();
        let mut view = renderer().view(&scene);
        view.time_occlusion(&request(technique), repeats).unwrap()
    }

    #[test]
    fn the_passes_of_the_estimate_are_timed_and_no_others() {
        let times = time("gtao18", &FEW);
        assert_eq!(times.passes, ["occlusion", "blur-rows", "blur-columns"]);
        assert_eq!(times.frames_ms.len(), 3);
        assert!(times.frames_ms.iter().flatten().all(|&ms| ms > 0.0));
        let blur = times.of_ms(|pass| pass.starts_with("blur"));
        let totals = times.totals_ms();
        assert!(totals.iter().zip(&blur).all(|(total, blur)| blur < total));
    }

    #[test]
    fn the_wall_clock_tells_no_passes_apart_and_sees_no_less_than_the_adapter() {
        let wall = Repeats {
            wall_clock: true,
            ..FEW
        };
        let times = time("gtao18", &wall);
        assert_eq!((times.clock, times.passes.len()), (Clock::WallClock, 1));
        assert!(times.of_ms(|_| true).is_empty());
        assert!(times.totals_ms().iter().all(|&ms| ms > 0.0));
    }

    #[test]
    fn what_takes_long_is_measured_no_more_often_than_it_must() {
        let hurried = Repeats {
            frames: 1000,
            within_s: 0.0,
            ..FEW
        };
        assert_eq!(time("gtao18", &hurried).frames_ms.len(), 2);
    }

    #[test]
    fn without_occlusion_there_is_nothing_to_time() {
        assert!(time("none", &FEW).totals_ms().is_empty());
    }
}
