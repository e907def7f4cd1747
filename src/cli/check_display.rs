//! `greyfield check --display`: does this display keep time?

use std::time::Duration;

use anyhow::anyhow;

use super::Failure;
use crate::app::display_check;
use crate::protocol::DisplayRequirements;
use crate::session::display_gate::FrameTimes;
use crate::session::{DisplayFigures, Verdict};

/// Measures the display in a window for `seconds` at least, and prints what was
/// found.
///
/// # Errors
/// Exit code 1 if the display is refused, or no window can be opened.
pub fn run(seconds: f64, windowed: bool) -> Result<(), Failure> {
    let asked = DisplayRequirements {
        // Whoever asks for a window does not want to hear that it is one.
        full_screen: !windowed,
        ..DisplayRequirements::default()
    };
    let at_least = Duration::try_from_secs_f64(seconds)
        .map_err(|error| Failure::bad_input(anyhow!("--seconds {seconds}: {error}")))?;
    let Some((figures, verdict)) = display_check::run(asked, at_least, windowed)? else {
        return Err(anyhow!("the window was closed before the display was measured").into());
    };
    print!("{}", table(&figures));
    say(&verdict)
}

fn say(verdict: &Verdict) -> Result<(), Failure> {
    let shortfalls: Vec<String> = verdict
        .shortfalls()
        .iter()
        .map(ToString::to_string)
        .collect();
    if verdict.is_refused() {
        return Err(anyhow!("this display is refused: {}", shortfalls.join("; ")).into());
    }
    for shortfall in &shortfalls {
        eprintln!("warning: {shortfall}");
    }
    println!("Good enough for a session.");
    Ok(())
}

fn table(figures: &DisplayFigures) -> String {
    let number = |value: Option<f64>, unit: &str| {
        value.map_or_else(
            || String::from("unknown"),
            |value| format!("{value:.3} {unit}"),
        )
    };
    let size = |px: [u32; 2]| format!("{} × {} px", px[0], px[1]);
    let yes = |is: bool| String::from(if is { "yes" } else { "no" });
    let times = match figures.method {
        FrameTimes::PresentCall => "when the call that hands them over returned",
        FrameTimes::Timer => "a timer: the surface does not wait for the display",
    };
    let lines = [
        ("mean refresh rate", number(figures.mean_refresh_hz, "Hz")),
        (
            "stated refresh rate",
            number(figures.stated_refresh_hz, "Hz"),
        ),
        ("told refresh rate", number(figures.told_refresh_hz, "Hz")),
        ("jitter (SD)", number(figures.jitter_sd_ms, "ms")),
        ("longest frame", number(Some(figures.longest_ms), "ms")),
        ("frames measured", figures.valid_frames.to_string()),
        ("frames missed", figures.missed.to_string()),
        ("times of frames", times.to_owned()),
        ("window", size(figures.window_px)),
        (
            "monitor",
            figures
                .monitor_px
                .map_or_else(|| String::from("unknown"), size),
        ),
        ("scale factor", figures.scale_factor.to_string()),
        ("covers the monitor", yes(figures.full_screen)),
        ("keyboard focus", yes(figures.focused)),
    ];
    lines
        .iter()
        .map(|(name, value)| format!("{name:<20} {value}\n"))
        .collect()
}
