//! A study of pictures made elsewhere, from the files to the analysis, through the binary.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use greyfield::stimulus::Manifest;
use image::{ImageBuffer, Rgb, Rgb32FImage};

const SET: &str = r#"
id = "made"
title = "Made elsewhere"

[[condition]]
id = "hall"
scene = "hall"
validity = "high"
hypothesis = "H1"
first = { file = "pictures/hall-none.png", technique = "none" }
second = { file = "pictures/hall-traced.exr", technique = "path-traced", metadata = { renderer = "by hand" } }

[[condition]]
id = "stairs"
scene = "stairs"
validity = "low"
first = { file = "pictures/stairs-a.png", technique = "a" }
second = { file = "pictures/stairs-b.png", technique = "b" }
"#;

struct Study {
    dir: tempfile::TempDir,
}

impl Study {
    fn new() -> Self {
        let study = Self {
            dir: tempfile::tempdir().unwrap(),
        };
        std::fs::create_dir(study.path("pictures")).unwrap();
        std::fs::write(study.path("made.toml"), SET).unwrap();
        // An 8-bit PNG and an EXR of nearly the same light, and two 16-bit PNG.
        let level = |x: u32| 60 + x as u8;
        image::RgbImage::from_fn(24, 16, |x, _| Rgb([level(x); 3]))
            .save(study.path("pictures/hall-none.png"))
            .unwrap();
        Rgb32FImage::from_fn(24, 16, |x, _| {
            Rgb([((f32::from(level(x)) / 255.0 + 0.055) / 1.055).powf(2.4) * 0.97; 3])
        })
        .save(study.path("pictures/hall-traced.exr"))
        .unwrap();
        for (name, offset) in [("a", 0), ("b", 900)] {
            let wide = |x: u32, y: u32| Rgb([(20_000 + 300 * x + 200 * y) as u16 + offset; 3]);
            ImageBuffer::<Rgb<u16>, _>::from_fn(20, 12, wide)
                .save(study.path(&format!("pictures/stairs-{name}.png")))
                .unwrap();
        }
        let protocol = include_str!("../protocols/thesis-2010.toml")
            .replace("../stimuli/thesis-2010.toml", "made.toml");
        std::fs::write(study.path("protocol.toml"), protocol).unwrap();
        study
    }

    fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn greyfield(&self, args: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_greyfield"))
            .args(args)
            .current_dir(self.dir.path())
            // No adapter at all: a set of files must not need one.
            .env("VK_DRIVER_FILES", "/nonexistent.json")
            .output()
            .unwrap()
    }

    fn succeed(&self, args: &[&str]) -> String {
        let output = self.greyfield(args);
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{args:?}: {message}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Exit code and message.
    fn fail(&self, args: &[&str]) -> (Option<i32>, String) {
        let output = self.greyfield(args);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(!message.contains("panicked"), "{message}");
        (output.status.code(), message)
    }

    fn replace(&self, file: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path(file)).unwrap();
        assert!(text.contains(from));
        std::fs::write(self.path(file), text.replacen(from, to, 1)).unwrap();
    }
}

#[test]
fn from_files_to_analysis_without_an_adapter() {
    let study = Study::new();
    study.succeed(&["import", "made.toml"]);
    let manifest = Manifest::load(&study.path("made")).unwrap();
    assert!(manifest.adapter.is_none());
    let [hall, stairs] = manifest.pairs.as_slice() else {
        panic!("two conditions");
    };
    let source = hall.second.source.as_ref().unwrap();
    assert_eq!(source.file, Path::new("pictures/hall-traced.exr"));
    assert_eq!(
        (source.format.as_str(), source.metadata["renderer"].as_str()),
        ("OpenEXR", "by hand")
    );
    assert_eq!(stairs.first.source.as_ref().unwrap().bits_per_channel, 16);
    assert_ne!(hall.first.sha256, hall.second.sha256);

    // A PNG in 8 bits is shown with the very levels it has.
    let shown = hall.first.load(&study.path("made")).unwrap();
    let source = image::open(study.path("pictures/hall-none.png")).unwrap();
    assert_eq!(shown.rgba8, source.to_rgba8().into_raw());

    study.succeed(&["order", "protocol.toml", "--participants", "2"]);
    study.succeed(&[
        "run",
        "protocol.toml",
        "--results",
        "results",
        "--headless",
        "--observer",
        "first",
        "--participants",
        "12",
    ]);
    let report = study.succeed(&["analyse", "results"]);
    for part in ["hall", "stairs", "path-traced"] {
        assert!(report.contains(part), "{report}");
    }
    study.succeed(&["check", "made", "--set", "made.toml"]);
}

