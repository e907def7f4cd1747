//! The main job through the binary: render, session, analysis, on the embedded study at a
//! small size.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use greyfield::embedded;
use greyfield::stimulus::Manifest;

fn greyfield(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_greyfield"));
    command.args(args);
    command
}

fn succeed(mut command: Command) -> String {
    let output = command.output().unwrap();
    assert!(
        output.status.success(),
        "{command:?} failed:\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

/// Exit code and message of a command that must fail.
fn fail(mut command: Command) -> (i32, String) {
    let Output { status, stderr, .. } = command.output().unwrap();
    let message = String::from_utf8(stderr).unwrap();
    assert!(!message.contains("panicked"), "{message}");
    (status.code().unwrap(), message)
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The embedded study with images of 160×90 pixels.
fn small_study(folder: &Path) -> (PathBuf, PathBuf) {
    embedded::unpack(folder).unwrap();
    let set = folder.join(embedded::STIMULI);
    let config = std::fs::read_to_string(&set)
        .unwrap()
        .replace("width_px = 1280", "width_px = 160")
        .replace("height_px = 720", "height_px = 90");
    std::fs::write(&set, config).unwrap();
    (set, folder.join(embedded::PROTOCOL))
}

fn files_of(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|entry| {
            (
                entry.file_name().into_string().unwrap(),
                std::fs::read(entry.path()).unwrap(),
            )
        })
        .collect()
}

#[test]
fn render_session_analysis() {
    let dir = tempfile::tempdir().unwrap();
    let (set, protocol) = small_study(dir.path());
    let (first, second) = (dir.path().join("first"), dir.path().join("second"));

    succeed(greyfield(&["render", text(&set), "--out", text(&first)]));
    let manifest = Manifest::load(&first).unwrap();
    manifest.verify(&first).unwrap();
    assert_eq!(manifest.pairs.len(), 7);
    for pair in &manifest.pairs {
        assert_ne!(
            pair.first.sha256, pair.second.sha256,
            "{}: two equal images",
            pair.condition
        );
        for image in [&pair.first, &pair.second] {
            let has_occlusion = image.passes.iter().any(|pass| pass.pass == "occlusion");
            assert_eq!(
                has_occlusion,
                image.technique != "none",
                "{}",
                image.file.display()
            );
        }
    }

    // The same config, seed and adapter: the same bytes.
    succeed(greyfield(&["render", text(&set), "--out", text(&second)]));
    let (mut again, mut images) = (files_of(&second), files_of(&first));
    assert_eq!(images.len(), 15);
    assert!(again.remove("manifest.json").is_some() && images.remove("manifest.json").is_some());
    assert!(images == again, "a second render gave other bytes");

    // One condition drawn again joins the others.
    let only = [
        "render",
        text(&set),
        "--out",
        text(&first),
        "--only",
        "dragon-low",
    ];
    succeed(greyfield(&only));
    assert_eq!(Manifest::load(&first).unwrap().pairs.len(), 7);

    let results = dir.path().join("results");
    let run = |observer: &str, participants: &str| {
        let mut command = greyfield(&["run", text(&protocol), "--stimuli", text(&first)]);
        command.args(["--results", text(&results), "--headless"]);
        command.args(["--observer", observer, "--participants", participants]);
        command
    };
    succeed(run("first", "28"));

    // An observer who always takes the first image: over 28 participants every pair was
    // seen 14 times in each order, so every count is 14 to 14 and every p is 1.
    let json = succeed(greyfield(&["analyse", text(&results), "--format", "json"]));
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    let conditions = report["conditions"].as_array().unwrap();
    assert_eq!(conditions.len(), 7);
    for condition in conditions {
        assert_eq!(
            (&condition["votes_a"], &condition["votes_b"]),
            (&14.into(), &14.into())
        );
        assert_eq!(
            (&condition["chose_first"], &condition["chose_second"]),
            (&28.into(), &0.into())
        );
        assert_eq!(condition["p_exact"], 1.0);
    }
    let table = succeed(greyfield(&["analyse", text(&results)]));
    assert!(table.contains("sponza-moderate-h1"), "{table}");
}

#[test]
fn an_altered_image_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let (set, protocol) = small_study(dir.path());
    let stimuli = dir.path().join("images");
    succeed(greyfield(&[
        "render",
        text(&set),
        "--out",
        text(&stimuli),
        "--only",
        "dragon-low",
    ]));
    let image = stimuli.join("dragon-low--crytek24.png");
    let whole = std::fs::read(&image).unwrap();
    let results = dir.path().join("results");
    let run = || {
        let mut command = greyfield(&["run", text(&protocol), "--stimuli", text(&stimuli)]);
        command.args(["--results", text(&results), "--headless"]);
        command.args(["--observer", "first", "--participants", "1"]);
        fail(command)
    };

    std::fs::write(&image, &whole[..whole.len() / 2]).unwrap();
    let (code, message) = run();
    assert_eq!(code, 2, "{message}");
    assert!(
        message.contains("dragon-low--crytek24.png") && message.contains("damaged"),
        "{message}"
    );

    std::fs::write(
        &image,
        std::fs::read(stimuli.join("dragon-low--blizzard24.png")).unwrap(),
    )
    .unwrap();
    let (code, message) = run();
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("changed"), "{message}");

    std::fs::remove_file(&image).unwrap();
    let (code, message) = run();
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("dragon-low--crytek24.png"), "{message}");
    assert!(!results.join("data").exists(), "a refused study left data");
}

