//! Sessions in a real window, driven from inside: frames, memory, and how soon the
//! grey follows the key. The window's process is this test's own, started again.
#![cfg(all(unix, not(target_os = "macos")))]
#![allow(clippy::expect_used)] // a test ends where something is missing

#[path = "support/booth.rs"]
mod booth;
mod support;
#[path = "support/xvfb.rs"]
mod xvfb;

use std::process::Command;
use std::time::Duration;

use booth::{Booth, Outcome, PERIOD};
use support::{PROTOCOL, Tiny};
use xvfb::Xvfb;

/// Runs one of the windows below in a process of its own, on a display of its own.
fn run(window: &str, seconds: u64) {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: {window} ({missing})");
        return;
    }
    let x = Xvfb::start(1000, 700);
    let status = Command::new(std::env::current_exe().expect("this very test"))
        .args(["--exact", window, "--include-ignored", "--nocapture"])
        .env("DISPLAY", &x.display)
        .env("GREYFIELD_SOAK_SECONDS", seconds.to_string())
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .status()
        .expect("the test starts again");
    assert!(status.success(), "{window}: {status}");
}

#[test]
fn half_a_minute_of_session_keeps_its_times() {
    run("window_of_a_session", 20);
}

#[test]
#[ignore = "ten minutes"]
fn ten_minutes_of_session_keep_their_times() {
    run("window_of_a_session", 600);
}

#[test]
fn memory_stays_flat_over_five_hundred_trials() {
    run("window_of_five_hundred_trials", 0);
}

#[test]
#[ignore = "started by the tests above, with a display"]
fn window_of_a_session() {
    let seconds = std::env::var("GREYFIELD_SOAK_SECONDS").expect("set by the test above");
    let seconds: u64 = seconds.parse().expect("a number");
    // One trial takes 6 seconds: image, grey and image, 2 each.
    let trials = usize::try_from(seconds.div_ceil(6)).expect("few");
    let study = Tiny::new(trials, [640, 360]);
    let look = Duration::from_secs(2);
    // The grey of the second trial has a frame that takes 2.6 periods instead of one.
    let outcome = Booth::new(study, 1, look)
        .with_stall(1, PERIOD.mul_f64(2.6))
        .run();
    assert_eq!(outcome.rows.len(), trials);
    for row in &outcome.rows {
        let grey_ns = row.grey_offset_ns.zip(row.grey_onset_ns);
        let grey_ns = grey_ns.map(|(offset, onset)| offset - onset);
        assert!(grey_ns >= Some(2_000_000_000), "the grey stood {grey_ns:?}");
    }
    let missed: Vec<u64> = outcome
        .rows
        .iter()
        .map(|row| u64::from(row.missed_frames.expect("frames are counted")))
        .collect();
    assert!(missed[1] >= 1, "the late frame is on record: {missed:?}");
    let figures = outcome.figures[0];
    assert_eq!(figures.missed_frames, missed.iter().sum::<u64>());
    // Never faster than the display, however fast the surface is: nothing spins.
    let mean_ns = figures.mean_period_ns.expect("many frames");
    assert!(mean_ns >= 0.99 * PERIOD.as_nanos() as f64, "{figures:?}");
    assert_grey_follows_key(&outcome);
    let sd_ms = figures.jitter_sd_ns.expect("many frames") / 1e6;
    println!(
        "{seconds} s, {trials} trials: {} frames, {} missed (one on purpose), mean {:.3} ms, SD {sd_ms:.3} ms, longest {:.1} ms",
        figures.valid_frames,
        figures.missed_frames,
        mean_ns / 1e6,
        figures.longest_ns as f64 / 1e6
    );
}

/// The key is in one frame's events and the grey in the next frame at best.
fn assert_grey_follows_key(outcome: &Outcome) {
    let longest = outcome.frames_to_grey.iter().max();
    assert!(!outcome.frames_to_grey.is_empty());
    assert!(longest <= Some(&2), "{:?}", outcome.frames_to_grey);
}

#[test]
#[ignore = "started by the tests above, with a display"]
fn window_of_five_hundred_trials() {
    const TRIALS: usize = 25;
    const SESSIONS: usize = 20;
    /// Growth allowed from the fifth session to the last: 375 trials, each of which
    /// would leave 360 KiB behind if its images stayed in memory.
    const ALLOWED_KIB: u64 = 4 * 1024;

    let study = Tiny::new(TRIALS, [256, 180]);
    let short_grey = PROTOCOL.replace("duration_ms = 2000", "duration_ms = 20");
    std::fs::write(study.path("tiny.toml"), short_grey).expect("the protocol");
    let outcome = Booth::new(study, SESSIONS, Duration::ZERO).hurried().run();
    assert_eq!(outcome.rows.len(), SESSIONS * TRIALS);
    println!(
        "resident after each session, KiB: {:?}",
        outcome.resident_kib
    );
    let warm = outcome.resident_kib[4];
    let last = outcome.resident_kib[SESSIONS - 1];
    assert!(last <= warm + ALLOWED_KIB, "{:?}", outcome.resident_kib);
    assert_grey_follows_key(&outcome);
}
