//! The real thing: the binary in a real window on a real X server, keys and
//! clicks from outside, the window's own pixels read back.
#![allow(clippy::expect_used)] // a test ends where something is missing

mod support;
#[path = "support/window.rs"]
mod window;
#[path = "support/xvfb.rs"]
mod xvfb;

use std::process::Command;
use std::time::Duration;

use greyfield::protocol::Position;
use greyfield::record::read::read_folder;
use support::{PROTOCOL, Tiny};
use window::{Window, find_button, wait_for};
use xvfb::Xvfb;

const SIZE_PX: [u32; 2] = [640, 360];
#[test]
fn a_session_by_keys_and_clicks_in_a_real_window() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: a session in a real window ({missing})");
        return;
    }
    let study = Tiny::new(2, SIZE_PX);
    let short_grey = PROTOCOL.replace("duration_ms = 2000", "duration_ms = 700");
    std::fs::write(study.path("tiny.toml"), short_grey).expect("the protocol");
    let plan = study.plan(0);
    let window = Window::open(&study);

    window.enrol(&study);
    for (trial, answer) in [(0, "2"), (1, "1")] {
        let [first, second] = study.shown(&plan, trial).map(|image| study.rgba8(image));
        window.start_pair(&first);
        window.key("space");
        window.wait_for_grey();
        window.wait_for_picture("the second image", &second);
        window.key("space");
        wait_for("the question", || find_button(&window.pixels()));
        if trial == 0 {
            assert_rest(&window);
        }
        window.key(answer);
        wait_for("the row on disk", || {
            let rows = read_folder(&study.path("results")).expect("the data is readable");
            (rows.rows.len() == trial + 1).then_some(())
        });
    }
    check_rows(&study);
    report_first_frame(&window);
}

/// While a page stands the application comes to rest and uses no processor time
/// at all, to the hundredth of a second that the system counts in.
fn assert_rest(window: &Window) {
    wait_for("a second at rest", || {
        let before = window.ticks();
        std::thread::sleep(Duration::from_secs(1));
        (window.ticks() == before).then_some(())
    });
}

fn check_rows(study: &Tiny) {
    let rows = read_folder(&study.path("results")).expect("the data is readable");
    let responses: Vec<_> = rows.rows.iter().map(|row| row.response).collect();
    assert_eq!(
        responses,
        [Some(Position::Second.into()), Some(Position::First.into())]
    );
    for row in &rows.rows {
        assert_eq!(row.participant_id, "P01");
        let grey_ns = row
            .grey_offset_ns
            .zip(row.grey_onset_ns)
            .map(|(offset, onset)| offset - onset)
            .expect("the grey is on record");
        assert!(grey_ns >= 700_000_000, "the grey stood {grey_ns} ns");
        assert!(row.response_time_ms.expect("a time") > 0.0);
    }
}

/// Printed and not asserted: how long it takes depends on what else runs.
fn report_first_frame(window: &Window) {
    let log = window.log.lock().expect("no thread panics");
    let line = log.iter().find(|line| line.contains("first frame"));
    eprintln!("{}", line.expect("the first frame is logged with -v"));
}

#[test]
fn without_a_display_the_error_names_the_way_out() {
    let study = Tiny::new(1, SIZE_PX);
    for display in ["", ":64999"] {
        let output = Command::new(env!("CARGO_BIN_EXE_greyfield"))
            .args([
                "run",
                "tiny.toml",
                "--results",
                "results",
                "--stimuli",
                "stimuli",
            ])
            .current_dir(study.folder.path())
            .env("DISPLAY", display)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .output()
            .expect("the application runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains("no display"), "{message}");
        assert!(message.contains("--headless"), "{message}");
    }
}

#[test]
fn without_a_vulkan_driver_the_error_names_the_package() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: a window without a Vulkan driver ({missing})");
        return;
    }
    let study = Tiny::new(1, SIZE_PX);
    let x = Xvfb::start(1400, 1000);
    let output = Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .args([
            "run",
            "tiny.toml",
            "--results",
            "results",
            "--stimuli",
            "stimuli",
        ])
        .current_dir(study.folder.path())
        .env("DISPLAY", &x.display)
        .env("XDG_RUNTIME_DIR", study.folder.path())
        // Where the Vulkan loader looks for drivers, under its old and new name.
        .env("VK_ICD_FILENAMES", "/nowhere.json")
        .env("VK_DRIVER_FILES", "/nowhere.json")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the application runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("no graphics adapter"), "{message}");
    assert!(message.contains("mesa-vulkan-drivers"), "{message}");
}
