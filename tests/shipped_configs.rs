//! Every config of the repository is one that `greyfield check` takes, and wrong ones are
//! refused with what is wrong.
#![allow(clippy::expect_used)] // a test ends where something is missing

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn check(path: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .arg("check")
        .arg(path)
        .output()
        .expect("the program runs")
}

fn configs(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == "toml"));
    paths.sort();
    paths
}

#[test]
fn every_shipped_config_passes() {
    for (folder, kind) in [
        ("protocols", "a protocol"),
        ("stimuli", "a stimulus set"),
        ("stimuli/scenes", "a scene"),
    ] {
        let paths = configs(folder);
        assert!(!paths.is_empty());
        for path in paths {
            let output = check(&path);
            let said = String::from_utf8_lossy(&output.stdout);
            let wrong = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{}: {wrong}", path.display());
            assert!(said.contains(kind), "{said}");
        }
    }
}

#[test]
fn a_protocol_whose_parts_do_not_fit_is_refused_with_the_field() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("protocols/yu-2009-reference.toml"));
    let text = text.expect("the protocol").replace(
        "../stimuli/side-by-side.toml",
        &root.join("stimuli/side-by-side.toml").display().to_string(),
    );
    for (from, to, parts) in [
        (
            "technique = \"traced\"",
            "technique = \"trased\"",
            ["no reference", "trased"],
        ),
        (
            "shapes-none-gtao18",
            "shapes-none-gtao",
            ["practice.conditions", "shapes-none-gtao18"],
        ),
        (
            "correct = \"traced\"",
            "correct = \"gtao18\"",
            ["catch.trials.correct", "none, traced"],
        ),
        (
            "minimum_correct = 2",
            "minimum_correct = 4",
            ["catch.minimum_correct", "only 3"],
        ),
        (
            "[reference]\ntechnique = \"traced\"\n",
            "",
            ["reference.technique", "missing"],
        ),
    ] {
        assert!(text.contains(from), "{from:?}");
        let path = folder.path().join("p.toml");
        std::fs::write(&path, text.replace(from, to)).expect("written");
        let output = check(&path);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}
