//! Rules that a protocol lays down, and those chosen for one analysis.

use std::path::Path;

use super::*;
use crate::analysis::dataset::Exclusion;
use crate::digest::sha256_hex;

const THESIS: &str = include_str!("../../../../protocols/thesis-2010.toml");

const CATCH: &str = "[catch]\nminimum_correct = 2\n\
    [[catch.trials]]\ncondition = \"k1\"\ncorrect = \"none\"\n\
    [[catch.trials]]\ncondition = \"k2\"\ncorrect = \"none\"\n";

/// A results folder of a protocol: the thesis' and `more`.
fn folder(rows: &[TrialRow], more: &str) -> tempfile::TempDir {
    let protocol = format!("{THESIS}\n{more}");
    let dir = results_folder(rows, Some("[]"));
    std::fs::create_dir(dir.path().join("materials")).unwrap();
    std::fs::write(dir.path().join("materials/protocol.toml"), &protocol).unwrap();
    begun_with(dir.path(), &sha256_hex(protocol.as_bytes()));
    dir
}

fn begun_with(folder: &Path, hash: &str) {
    let study = format!(r#"{{"study_id":"thesis-2010","protocol_hash":"{hash}","conditions":[]}}"#);
    std::fs::write(folder.join("study.json"), study).unwrap();
}

fn in_time(row: TrialRow, ms: f64) -> TrialRow {
    TrialRow {
        response_time_ms: Some(ms),
        ..row
    }
}

fn catch(participant: &str, index: u32, correct: bool) -> TrialRow {
    TrialRow {
        row_id: format!("{participant}:1:catch:{index}"),
        phase: Phase::Catch,
        correct: Some(correct),
        ..row(participant, index, "k")
    }
}

fn rule<'a>(data: &'a Dataset, part: &str) -> &'a Exclusion {
    let found = data.exclusions.iter().find(|it| it.rule.contains(part));
    found.unwrap_or_else(|| panic!("{part:?} not in {:?}", data.exclusions))
}

#[test]
fn every_rule_is_applied_in_order_and_reported() {
    let rows = [
        // P1 fails a catch trial, and is fast: only the first rule counts it.
        in_time(row("P1", 0, "a"), 50.0),
        row("P1", 1, "b"),
        catch("P1", 2, true),
        catch("P1", 3, false),
        // P2 stops early and has not failed anything.
        row("P2", 0, "a"),
        catch("P2", 1, true),
        // P3 stays; one trial too fast, one at the very limit, one too slow.
        in_time(row("P3", 0, "a"), 199.0),
        in_time(row("P3", 1, "b"), 200.0),
        in_time(row("P3", 2, "c"), 9000.5),
        catch("P3", 3, true),
        catch("P3", 4, true),
    ];
    let dir = folder(
        &rows,
        &format!(
            "{CATCH}[analysis]\nalpha = 0.01\nfamily = [\"a\"]\nexclude_failed_catch = true\nminimum_main_trials = 2\nminimum_response_ms = 200\nmaximum_response_ms = 9000\n"
        ),
    );
    // The folder, and its file alone.
    let file = dir
        .path()
        .join("data/study-s_subject-P1_session-1_data.csv");
    for input in [dir.path().to_owned(), file] {
        let data = read(&[input], Options::default()).unwrap();
        let order: Vec<&str> = data.exclusions.iter().map(|it| it.rule.as_str()).collect();
        assert_eq!(
            order,
            [
                "participants with fewer than 2 of 2 catch trials right (protocol of thesis-2010: analysis.exclude_failed_catch)",
                "participants with fewer than 2 answered main trials (protocol of thesis-2010: analysis.minimum_main_trials)",
                "trials answered in less than 200 ms (protocol of thesis-2010: analysis.minimum_response_ms)",
                "trials answered in more than 9000 ms (protocol of thesis-2010: analysis.maximum_response_ms)",
            ]
        );
        let touched: Vec<(&[String], u64)> = (data.exclusions.iter())
            .map(|it| (&it.participants[..], it.trials))
            .collect();
        let [p1, p2, p3] = ["P1", "P2", "P3"].map(|id| [id.to_owned()]);
        assert_eq!(touched, [(&p1[..], 2), (&p2, 1), (&p3, 1), (&p3, 1)]);
        assert_eq!(data.participants, ["P3"]);
        assert_eq!(data.answers.len(), 1);
        assert_eq!(data.answers[0].participant, 0);
        let votes: u32 = data.conditions.iter().map(|it| it.votes.total()).sum();
        assert_eq!(votes, 1);
        let declared = data.declared.unwrap();
        assert_eq!(declared.family, ["a"]);
        assert!((declared.alpha.unwrap().get() - 0.01).abs() < 1e-15);
    }
}

