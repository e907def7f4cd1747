//! The real thing: the binary in a real window on a real X server, keys and
//! clicks from outside, the window's own pixels read back.
#![allow(clippy::expect_used)] // a test ends where something is missing

mod support;
#[path = "support/xvfb.rs"]
mod xvfb;

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use greyfield::protocol::Position;
use greyfield::record::read::read_folder;
use support::{PROTOCOL, Tiny};
use xvfb::{Pixels, Xvfb};

const SIZE_PX: [u32; 2] = [640, 360];
const PATIENCE: Duration = Duration::from_secs(60);

/// Asks until there is an answer.
#[track_caller]
fn wait_for<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let deadline = Instant::now() + PATIENCE;
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(Instant::now() < deadline, "never came: {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The application in a window, killed with the test.
struct Window {
    x: Xvfb,
    application: Child,
    log: Arc<Mutex<Vec<String>>>,
    id: String,
    corner: [u32; 2],
    size_px: [u32; 2],
}

impl Window {
    fn open(study: &Tiny) -> Self {
        let x = Xvfb::start(1400, 1000);
        let mut application = Command::new(env!("CARGO_BIN_EXE_greyfield"))
            .args([
                "run",
                "tiny.toml",
                "--results",
                "results",
                "--stimuli",
                "stimuli",
            ])
            .args(["--windowed", "-v"])
            .current_dir(study.folder.path())
            .env("DISPLAY", &x.display)
            .env("XDG_RUNTIME_DIR", study.folder.path())
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .stderr(Stdio::piped())
            .spawn()
            .expect("the application starts");
        let log: Arc<Mutex<Vec<String>>> = Arc::default();
        let stderr = application.stderr.take().expect("stderr is piped");
        let lines = Arc::clone(&log);
        std::thread::spawn(move || {
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                lines.lock().expect("no thread panics").push(line);
            }
        });
        let mut window = Self {
            x,
            application,
            log,
            id: String::new(),
            corner: [0; 2],
            size_px: [0; 2],
        };
        window.id = wait_for("a window", || window.find());
        window.x.xdotool(&["windowfocus", &window.id]);
        window.measure();
        window
    }

    fn find(&mut self) -> Option<String> {
        if let Some(status) = self.application.try_wait().expect("the process is ours") {
            let log = self.log.lock().expect("no thread panics").join("\n");
            panic!("the application ended with {status}:\n{log}");
        }
        let found = self
            .x
            .xdotool(&["search", "--onlyvisible", "--name", "Greyfield"]);
        found.lines().next().map(String::from)
    }

    fn measure(&mut self) {
        let geometry = self.x.xdotool(&["getwindowgeometry", "--shell", &self.id]);
        let value = |name: &str| {
            let line = geometry.lines().find_map(|line| line.strip_prefix(name));
            line.and_then(|number| number.parse::<u32>().ok())
                .expect("a number")
        };
        self.corner = [value("X="), value("Y=")];
        self.size_px = [value("WIDTH="), value("HEIGHT=")];
    }

    /// The window's own pixels.
    fn pixels(&self) -> Pixels {
        let screen = self.x.screen();
        let [width, height] = self.size_px;
        let rgb8 = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .flat_map(|(x, y)| screen.at(self.corner[0] + x, self.corner[1] + y))
            .collect();
        Pixels {
            size_px: self.size_px,
            rgb8,
        }
    }

    fn key(&self, key: &str) {
        self.x.xdotool(&["key", "--window", "0", key]);
    }

    /// Clicks the uppermost, leftmost dark button; buttons that are disabled are
    /// not as dark.
    fn click_button(&self, what: &str) {
        let [x, y] = wait_for(what, || find_button(&self.pixels()));
        let (x, y) = (self.corner[0] + x, self.corner[1] + y);
        self.x
            .xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
        self.x.xdotool(&["click", "1"]);
    }

    /// Waits until the window shows this picture in its middle, byte for byte, and
    /// grey round it.
    fn wait_for_picture(&self, what: &str, rgba8: &[u8]) {
        let expected = on_grey(self.size_px, rgba8);
        wait_for(what, || (self.pixels() == expected).then_some(()));
    }

    fn wait_for_grey(&self) {
        let grey = on_grey(self.size_px, &[]);
        wait_for("the grey", || (self.pixels() == grey).then_some(()));
    }

    /// Processor time used so far by all of its threads, in clock ticks.
    fn ticks(&self) -> u64 {
        let path = format!("/proc/{}/stat", self.application.id());
        let stat = std::fs::read_to_string(path).expect("the process is there");
        // Fields 14 and 15, counted after the name, which may hold anything.
        let after = stat.rsplit(')').next().unwrap_or_default();
        let fields: Vec<&str> = after.split_whitespace().collect();
        let number = |field: usize| fields[field - 3].parse::<u64>().expect("a number");
        number(14) + number(15)
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.application.kill();
        let _ = self.application.wait();
    }
}

