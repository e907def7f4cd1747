//! `greyfield power` and `greyfield check --preregister` as they are called.
#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

fn greyfield(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap()
}

fn printed(arguments: &[&str]) -> String {
    let output = greyfield(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {message}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let output = greyfield(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

const THESIS: &str = "protocols/thesis-2010.toml";

/// The numbers of `tests/data/power.csv`, filled up to blocks of 14.
#[test]
fn a_study_of_seven_conditions_is_planned() {
    let text = printed(&[
        "power",
        "--p",
        "0.65",
        "--conditions",
        "7",
        "--format",
        "json",
    ]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rows = &json["sections"][0]["tables"]["sample_size"];
    let sizes: Vec<_> = (0..4)
        .map(|row| ["n_first", "n_from", "n_blocks"].map(|key| rows[row][key].as_u64().unwrap()))
        .collect();
    assert_eq!(
        sizes,
        [
            [90, 97, 98],
            [114, 121, 126],
            [139, 146, 154],
            [170, 182, 182]
        ]
    );
    assert_eq!(rows[2]["criterion"], "bonferroni");
    assert_eq!(json["settings"]["participants"], 154);
}

#[test]
fn thirty_six_participants_find_what_they_can() {
    let text = printed(&["power", "--p", "0.65", "--n", "36"]);
    for part in ["0.356", "11 : 25", "12 : 24", "0.609", "0.162"] {
        assert!(text.contains(part), "{part}:\n{text}");
    }
    let csv = printed(&["power", "--p", "0.65", "--n", "36", "--format", "csv"]);
    assert!(
        csv.starts_with("n,p,criterion,alpha,conditions,power\n"),
        "{csv}"
    );
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for (arguments, part) in [
        (&["--p", "1"][..], "0.001 to 0.999"),
        (&["--p", "x"], "a number such as 0.65"),
        (&["--p", "0.6", "--alpha", "1"], "0.999"),
        (&["--p", "0.6", "--conditions", "0"], "1..=100"),
        (&["--p", "0.6", "--power", "0.8,1"], "0.001 to 0.999"),
        (&["--p", "0.6", "--studies", "10"], "name one"),
        (&[THESIS, "--p", "0.6", "--drop-out", "0.95"], "0 to 0.9"),
        (&[THESIS, "--p", "0.6", "--n", "10"], "--n"),
        (
            &["protocols/kozlowski-kautz-2007.toml", "--p", "0.6"],
            "\"rating\"",
        ),
        (
            &["protocols/none.toml", "--p", "0.6"],
            "protocols/none.toml",
        ),
    ] {
        let message = refused(&[&["power"], arguments].concat());
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
}

#[test]
fn studies_of_a_protocol_are_simulated_alike_every_time() {
    let arguments = [
        "power",
        THESIS,
        "--p",
        "0.7",
        "--studies",
        "40",
        "--participant-sd",
        "0.5",
        "--drop-out",
        "0.1",
        "--format",
        "csv",
        "--quiet",
    ];
    let csv = printed(&arguments);
    assert_eq!(csv.lines().count(), 8, "{csv}");
    assert!(csv.contains("dragon-low,crytek24,blizzard24,"), "{csv}");
    assert_eq!(csv, printed(&arguments));
    let more = printed(&[
        "power",
        THESIS,
        "--p",
        "0.7",
        "--studies",
        "5",
        "--full-blocks",
    ]);
    assert!(more.contains("42 participants"), "{more}");
    assert!(more.contains("equally often in both orders"), "{more}");
}

#[test]
fn every_shipped_protocol_can_be_preregistered() {
    for protocol in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/protocols")).unwrap() {
        let path = protocol.unwrap().path();
        let path = path.to_str().unwrap();
        let text = printed(&["check", path, "--preregister"]);
        for part in [
            "## Design plan",
            "### Stopping rule",
            "### Data exclusion",
            "## Other",
        ] {
            assert!(text.contains(part), "{path}: {part}");
        }
        assert_eq!(text, printed(&["check", path, "--preregister"]));
    }
    let message = refused(&["check", "stimuli/thesis-2010.toml", "--preregister"]);
    assert!(message.contains("study_id"), "{message}");
}
