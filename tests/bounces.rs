//! Light between the points of height maps, through the binary: `greyfield bounces`.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::{Command, Output};

fn bounces(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .current_dir(folder)
        .arg("bounces")
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Maps fitted to and held out, a sweep, a picture of colours: every file is there, and the numbers of
/// the files are those of the terminal.
#[test]
fn a_study_of_small_maps_leaves_every_file() {
    let folder = tempfile::tempdir().unwrap();
    let output = bounces(
        folder.path(),
        &[
            "pebbles",
            "fbm@0.3",
            "--held-out",
            "bricks@0.2",
            "--fit",
            "--amplitudes",
            "0.02,0.2",
            "--size",
            "40",
            "--rays",
            "64",
            "--seed",
            "3",
            "--out",
            "study",
        ],
    );
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}{}", text(&output.stderr));
    assert!(
        said.contains("bricks@0.2, held out") && said.contains("M rays/s"),
        "{said}"
    );
    let study = folder.path().join("study");
    for file in [
        "errors.csv",
        "fits.json",
        "colour-off.png",
        "colour-truth.png",
        "colour-greyfield.png",
        "bounces.html",
        "pebbles/openness.png",
        "pebbles/irradiance-00.png",
        "pebbles/irradiance-sum.png",
        "pebbles/curves.csv",
        "pebbles/bounces.json",
        "fbm@0.3/height.png",
        "bricks@0.2/curves.csv",
    ] {
        assert!(study.join(file).is_file(), "{file}");
    }
    let fits: serde_json::Value =
        serde_json::from_slice(&std::fs::read(study.join("fits.json")).unwrap()).unwrap();
    assert_eq!(fits["held_out"][0], "bricks@0.2");
    let k0 = fits["greyfield"]["k0"].as_f64().unwrap();
    assert!(
        (0.3..3.0).contains(&k0) && said.contains(&format!("{k0:.5}")),
        "{k0} {said}"
    );
    let errors = std::fs::read_to_string(study.join("errors.csv")).unwrap();
    // 3 maps, 7 curves, 11 albedos and all of them.
    assert_eq!(errors.lines().count(), 1 + 3 * 7 * 12, "{errors}");
}

/// The same map and seed, the same bytes.
#[test]
fn a_map_is_followed_the_same_way_twice() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["first", "second"].map(|out| {
        let arguments = [
            "shapes",
            "--size",
            "32",
            "--rays",
            "32",
            "--memory",
            "0.001",
            "--bounces",
            "3",
            "--out",
            out,
        ];
        let output = bounces(folder.path(), &arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        [
            "openness.png",
            "irradiance-01.png",
            "curves.csv",
            "errors.csv",
        ]
        .map(|file| std::fs::read(folder.path().join(out).join(file)).unwrap())
    });
    assert!(files[0] == files[1]);
}

/// What cannot be is said with its name, what was found and what is allowed, and leaves nothing.
#[test]
fn bad_maps_and_settings_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    image::GrayImage::from_pixel(1, 1, image::Luma([9]))
        .save(folder.path().join("one.png"))
        .unwrap();
    image::RgbImage::new(8, 8)
        .save(folder.path().join("colour.png"))
        .unwrap();
    for (arguments, parts) in [
        (&["brick"][..], &["no file brick", "crevices"][..]),
        (&["fbm@high"], &["\"high\"", "fbm@0.2"]),
        (
            &["fbm", "--size", "16384"],
            &["16384×16384", "GiB", "--memory"],
        ),
        (&["fbm", "--albedo", "1.2"], &["1.2", "0 to 1"]),
        (&["fbm", "--albedo", "0.2,0.3"], &["2 numbers"]),
        (
            &[
                "fbm",
                "--size",
                "32",
                "--rays",
                "16",
                "--albedo",
                "colour.png",
            ],
            &["8×8", "32×32"],
        ),
        (&["one.png"], &["one.png", "1×1"]),
        (&["fbm", "--amplitude=-1"], &["amplitude", "-1"]),
        (&["fbm", "--held-out", "nothing"], &["no file nothing"]),
    ] {
        let output = bounces(folder.path(), &[arguments, &["--out", "made"]].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        for part in parts {
            assert!(
                message.contains(part),
                "{arguments:?}: {part:?} is not in {message}"
            );
        }
        assert!(!folder.path().join("made/bounces.html").exists());
    }
    // An even map is no mistake: all of it lies in the open.
    image::GrayImage::from_pixel(16, 16, image::Luma([90]))
        .save(folder.path().join("even.png"))
        .unwrap();
    let output = bounces(folder.path(), &["even.png", "--rays", "16"]);
    assert!(output.status.success());
    assert!(
        text(&output.stderr).contains("even"),
        "{}",
        text(&output.stderr)
    );
    let fitted = bounces(folder.path(), &["even.png", "--rays", "16", "--fit"]);
    assert_eq!(fitted.status.code(), Some(2));
    assert!(
        text(&fitted.stderr).contains("more bins"),
        "{}",
        text(&fitted.stderr)
    );
}