#[test]
fn a_rule_that_touches_nobody_is_reported_and_a_protocol_without_rules_has_none() {
    let dir = folder(
        &[row("P1", 0, "a")],
        "[analysis]\nminimum_response_ms = 100\n",
    );
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    let found = rule(&data, "100 ms");
    assert_eq!((&found.participants[..], found.trials), (&[][..], 0));
    assert_eq!(data.declared, None);
    let dir = folder(&[row("P1", 0, "a")], "");
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert!(
        data.exclusions.is_empty() && data.notes.is_empty(),
        "{:?}",
        data.notes
    );
}

#[test]
fn a_limit_chosen_now_takes_the_place_of_the_protocols() {
    let rows = [
        in_time(row("P1", 0, "a"), 150.0),
        in_time(row("P1", 1, "b"), 300.0),
    ];
    let dir = folder(&rows, "[analysis]\nminimum_response_ms = 200\n");
    let options = Options {
        minimum_response_ms: Some(100.0),
        ..Options::default()
    };
    let data = read(&[dir.path().to_owned()], options).unwrap();
    assert_eq!(data.answers.len(), 2);
    assert_eq!(data.exclusions.len(), 1);
    assert!(
        data.exclusions[0]
            .rule
            .contains("100 ms (chosen for this analysis, in place of the protocol's 200 ms)"),
        "{:?}",
        data.exclusions
    );
}

#[test]
fn trials_of_a_table_are_left_out_by_their_time() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("t.csv");
    let text = format!(
        "{TRIALS}P,c,x,y,first,99\nP,d,x,y,first,100\nQ,c,x,y,first,5001\nR,c,y,x,first,\n"
    );
    std::fs::write(&path, text).unwrap();
    let options = Options {
        minimum_response_ms: Some(100.0),
        maximum_response_ms: Some(5000.0),
        ..Options::default()
    };
    let data = read(&[path], options).unwrap();
    assert_eq!(data.participants, ["P", "R"]);
    let numbers: Vec<(u32, u32)> = (data.answers.iter())
        .map(|it| (it.participant, it.condition))
        .collect();
    assert_eq!(numbers, [(0, 1), (1, 0)]);
    let fast = rule(&data, "less than 100 ms (chosen for this analysis)");
    assert_eq!(
        (&fast.participants[..], fast.trials),
        (&["P".to_owned()][..], 1)
    );
    let slow = rule(&data, "more than 5000 ms");
    assert_eq!(
        (&slow.participants[..], slow.trials),
        (&["Q".to_owned()][..], 1)
    );
    let untimed = "1 trials have no response time";
    assert!(
        data.notes.iter().any(|note| note.starts_with(untimed)),
        "{:?}",
        data.notes
    );
    // The base order is that of the condition's first row, also where that one is left out.
    assert_eq!(data.conditions[0].technique_a, "x");
}

#[test]
fn a_rule_that_leaves_nothing_says_so() {
    let dir = folder(
        &[row("P1", 0, "a")],
        "[analysis]\nminimum_main_trials = 2\n",
    );
    let message = read(&[dir.path().to_owned()], Options::default())
        .unwrap_err()
        .to_string();
    for part in [
        "no trial to analyse",
        "1 trials left out",
        "fewer than 2 answered",
    ] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
}

/// Rows of one image on two scales are one trial.
#[test]
fn rules_hold_for_ratings_too() {
    let rated = |participant, ms| TrialRow {
        technique_second: String::new(),
        response: None,
        chosen_technique: None,
        ratings: "realism=3;pleasing=4".into(),
        ..in_time(row(participant, 0, "a"), ms)
    };
    let dir = folder(
        &[rated("P1", 10.0), rated("P2", 500.0)],
        "[analysis]\nminimum_response_ms = 100\n",
    );
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(data.participants, ["P2"]);
    assert_eq!(data.ratings.answers.len(), 2);
    let fast = rule(&data, "100 ms");
    assert_eq!(
        (&fast.participants[..], fast.trials),
        (&["P1".to_owned()][..], 1)
    );
}

