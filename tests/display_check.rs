//! `greyfield check --display` on a real X server.
#![allow(clippy::expect_used)] // a test ends where something is missing

#[path = "support/xvfb.rs"]
mod xvfb;

use std::process::{Command, Output};

use xvfb::Xvfb;

fn check(display: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .args(["check", "--display", "--seconds", "0.5"])
        .args(arguments)
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the application runs")
}

/// The value of a line of the table.
fn value<'a>(table: &'a str, name: &str) -> &'a str {
    let line = table.lines().find_map(|line| line.strip_prefix(name));
    line.unwrap_or_else(|| panic!("{name:?} not in {table}"))
        .trim()
}

#[test]
fn the_display_is_measured_over_the_whole_screen() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: measuring a display ({missing})");
        return;
    }
    let x = Xvfb::start(800, 600);
    let output = check(&x.display, &[]);
    let table = String::from_utf8_lossy(&output.stdout);
    let message = String::from_utf8_lossy(&output.stderr);
    eprintln!("{table}{message}");
    let frames: u32 = value(&table, "frames measured").parse().expect("a number");
    assert!(frames >= 50, "{table}");
    assert_eq!(value(&table, "window"), "800 × 600 px");
    assert_eq!(value(&table, "monitor"), "800 × 600 px");
    assert_eq!(value(&table, "covers the monitor"), "yes");
    let hz = |name: &str| -> f64 {
        let number = value(&table, name).strip_suffix(" Hz").expect("in hertz");
        number.parse().expect("a number")
    };
    // However busy the machine is, frames never come faster than the display shows them.
    assert!((1.0..63.0).contains(&hz("mean refresh rate")), "{table}");
    // The server's own clock does not depend on ours.
    assert!((hz("told refresh rate") - 60.0).abs() < 3.0, "{table}");
    // How regular the frames are depends on what else runs; the verdict follows it.
    let jitter = value(&table, "jitter (SD)").strip_suffix(" ms");
    let jitter_ms: f64 = jitter.expect("in ms").parse().expect("a number");
    let focused = value(&table, "keyboard focus") == "yes";
    let good = jitter_ms <= 2.0 && focused;
    assert_eq!(output.status.code(), Some(i32::from(!good)), "{message}");
    assert_eq!(table.contains("Good enough"), good, "{table}");
    assert_eq!(message.contains("refused"), !good, "{message}");
    assert_eq!(message.contains("varies by"), jitter_ms > 2.0, "{message}");
}

#[test]
fn a_window_is_checked_as_a_window() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: measuring a display in a window ({missing})");
        return;
    }
    let x = Xvfb::start(1500, 1000);
    let output = check(&x.display, &["--windowed"]);
    let table = String::from_utf8_lossy(&output.stdout);
    assert_eq!(value(&table, "window"), "1280 × 800 px", "{table}");
    assert_eq!(value(&table, "covers the monitor"), "no");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!message.contains("cover the screen"), "{message}");
}

#[test]
fn without_a_display_there_is_nothing_to_check() {
    let output = check(":64999", &[]);
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("no display"), "{message}");
}
