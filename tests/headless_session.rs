//! The binary runs whole studies without a window.
#![allow(clippy::unwrap_used)]

mod tiny_study;

use std::collections::BTreeSet;
use std::process::Command;

use greyfield::protocol::Position;
use greyfield::record::read_folder;
use tiny_study::{TRIALS, TinyStudy, stderr, stdout};

#[test]
fn a_block_of_fourteen_balances_places_and_inner_orders() {
    let study = TinyStudy::new();
    let results = study.path("results");
    let output = study.run(&results, "random:1", 14);
    assert!(output.status.success(), "{}", stderr(&output));
    let read = read_folder(&results).unwrap();
    assert_eq!(read.warnings, []);
    assert_eq!(read.rows.len(), 14 * TRIALS);
    for condition in (0..TRIALS).map(|index| format!("condition-{index}")) {
        for place in 0..7 {
            let techniques: Vec<&str> = read
                .rows
                .iter()
                .filter(|row| row.condition == condition && row.trial_index == place)
                .map(|row| row.technique_first.as_str())
                .collect();
            assert_eq!(techniques.len(), 2, "{condition} at {place}");
            assert!(techniques.contains(&"none") && techniques.contains(&"blizzard24"));
        }
    }
    for row in &read.rows {
        // Exact in virtual time: the grey is up for 2 s to the nanosecond.
        let grey_ns = row.grey_offset_ns.unwrap() - row.grey_onset_ns.unwrap();
        assert_eq!(grey_ns, 2_000_000_000);
        assert_ne!(row.first_image_sha256, row.second_image_sha256);
    }
}

#[test]
fn the_same_seed_answers_the_same_and_another_does_not() {
    let study = TinyStudy::new();
    let answers = |results: &str, observer: &str| {
        let results = study.path(results);
        assert!(study.run(&results, observer, 3).status.success());
        let rows = read_folder(&results).unwrap().rows;
        rows.iter()
            .map(|row| {
                (
                    row.condition.clone(),
                    row.response,
                    row.response_time_ms.map(f64::to_bits),
                )
            })
            .collect::<Vec<_>>()
    };
    let first = answers("a", "random:1");
    assert_eq!(first, answers("b", "random:1"));
    assert_ne!(first, answers("c", "random:2"));
}

#[test]
fn the_first_observer_always_takes_the_first_image() {
    let study = TinyStudy::new();
    let results = study.path("results");
    assert!(study.run(&results, "first", 2).status.success());
    let rows = read_folder(&results).unwrap().rows;
    assert_eq!(rows.len(), 2 * TRIALS);
    for row in rows {
        assert_eq!(row.response, Some(Position::First.into()));
        assert_eq!(row.chosen_technique, Some(row.technique_first));
    }
}

/// The second image of each pair stands for the truth, and the first is nothing like it.
#[test]
fn the_model_takes_what_is_nearer_to_the_truth() {
    let study = TinyStudy::new();
    let chosen = |results: &str, observer: &str| {
        let results = study.path(results);
        let output = study.run(&results, observer, 4);
        assert!(output.status.success(), "{}", stderr(&output));
        read_folder(&results).unwrap().rows
    };
    for (results, metric) in [("a", "flip"), ("b", "error")] {
        let rows = chosen(results, &format!("model:1,metric={metric},sigma=0.001"));
        assert_eq!(rows.len(), 4 * TRIALS);
        for row in rows {
            assert_eq!(row.chosen_technique.as_deref(), Some("blizzard24"));
        }
    }
    for row in chosen("c", "model:1,sigma=0.001,truth=none") {
        assert_eq!(row.chosen_technique.as_deref(), Some("none"));
    }
    for row in chosen("d", "model:1,sigma=0.001,bias=100") {
        assert_eq!(row.response, Some(Position::First.into()));
    }
}

