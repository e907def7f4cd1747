//! A study of seven pairs of tiny images, and the binary that runs it.
#![allow(dead_code)] // each test file uses its part

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use greyfield::digest;
use greyfield::record::TrialRow;
use greyfield::stimulus::manifest::{FILE_NAME, ImageRecord, Manifest, PairRecord, SCHEMA_VERSION};
use tempfile::TempDir;

/// Seven conditions, as in the thesis.
pub const TRIALS: usize = 7;

/// Protocol, images and room for results, gone with the value.
pub struct TinyStudy {
    folder: TempDir,
}

impl TinyStudy {
    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let thesis = include_str!("../../protocols/thesis-2010.toml");
        let protocol = thesis.replace("../stimuli/thesis-2010.toml", "set.toml");
        std::fs::write(folder.path().join("protocol.toml"), protocol).unwrap();
        std::fs::write(folder.path().join("set.toml"), set()).unwrap();
        let stimuli = folder.path().join("images");
        std::fs::create_dir(&stimuli).unwrap();
        let manifest = Manifest {
            schema_version: SCHEMA_VERSION,
            set_id: "tiny".to_owned(),
            config_sha256: "0".repeat(64),
            seed: 0,
            app_version: "test".to_owned(),
            adapter: None,
            pairs: (0..7_u8).map(|index| pair(&stimuli, index)).collect(),
        };
        let text = serde_json::to_string_pretty(&manifest).unwrap();
        std::fs::write(stimuli.join(FILE_NAME), text).unwrap();
        Self { folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `greyfield run … --headless`, not started yet.
    pub fn command(&self, results: &Path, observer: &str, participants: u32) -> Command {
        let mut command = self.command_without_stimuli(results, observer, participants);
        command.arg("--stimuli").arg(self.path("images"));
        command
    }

    /// The same, with the images where `greyfield render` would put them.
    pub fn command_without_stimuli(
        &self,
        results: &Path,
        observer: &str,
        participants: u32,
    ) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_greyfield"));
        command
            .arg("run")
            .arg(self.path("protocol.toml"))
            .arg("--results")
            .arg(results)
            .args(["--headless", "--format", "json", "--observer", observer])
            .args(["--participants", &participants.to_string()]);
        command
    }

    /// Runs it to its end.
    pub fn run(&self, results: &Path, observer: &str, participants: u32) -> Output {
        self.command(results, observer, participants)
            .output()
            .unwrap()
    }
}

/// A stimulus set of the same conditions, for what needs no images.
fn set() -> String {
    use std::fmt::Write;
    let head = "id = \"tiny\"\ntitle = \"Tiny\"\nseed = 1\nwidth_px = 4\nheight_px = 3\n";
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/stimuli/scenes/atrium.toml");
    (0..TRIALS).fold(head.to_owned(), |mut text, index| {
        let condition =
            format!("id = \"condition-{index}\"\nscene = {scene:?}\nlighting = \"low\"");
        let techniques = "first = \"none\"\nsecond = \"blizzard24\"";
        writeln!(text, "[[condition]]\n{condition}\n{techniques}").unwrap();
        text
    })
}

fn pair(folder: &Path, index: u8) -> PairRecord {
    PairRecord {
        condition: format!("condition-{index}"),
        scene: "tiny".to_owned(),
        validity: "low".to_owned(),
        hypothesis: "H1".to_owned(),
        first: image(folder, index, 0, "none"),
        second: image(folder, index, 1, "blizzard24"),
    }
}

fn image(folder: &Path, index: u8, which: u8, technique: &str) -> ImageRecord {
    let file = format!("condition-{index}-{technique}.png");
    let path = folder.join(&file);
    let pixel = image::Rgb([index * 10, which * 200, 128]);
    image::RgbImage::from_pixel(4, 3, pixel)
        .save(&path)
        .unwrap();
    ImageRecord {
        file: file.into(),
        sha256: digest::sha256_file(&path).unwrap(),
        width_px: 4,
        height_px: 3,
        technique: technique.to_owned(),
        parameters: std::collections::BTreeMap::new(),
        passes: Vec::new(),
        source: None,
    }
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The ids of the rows a run has said to be on disk.
pub fn acknowledged(stdout: &str) -> Vec<String> {
    stdout
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .filter(|event| event["event"] == "stored")
        .map(|event| event["row_id"].as_str().unwrap().to_owned())
        .collect()
}

/// A row without what may differ between an interrupted and an uninterrupted run:
/// the segment, its clock and the wall clock.
pub fn what_was_asked_and_answered(row: &TrialRow) -> TrialRow {
    TrialRow {
        segment: 1,
        first_onset_ns: None,
        first_offset_ns: None,
        grey_onset_ns: None,
        grey_offset_ns: None,
        second_onset_ns: None,
        second_offset_ns: None,
        question_onset_ns: None,
        response_ns: None,
        resume_gap_ms: None,
        answered_utc: String::new(),
        ..row.clone()
    }
}