#[test]
fn check_finds_what_changed() {
    let study = Study::new();
    study.succeed(&["render", "made.toml"]);
    study.succeed(&["check", "made"]);

    // A source that was edited after it was converted.
    let source = study.path("pictures/stairs-a.png");
    std::fs::copy(study.path("pictures/stairs-b.png"), &source).unwrap();
    let (code, message) = study.fail(&["check", "made", "--set", "made.toml"]);
    assert_eq!(code, Some(1));
    assert!(
        message.contains("stairs-a.png") && message.contains("changed"),
        "{message}"
    );

    // Both images the same: converted, with a warning.
    let output = study.greyfield(&["render", "made.toml"]);
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("nothing to judge"));

    // Two folders with other pixels.
    study.succeed(&["render", "made.toml", "--out", "again"]);
    study.succeed(&["check", "made", "--against", "again"]);
    image::RgbImage::from_pixel(20, 12, Rgb([90; 3]))
        .save(&source)
        .unwrap();
    study.succeed(&["render", "made.toml", "--out", "other"]);
    let (code, message) = study.fail(&[
        "check",
        "made",
        "--against",
        "other",
        "--diff",
        "differences",
    ]);
    assert_eq!(code, Some(1));
    assert!(
        message.contains("1 of 4 images") && message.contains("stairs"),
        "{message}"
    );
    assert!(study.path("differences/stairs--a.png").is_file());

    // An image that is no longer the one that was made, and a set that says something else.
    std::fs::copy(
        study.path("made/hall--none.png"),
        study.path("made/hall--path-traced.png"),
    )
    .unwrap();
    let (code, message) = study.fail(&["check", "made"]);
    assert_eq!(code, Some(1));
    assert!(message.contains("hall--path-traced.png"), "{message}");
    study.replace("made.toml", "\"high\"", "\"higher\"");
    let (code, message) = study.fail(&["check", "again", "--set", "made.toml"]);
    assert_eq!(
        (code, message.contains("has changed since")),
        (Some(1), true),
        "{message}"
    );
}

#[test]
fn wrong_pictures_are_refused_in_one_message() {
    let study = Study::new();
    study.replace("made.toml", "stairs-b.png", "hall-none.png");
    let (code, message) = study.fail(&["render", "made.toml"]);
    assert_eq!(code, Some(2));
    for part in ["stairs", "20×12", "24×16"] {
        assert!(message.contains(part), "{message}");
    }
    let study = Study::new();
    let whole = std::fs::read(study.path("pictures/hall-traced.exr")).unwrap();
    std::fs::write(
        study.path("pictures/hall-traced.exr"),
        &whole[..whole.len() / 2],
    )
    .unwrap();
    let (code, message) = study.fail(&["render", "made.toml"]);
    assert_eq!((code, message.lines().count()), (Some(2), 1), "{message}");
    assert!(message.contains("hall-traced.exr"), "{message}");
    // Nothing half made is left to be taken for a set.
    assert!(!study.path("made/manifest.json").exists());
}

#[test]
fn a_manifest_from_before_loaded_images_is_still_read() {
    let study = Study::new();
    study.succeed(&["render", "made.toml"]);
    let path = study.path("made/manifest.json");
    let mut manifest: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    for pair in manifest["pairs"].as_array_mut().unwrap() {
        for which in ["first", "second"] {
            pair[which]
                .as_object_mut()
                .unwrap()
                .remove("source")
                .unwrap();
        }
    }
    std::fs::write(&path, manifest.to_string()).unwrap();
    let read = Manifest::load(&study.path("made")).unwrap();
    assert!(read.images().all(|image| image.source.is_none()));
    study.succeed(&["check", "made"]);
}