/// What the window should hold: the picture in the middle of grey 128.
fn on_grey(size_px: [u32; 2], rgba8: &[u8]) -> Pixels {
    let mut rgb8 = vec![128; 3 * (size_px[0] * size_px[1]) as usize];
    let corner = [0, 1].map(|axis| (size_px[axis] - SIZE_PX[axis]) / 2);
    for (index, pixel) in rgba8.chunks_exact(4).enumerate() {
        let index = u32::try_from(index).expect("a small picture");
        let (x, y) = (
            corner[0] + index % SIZE_PX[0],
            corner[1] + index / SIZE_PX[0],
        );
        let at = 3 * (y * size_px[0] + x) as usize;
        rgb8[at..at + 3].copy_from_slice(&pixel[..3]);
    }
    Pixels { size_px, rgb8 }
}

/// A point well inside the first run of 100 pixels of the buttons' dark grey.
fn find_button(pixels: &Pixels) -> Option<[u32; 2]> {
    const RUN: u32 = 100;
    let [width, height] = pixels.size_px;
    for y in 0..height.saturating_sub(8) {
        let mut run = 0;
        for x in 0..width {
            run = if pixels.at(x, y) == [45; 3] {
                run + 1
            } else {
                0
            };
            if run == RUN {
                return Some([x - RUN / 2, y + 8]);
            }
        }
    }
    None
}

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

    window.x.xdotool(&["type", "P01"]);
    wait_for("the start", || {
        // Nothing starts before the images are checked.
        window.key("Return");
        study.path("results/data").read_dir().ok()?.next().map(drop)
    });
    window.click_button("Begin");
    for (trial, answer) in [(0, "2"), (1, "1")] {
        let [first, second] = study.shown(&plan, trial).map(|image| study.rgba8(image));
        // The page before may still be there when the button is looked for.
        wait_for("the first image", || {
            let standing = window.pixels() == on_grey(window.size_px, &first);
            if !standing && let Some([x, y]) = find_button(&window.pixels()) {
                let (x, y) = (window.corner[0] + x, window.corner[1] + y);
                window
                    .x
                    .xdotool(&["mousemove", &x.to_string(), &y.to_string(), "click", "1"]);
                std::thread::sleep(Duration::from_millis(300));
            }
            standing.then_some(())
        });
        if trial == 0 {
            assert_rest(&window);
        }
        window.key("space");
        window.wait_for_grey();
        window.wait_for_picture("the second image", &second);
        window.key("space");
        wait_for("the question", || find_button(&window.pixels()));
        window.key(answer);
        wait_for("the row on disk", || {
            let rows = read_folder(&study.path("results")).expect("the data is readable");
            (rows.rows.len() == trial + 1).then_some(())
        });
    }
    check_rows(&study);
    report_first_frame(&window);
}

/// While an image stands the application comes to rest and uses no processor time
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