#[test]
fn wrong_input_is_one_clear_message() {
    let dir = tempfile::tempdir().unwrap();
    let (set, _) = small_study(dir.path());

    let (code, message) = fail(greyfield(&["render", "no/such.toml"]));
    assert_eq!(code, 2);
    assert!(message.contains("no/such.toml"), "{message}");

    let (code, message) = fail(greyfield(&["render", text(&set), "--only", "dragon-lou"]));
    assert_eq!(code, 2);
    assert!(
        message.contains("dragon-lou") && message.contains("dragon-low"),
        "{message}"
    );

    let (code, message) = fail(greyfield(&[
        "render",
        text(&set),
        "--adapter",
        "no such card",
    ]));
    assert_eq!(code, 1);
    assert!(message.contains("no such card"), "{message}");

    // A file where the folder of images should be.
    let taken = dir.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    let (code, message) = fail(greyfield(&["render", text(&set), "--out", text(&taken)]));
    assert_eq!(code, 1);
    assert!(message.contains("taken"), "{message}");

    let config = std::fs::read_to_string(&set).unwrap();
    std::fs::write(&set, config.replacen("crytek24", "crytec24", 1)).unwrap();
    let (code, message) = fail(greyfield(&["render", text(&set)]));
    assert_eq!(code, 2);
    let parts = [
        "thesis-2010.toml:",
        "condition[0].first",
        "crytec24",
        "crytek24",
    ];
    assert!(parts.iter().all(|part| message.contains(part)), "{message}");
}

#[test]
#[cfg(target_os = "linux")]
fn without_an_adapter_the_package_to_install_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let (set, _) = small_study(dir.path());
    let mut command = greyfield(&["render", text(&set)]);
    command
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent");
    let (code, message) = fail(command);
    assert_eq!(code, 1);
    assert!(message.contains("mesa-vulkan-drivers"), "{message}");
}

#[test]
fn explain_draws_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let (set, _) = small_study(dir.path());
    let plan = succeed(greyfield(&[
        "render",
        text(&set),
        "--explain",
        "--only",
        "sponza-moderate-h1",
    ]));
    let [none, blizzard] = plan.split("\nblizzard24\n").collect::<Vec<_>>()[..] else {
        panic!("two plans are expected:\n{plan}");
    };
    let parts = |plan: &'_ str| -> (bool, bool) {
        let (runs, left_out) = plan.split_once("left out:").unwrap();
        let names = |part: &str| part.contains("─ occlusion  ");
        (names(runs), names(left_out))
    };
    assert_eq!(parts(none), (false, true), "{plan}");
    assert_eq!(parts(blizzard), (true, false), "{plan}");
    assert!(!set.with_file_name("thesis-2010").exists());
}