#[test]
fn what_the_protocol_says_of_the_study_is_kept() {
    let metadata = "[[metadata]]\nid = \"games\"\nchoices = [\"never\", \"daily\"]\n\
        [[metadata]]\nid = \"remarks\"\n\
        [texts.metadata.games]\nlabel = \"How often do you play?\"\nchoices = [\"never\", \"every day\"]\n";
    let rows = [row("P1", 0, "a"), row("P2", 0, "a"), row("P3", 0, "a")];
    let dir = folder(&rows, metadata);
    let abouts = dir.path().join("participants");
    std::fs::create_dir(&abouts).unwrap();
    for (id, answers) in [
        (
            "P1",
            r#"{"id":"games","answer":"daily"},{"id":"remarks","answer":"my name is"}"#,
        ),
        ("P2", ""),
        // Nobody the data know.
        ("P9", r#"{"id":"games","answer":"never"}"#),
    ] {
        let text = format!(r#"{{"participant":"{id}","language":"en","answers":[{answers}]}}"#);
        std::fs::write(abouts.join(format!("subject-{id}.json")), text).unwrap();
    }
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    let study = data.study.unwrap();
    assert_eq!(study.id, "thesis-2010");
    assert_eq!(study.question, "Which image looked more realistic?");
    assert_eq!(
        (&*study.procedure, &*study.design),
        ("no-reference", "latin, block")
    );
    assert_eq!((study.seed, study.planned_participants), (2010, 36));
    assert_eq!(study.versions, ["0.1.0"]);
    let names: Vec<&str> = study.hypotheses.iter().map(|it| it.0.as_str()).collect();
    assert_eq!(names, ["H1", "H2", "H3"]);
    let said = |text: &str, n| (text.to_owned(), n);
    assert_eq!(
        study.participants_told,
        [(
            "How often do you play?".to_owned(),
            vec![said("never", 0), said("every day", 1), said("no answer", 1)]
        )]
    );
}

#[test]
fn a_protocol_that_is_not_the_one_begun_with_lays_nothing_down() {
    let dir = folder(
        &[row("P1", 0, "a")],
        "[analysis]\nminimum_main_trials = 2\n",
    );
    begun_with(dir.path(), &"0".repeat(64));
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(data.answers.len(), 1);
    assert!(
        data.notes[0].contains("protocol.toml") && data.notes[0].contains("changed"),
        "{:?}",
        data.notes
    );
    assert_eq!(data.study.unwrap().question, "");
    std::fs::remove_file(dir.path().join("materials/protocol.toml")).unwrap();
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert!(
        data.notes[0].contains("no rule of it is applied"),
        "{:?}",
        data.notes
    );
}

#[test]
fn two_protocols_declare_nothing_together() {
    let one = folder(&[row("P1", 0, "a")], "[analysis]\nalpha = 0.01\n");
    let two = folder(&[row("P2", 0, "a")], "[analysis]\nalpha = 0.1\n");
    let inputs = [one.path().to_owned(), two.path().to_owned()];
    let data = read(&inputs, Options::default()).unwrap();
    assert_eq!((data.study, data.declared), (None, None));
    assert!(
        data.notes
            .iter()
            .any(|note| note.contains("several protocols"))
    );
    // Two folders of one protocol are one study with one rule.
    let rule = "[analysis]\nalpha = 0.01\nminimum_response_ms = 2000\n";
    let two = folder(
        &[row("P2", 0, "a"), in_time(row("P2", 1, "b"), 2000.0)],
        rule,
    );
    let one = folder(&[row("P1", 0, "a")], rule);
    let inputs = [one.path().to_owned(), two.path().to_owned()];
    let data = read(&inputs, Options::default()).unwrap();
    assert!(data.declared.is_some() && data.study.is_some());
    assert_eq!(data.exclusions.len(), 1);
    assert_eq!(data.exclusions[0].participants, ["P1", "P2"]);
    assert_eq!(data.exclusions[0].trials, 2);
}