/// What a replay would show wrongly, it refuses; the message says what to give.
#[test]
fn a_replay_asks_for_what_was_shown() {
    let study = TinyStudy::new();
    let results = study.path("results");
    assert!(study.run(&results, "first", 1).status.success());
    let data = std::fs::read_dir(results.join("data")).unwrap();
    let session = data.map(|entry| entry.unwrap().path()).next().unwrap();
    let refused = |arguments: &[&std::ffi::OsStr], parts: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_greyfield"))
            .args(["run", "--replay"])
            .args(arguments)
            .output()
            .unwrap();
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    };
    let (session, images) = (session.as_os_str(), study.path("images"));
    let stimuli = "--stimuli".as_ref();
    refused(&[session], &["materials/protocol.toml", "--stimuli"]);
    let elsewhere = study.path("elsewhere.csv");
    std::fs::copy(session, &elsewhere).unwrap();
    refused(
        &[elsewhere.as_os_str(), stimuli, images.as_os_str()],
        &["elsewhere.csv", "no materials/protocol.toml"],
    );
    // The manifest of other images.
    let path = images.join("manifest.json");
    let manifest = std::fs::read_to_string(&path).unwrap();
    let row = read_folder(&results).unwrap().rows.swap_remove(0);
    let hash = row.first_image_sha256;
    std::fs::write(&path, manifest.replace(&hash, &"f".repeat(64))).unwrap();
    refused(
        &[session, stimuli, images.as_os_str()],
        &[&row.row_id, &hash, "--stimuli"],
    );
}

#[test]
fn running_again_adds_nothing_and_more_participants_add_theirs() {
    let study = TinyStudy::new();
    let results = study.path("results");
    assert!(study.run(&results, "first", 2).status.success());
    let output = study.run(&results, "first", 3);
    assert!(output.status.success(), "{}", stderr(&output));
    let last = stdout(&output).lines().last().unwrap().to_owned();
    let done: serde_json::Value = serde_json::from_str(&last).unwrap();
    assert_eq!(done["already_finished"], 2);
    assert_eq!(done["rows"], TRIALS);
}

#[test]
fn several_computers_on_one_folder_share_the_slots_out() {
    let study = TinyStudy::new();
    let results = study.path("results");
    let running: Vec<_> = (1..=4)
        .map(|seed| {
            study
                .command(&results, &format!("random:{seed}"), 5)
                .stdout(std::process::Stdio::null())
                .spawn()
                .unwrap()
        })
        .collect();
    for mut child in running {
        assert!(child.wait().unwrap().success());
    }
    let rows = read_folder(&results).unwrap().rows;
    assert_eq!(rows.len(), 20 * TRIALS);
    let slots: BTreeSet<(u32, &str)> = rows
        .iter()
        .map(|row| (row.slot, row.participant_id.as_str()))
        .collect();
    let numbers: Vec<u32> = slots.iter().map(|(slot, _)| *slot).collect();
    assert_eq!(numbers, (0..20).collect::<Vec<_>>(), "each slot once");
}

#[test]
fn pilot_rows_say_so() {
    let study = TinyStudy::new();
    let results = study.path("results");
    let mut command = study.command(&results, "first", 1);
    assert!(command.arg("--pilot").output().unwrap().status.success());
    assert!(
        read_folder(&results)
            .unwrap()
            .rows
            .iter()
            .all(|row| row.pilot)
    );
}

