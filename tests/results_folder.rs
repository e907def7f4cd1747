//! What a lab does with a results folder from the command line: who took part, is it in
//! order, and where does it go from here.
#![allow(clippy::unwrap_used)]

mod tiny_study;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use greyfield::record::{read_folder, read_rows};
use serde_json::Value;
use tiny_study::{TRIALS, TinyStudy, stderr, stdout};

fn greyfield(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Four participants and one try-out.
fn results() -> (TinyStudy, PathBuf) {
    let study = TinyStudy::new();
    let results = study.path("results");
    assert!(study.run(&results, "random:1", 4).status.success());
    let mut pilot = study.command(&results, "first", 1);
    assert!(pilot.arg("--pilot").output().unwrap().status.success());
    (study, results)
}

fn participants(results: &Path, arguments: &[&str]) -> Output {
    let mut all = vec!["participants", results.to_str().unwrap()];
    all.extend(arguments);
    greyfield(&all)
}

fn listed(results: &Path) -> Value {
    let output = participants(results, &["--format", "json"]);
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_str(&stdout(&output)).unwrap()
}

#[test]
fn participants_are_listed_rejected_replaced_and_reinstated() {
    let (study, results) = results();
    let text = stdout(&participants(&results, &[]));
    let lines: Vec<Vec<&str>> = text
        .lines()
        .map(|l| l.split_whitespace().collect())
        .collect();
    assert_eq!(lines[1], ["0", "random1p0001", "7/7", "finished"]);
    assert_eq!(lines[5], ["pilot", "0", "firstp0001", "7/7", "finished"]);
    assert!(text.ends_with("takes slot 4\n"), "{text}");

    let decide = |arguments: &[&str]| {
        let output = participants(&results, arguments);
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    let text = decide(&["--reject", "random1p0002", "--reason", "slept"]);
    assert!(text.contains("finished, rejected"), "{text}");
    decide(&["--release", "random1p0002", "--reason", "replaced"]);
    let known = &listed(&results)["participants"][1];
    assert_eq!(known["rejected"]["reason"], "slept");
    assert_eq!(known["released"]["reason"], "replaced");
    assert_eq!(listed(&results)["next_slot"], 1);
    let analysed = stdout(&greyfield(&["analyse", results.to_str().unwrap()]));
    assert!(analysed.contains("3 participants, 21 trials"), "{analysed}");

    assert!(study.run(&results, "random:9", 1).status.success());
    let refused = participants(&results, &["--reinstate", "random1p0002"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        stderr(&refused).contains("held by participant \"random9p0001\""),
        "{}",
        stderr(&refused)
    );
    decide(&["--release", "random9p0001", "--reason", "a mistake"]);
    decide(&["--reinstate", "random1p0002"]);
    assert_eq!(listed(&results)["next_slot"], 4);
    let analysed = stdout(&greyfield(&["analyse", results.to_str().unwrap()]));
    assert!(analysed.contains("5 participants, 35 trials"), "{analysed}");
    let checked = greyfield(&["check", results.to_str().unwrap()]);
    assert!(checked.status.success(), "{}", stdout(&checked));
}

#[test]
fn what_cannot_be_decided_says_why() {
    let (_study, results) = results();
    for (arguments, part) in [
        (&["--reject", "random1p0001"][..], "--reason"),
        (
            &["--reject", "random1p0001", "--reason", " "],
            "at least one word",
        ),
        (
            &["--reject", "nobody", "--reason", "x"],
            "\"nobody\" is not in this study",
        ),
        (
            &["--release", "../x", "--reason", "x"],
            "allowed is a letter or digit",
        ),
        (&["--reinstate", "random1p0001"], "nothing to take back"),
    ] {
        let output = participants(&results, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            stderr(&output).contains(part),
            "{part:?}: {}",
            stderr(&output)
        );
    }
    let nowhere = participants(&results.join("data"), &[]);
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(
        stderr(&nowhere).contains("no study.json"),
        "{}",
        stderr(&nowhere)
    );
}

#[test]
fn every_export_is_made_once_and_the_flat_one_reads_back() {
    let (study, results) = results();
    let export = |format: &str, more: &[&str]| {
        let out = study.path(format);
        let mut arguments = vec!["export", results.to_str().unwrap(), "--to", format];
        arguments.extend(["--out", out.to_str().unwrap()]);
        arguments.extend(more);
        greyfield(&arguments)
    };
    for format in ["psych-ds", "bids", "pwcmp"] {
        let output = export(format, &[]);
        assert!(output.status.success(), "{}", stderr(&output));
        assert!(stderr(&output).contains("7 rows of pilot sessions are left out"));
        let again = export(format, &[]);
        assert_eq!(again.status.code(), Some(2));
        assert!(
            stderr(&again).contains("something in it already"),
            "{}",
            stderr(&again)
        );
    }
    let output = export("csv", &["--include-pilot"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let flat = study.path("csv").join("rows.csv");
    assert_eq!(
        read_rows(&flat).unwrap().rows,
        read_folder(&results).unwrap().rows
    );
    let analysed = stdout(&greyfield(&["analyse", flat.to_str().unwrap()]));
    assert!(analysed.contains("4 participants, 28 trials"), "{analysed}");
    let pwcmp = std::fs::read_to_string(study.path("pwcmp").join("comparisons.csv")).unwrap();
    assert_eq!(pwcmp.lines().count(), 1 + 4 * TRIALS);
    assert_eq!(export("xml", &[]).status.code(), Some(2));
}

/// Exit code 1 and the place, for people and for machines.
#[test]
fn a_check_names_the_line_that_was_changed() {
    let (_study, results) = results();
    let path = results.join("data/study-thesis2010_subject-random1p0003_session-1_data.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let other: Vec<&str> = [&lines[..3], &lines[4..]].concat();
    std::fs::write(&path, other.join("\n") + "\n").unwrap();
    let output = greyfield(&["check", results.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    let place = format!("error: {}:4: trial 2 is missing", path.display());
    assert!(stdout(&output).contains(&place), "{}", stdout(&output));
    let output = greyfield(&["check", results.to_str().unwrap(), "--format", "json"]);
    assert_eq!(output.status.code(), Some(1));
    let report: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(report["findings"][0]["severity"], "error");
    assert_eq!(report["findings"][0]["line"], 4);
    assert_eq!(report["participants"], 5);
    // Only a results folder has such findings.
    let stimuli = results.join("data");
    let refused = greyfield(&["check", stimuli.to_str().unwrap(), "--format", "json"]);
    assert_eq!(refused.status.code(), Some(2));
}
