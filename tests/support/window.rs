//! The application in a real window on an X server of its own: its pixels, keys
//! and clicks from outside.
#![allow(dead_code)] // each test file uses its part

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use crate::support::Tiny;
use crate::xvfb::{Pixels, Xvfb};

const PATIENCE: Duration = Duration::from_secs(60);

/// Asks until there is an answer.
#[track_caller]
pub fn wait_for<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
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
pub struct Window {
    pub x: Xvfb,
    application: Child,
    pub log: Arc<Mutex<Vec<String>>>,
    id: String,
    pub corner: [u32; 2],
    pub size_px: [u32; 2],
    image_px: [u32; 2],
}

impl Window {
    /// On a screen of 1400 × 1000 pixels.
    pub fn open(study: &Tiny) -> Self {
        Self::open_at(study, 1.0, [1400, 1000])
    }

    /// With so many pixels a point, on a screen of this size.
    pub fn open_at(study: &Tiny, scale: f32, screen_px: [u32; 2]) -> Self {
        let x = Xvfb::start(screen_px[0], screen_px[1]);
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
            .env("WINIT_X11_SCALE_FACTOR", scale.to_string())
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
            image_px: study.size_px(),
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
    pub fn pixels(&self) -> Pixels {
        self.x.pixels(self.corner, self.size_px)
    }

    /// Presses and releases a key.
    pub fn key(&self, key: &str) {
        self.x.xdotool(&["key", "--window", "0", key]);
    }

    /// Clicks the uppermost, leftmost dark button; buttons that are disabled are
    /// not as dark.
    pub fn click_button(&self, what: &str) {
        let [x, y] = wait_for(what, || find_button(&self.pixels()));
        let (x, y) = (self.corner[0] + x, self.corner[1] + y);
        self.x
            .xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
        self.x.xdotool(&["click", "1"]);
    }

    /// Waits until the window shows this picture in its middle, byte for byte, and
    /// grey round it.
    pub fn wait_for_picture(&self, what: &str, rgba8: &[u8]) {
        let expected = self.on_grey(rgba8);
        wait_for(what, || (self.pixels() == expected).then_some(()));
    }

    /// Waits until all of the window is grey.
    pub fn wait_for_grey(&self) {
        let grey = self.on_grey(&[]);
        wait_for("the grey", || (self.pixels() == grey).then_some(()));
    }

    /// What the window should hold: the picture in the middle of grey 128.
    pub fn on_grey(&self, rgba8: &[u8]) -> Pixels {
        let size_px = self.size_px;
        let mut rgb8 = vec![128; 3 * (size_px[0] * size_px[1]) as usize];
        let corner = [0, 1].map(|axis| (size_px[axis] - self.image_px[axis]) / 2);
        for (index, pixel) in rgba8.chunks_exact(4).enumerate() {
            let index = u32::try_from(index).expect("a small picture");
            let (x, y) = (
                corner[0] + index % self.image_px[0],
                corner[1] + index / self.image_px[0],
            );
            let at = 3 * (y * size_px[0] + x) as usize;
            rgb8[at..at + 3].copy_from_slice(&pixel[..3]);
        }
        Pixels { size_px, rgb8 }
    }

    /// From the start page to the page with the pairs.
    pub fn enrol(&self, study: &Tiny) {
        self.x.xdotool(&["type", "P01"]);
        wait_for("the start", || {
            // Nothing starts before the images are checked.
            self.key("Return");
            study.path("results/data").read_dir().ok()?.next().map(drop)
        });
        self.click_button("Begin");
    }

    /// Starts the next pair and waits for its first image.
    pub fn start_pair(&self, first: &[u8]) {
        let expected = self.on_grey(first);
        // The page before may still be there when the button is looked for.
        wait_for("the first image", || {
            let found = self.pixels();
            if found == expected {
                return Some(());
            }
            if let Some([x, y]) = find_button(&found) {
                let (x, y) = (self.corner[0] + x, self.corner[1] + y);
                self.x
                    .xdotool(&["mousemove", &x.to_string(), &y.to_string(), "click", "1"]);
                std::thread::sleep(Duration::from_millis(300));
            }
            None
        });
    }

    /// Processor time used so far by all of its threads, in clock ticks.
    pub fn ticks(&self) -> u64 {
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

/// A point well inside the first run of 100 pixels of the buttons' dark grey.
pub fn find_button(pixels: &Pixels) -> Option<[u32; 2]> {
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
