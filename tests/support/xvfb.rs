//! A real X server without a monitor, its pixels, and keys typed into it.

#![allow(dead_code)] // each test file uses its part

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// An X server of its own for one test.
pub struct Xvfb {
    server: Child,
    frame_buffer: tempfile::TempDir,
    /// As `DISPLAY` has it.
    pub display: String,
}

/// A copy of part of the screen: red, green, blue, row by row.
#[derive(Clone, PartialEq, Eq)]
pub struct Pixels {
    pub size_px: [u32; 2],
    pub rgb8: Vec<u8>,
}

impl Pixels {
    pub fn at(&self, x: u32, y: u32) -> [u8; 3] {
        let at = 3 * (y * self.size_px[0] + x) as usize;
        [self.rgb8[at], self.rgb8[at + 1], self.rgb8[at + 2]]
    }
}

/// Why a test with a real window cannot run here; `None` if it can.
pub fn missing() -> Option<String> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let absent = |tool: &&str| !std::env::split_paths(&path).any(|dir| dir.join(tool).exists());
    let tools: Vec<&str> = ["Xvfb", "xdotool"].into_iter().filter(absent).collect();
    (!tools.is_empty()).then(|| format!("{} not installed", tools.join(" and ")))
}

impl Xvfb {
    pub fn start(width_px: u32, height_px: u32) -> Self {
        let frame_buffer = tempfile::tempdir().expect("a temporary folder");
        // Without -noreset the server starts over whenever its last client leaves, and refuses
        // whoever connects just then: the first xdotool would race the application.
        let mut server = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-noreset",
                "-nolisten",
                "tcp",
                "-screen",
                "0",
            ])
            .arg(format!("{width_px}x{height_px}x24"))
            .arg("-fbdir")
            .arg(frame_buffer.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        let stdout = server.stdout.take().expect("stdout is piped");
        BufReader::new(stdout)
            .read_line(&mut number)
            .expect("Xvfb says its number");
        Self {
            server,
            frame_buffer,
            display: format!(":{}", number.trim()),
        }
    }

    /// Part of the screen, from the server's own frame buffer (an X window dump, 32
    /// bits a pixel, blue first).
    pub fn pixels(&self, corner: [u32; 2], size_px: [u32; 2]) -> Pixels {
        let path: PathBuf = self.frame_buffer.path().join("Xvfb_screen0");
        let dump = std::fs::read(path).expect("the frame buffer");
        let word = |index: usize| {
            let bytes = dump[4 * index..4 * index + 4].try_into().expect("4 bytes");
            u32::from_be_bytes(bytes)
        };
        let (width, height, stride) = (word(4), word(5), word(12) as usize);
        assert_eq!(word(11), 32, "bits a pixel");
        assert!(corner[0] + size_px[0] <= width && corner[1] + size_px[1] <= height);
        let start = word(0) as usize + 12 * word(19) as usize;
        let mut rgb8 = Vec::with_capacity(3 * (size_px[0] * size_px[1]) as usize);
        for y in corner[1]..corner[1] + size_px[1] {
            let from = start + y as usize * stride + 4 * corner[0] as usize;
            let row = &dump[from..from + 4 * size_px[0] as usize];
            for pixel in row.chunks_exact(4) {
                rgb8.extend_from_slice(&[pixel[2], pixel[1], pixel[0]]);
            }
        }
        Pixels { size_px, rgb8 }
    }

    /// Runs xdotool; its output.
    pub fn xdotool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool")
            .args(arguments)
            .env("DISPLAY", &self.display)
            .output()
            .expect("xdotool runs");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }
}

impl Drop for Xvfb {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