/// Bad input: exit code 2, and the message names what is wrong and how to mend it.
#[test]
fn bad_input_is_said_before_anything_is_written() {
    let study = TinyStudy::new();
    let refused = |change: &dyn Fn(&TinyStudy), observer: &str, parts: &[&str]| {
        let study = TinyStudy::new();
        change(&study);
        let results = study.path("results");
        let output = study.run(&results, observer, 1);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
        assert!(!results.exists(), "{message}");
    };
    let image = "images/condition-3-none.png";
    refused(
        &|_| {},
        "psychic",
        &[
            "--observer",
            "psychic",
            "random:SEED",
            "first",
            "model:SEED",
        ],
    );
    refused(
        &|_| {},
        "model:1,sigma=0",
        &["--observer", "model:1,sigma=0", "above 0 for sigma"],
    );
    refused(
        &|_| {},
        "model:1,truth=traced",
        &["truth=traced", "blizzard24, none"],
    );
    refused(
        &|study| std::fs::remove_file(study.path("images/manifest.json")).unwrap(),
        "first",
        &["no rendered stimuli", "greyfield render"],
    );
    refused(
        &|study| std::fs::remove_file(study.path(image)).unwrap(),
        "first",
        &["condition-3-none.png", "cannot be read"],
    );
    refused(
        &|study| {
            let other = image::RgbImage::from_pixel(4, 3, image::Rgb([1, 2, 3]));
            other.save(study.path(image)).unwrap();
        },
        "first",
        &["condition-3-none.png", "changed"],
    );
    refused(
        &|study| std::fs::write(study.path("protocol.toml"), "study_id = 3\n").unwrap(),
        "first",
        &["protocol.toml:1", "study_id"],
    );
    // A folder that belongs to another protocol.
    let results = study.path("results");
    assert!(study.run(&results, "first", 1).status.success());
    let text = std::fs::read_to_string(study.path("protocol.toml")).unwrap();
    let changed = text.replace("seed = 2010", "seed = 2011");
    std::fs::write(study.path("protocol.toml"), changed).unwrap();
    let output = study.run(&results, "first", 2);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("belongs to study"),
        "{}",
        stderr(&output)
    );
}

/// Without `--stimuli` the images must be those of the set as it is now.
#[test]
fn images_that_are_not_of_the_set_are_refused() {
    let study = TinyStudy::new();
    let results = study.path("results");
    let refusal = || {
        let output = study
            .command_without_stimuli(&results, "first", 1)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        stderr(&output)
    };
    let message = refusal();
    assert!(message.contains("no rendered stimuli"), "{message}");
    assert!(message.contains("greyfield render"), "{message}");
    std::fs::rename(study.path("images"), study.path("tiny")).unwrap();
    let message = refusal();
    assert!(message.contains("another state of the set"), "{message}");
    assert!(!results.exists());
}

#[test]
fn order_prints_the_plan_the_sessions_follow() {
    let study = TinyStudy::new();
    let order = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_greyfield"))
            .arg("order")
            .arg(study.path("protocol.toml"))
            .args(arguments)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    let plan = order(&["--participants", "15"]);
    let lines: Vec<&str> = plan.lines().collect();
    assert_eq!(
        lines[0],
        "participant,position,condition,first_technique,second_technique"
    );
    assert_eq!(lines.len(), 1 + 15 * TRIALS);
    let row = |participant: usize, position: usize| -> Vec<&str> {
        lines[1 + participant * TRIALS + position]
            .split(',')
            .collect()
    };
    for participant in 0..7 {
        for position in 0..7 {
            let (base, reversed) = (row(participant, position), row(participant + 7, position));
            assert_eq!(base[2], reversed[2], "the same square");
            assert_eq!((base[3], base[4]), (reversed[4], reversed[3]));
        }
    }
    assert_eq!(plan, order(&["--participants", "15", "--seed", "2010"]));
    assert_ne!(plan, order(&["--participants", "15", "--seed", "2011"]));
    assert_eq!(
        order(&[]).lines().count(),
        1 + 36 * TRIALS,
        "as many as planned"
    );
    // The sessions show what the plan says.
    let results = study.path("results");
    assert!(study.run(&results, "first", 15).status.success());
    let mut shown = lines[..1].join("") + "\n";
    for row in read_folder(&results).unwrap().rows {
        let (first, second) = (row.technique_first, row.technique_second);
        shown += &format!(
            "{},{},{},{first},{second}\n",
            row.slot, row.trial_index, row.condition
        );
    }
    assert_eq!(shown, plan);
}
