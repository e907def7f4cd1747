mod ratings_and_ranks;
mod robustness;
mod rules;

use super::*;
use crate::analysis::dataset::Votes;
use crate::protocol::Phase;
use crate::record::{InputDevice, TrialRow, line};
use proptest::prelude::*;

const TRIALS: &str = "participant,condition,first_technique,second_technique,chosen,rt_ms\n";
const COUNTS: &str = "condition,technique_a,technique_b,votes_a,votes_b\n";

fn read_texts(texts: &[&str]) -> Result<Dataset, InputError> {
    let dir = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> = texts
        .iter()
        .enumerate()
        .map(|(i, text)| {
            let path = dir.path().join(format!("{i}.csv"));
            std::fs::write(&path, text).unwrap();
            path
        })
        .collect();
    read(&paths, Options::default())
}

fn error_of(texts: &[&str]) -> String {
    read_texts(texts).unwrap_err().to_string()
}

#[test]
fn trials_in_either_order_count_for_the_same_pair() {
    let data = read_texts(&[&format!(
        "{TRIALS}P1,c,none,crytek24,second,812.5\nP2,c,crytek24,none,first,\nP3,c,none,crytek24,first,3\nP4,c,none,crytek24,,\n"
    )])
    .unwrap();
    let condition = &data.conditions[0];
    assert_eq!(
        (
            condition.technique_a.as_str(),
            condition.technique_b.as_str()
        ),
        ("none", "crytek24")
    );
    assert_eq!(condition.votes, Votes { a: 1, b: 2 });
    let orders = condition.orders.unwrap();
    assert_eq!(
        (orders.orders(), orders.positions(), orders.missing),
        ((2, 1), (2, 1), 1)
    );
    assert_eq!(data.participants, ["P1", "P2", "P3", "P4"]);
    assert_eq!(data.answers[0].response_time_ms, Some(812.5));
}

#[test]
fn conditions_of_trials_are_sorted_by_id_and_those_of_counts_are_not() {
    let data = read_texts(&[&format!("{TRIALS}P,z,x,y,first,\nP,a,u,v,second,\n")]).unwrap();
    let ids: Vec<&str> = data.conditions.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids, ["a", "z"]);
    assert_eq!(data.answers[0].condition, 1);
    assert_eq!(data.conditions[1].votes, Votes { a: 1, b: 0 });
    let data = read_texts(&[&format!("{COUNTS}z,x,y,1,2\na,x,y,3,4\n")]).unwrap();
    assert_eq!(data.conditions[0].id, "z");
}

#[test]
fn several_files_are_one_study() {
    let one = format!("{TRIALS}P1,c,x,y,first,\n");
    let two = "chosen,participant,condition,first_technique,second_technique\nfirst,P2,c,y,x\n";
    let data = read_texts(&[&one, two]).unwrap();
    assert_eq!(data.conditions[0].votes, Votes { a: 1, b: 1 });
    assert_eq!(data.sources.len(), 2);
}

#[test]
fn bad_input_is_named_with_its_place() {
    let t = |rows: &str| format!("{TRIALS}{rows}");
    let c = |rows: &str| format!("{COUNTS}{rows}");
    for (texts, parts) in [
        (
            vec![t("P,c,x,y,left,\n")],
            vec![":2: column `chosen`", "`left`", "`first`", "nothing"],
        ),
        (
            vec![t("P,c,x,y,first,1\nP,c,y,x,first,1\n")],
            vec![":3:", "participant P", "condition c", "0.csv:2"],
        ),
        (
            vec![t("P,c,x,y,first,\n"), t("P,c,x,y,second,\n")],
            vec!["1.csv:2:", "0.csv:2"],
        ),
        (
            vec![t("P,c,x,y,first,\nQ,c,x,z,first,\n")],
            vec![":3:", "x and z", "x and y", "0.csv:2"],
        ),
        (
            vec![t("P,c,x,x,first,\n")],
            vec![":2:", "both techniques are `x`"],
        ),
        (
            vec![t("P,c,,y,first,\n")],
            vec![":2:", "first technique is empty"],
        ),
        (
            vec![t("P,c,x,y,first,-1\n")],
            vec![":2: column `rt_ms`", "-1", "milliseconds"],
        ),
        (
            vec![t("P,c,x,y,first,NaN\n")],
            vec![":2: column `rt_ms`", "NaN"],
        ),
        (
            vec![t("P,c,x,y,first\n")],
            vec![":2:", "5 fields", "6 columns"],
        ),
        (vec![t("")], vec!["no trial to analyse"]),
        (vec![c("")], vec!["no trial to analyse"]),
        (
            vec![c("c,x,y,-1,2\n")],
            vec![":2: column `votes_a`", "-1", "0 to 1000000000"],
        ),
        (
            vec![c("c,x,y,1,2.5\n")],
            vec![":2: column `votes_b`", "2.5"],
        ),
        (
            vec![c("c,x,y,1,4000000000\n")],
            vec![":2: column `votes_b`", "0 to 1000000000"],
        ),
        (
            vec![c("c,x,y,1,2\nd,x,y,1,2\nc,x,y,1,2\n")],
            vec![":4:", "condition c", "0.csv:2"],
        ),
        (
            vec![c("c,x,y,1,2\n"), t("P,c,x,y,first,\n")],
            vec![
                "1.csv",
                "counts and single choices",
                "cannot be analysed together",
            ],
        ),
        (
            vec!["participant,condition,first_technique,second_technique,choice\n".into()],
            vec![
                ":1:",
                "lacks `chosen`",
                "found participant,",
                "choice",
                "needed",
            ],
        ),
        (
            vec!["a,b\n1,2\n".into()],
            vec![":1:", "a,b", "count table", "trial table"],
        ),
        (
            vec!["participant,condition,technique,rank\n".into()],
            vec!["no trial to analyse"],
        ),
        (vec![String::new()], vec!["empty"]),
    ] {
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let message = error_of(&texts);
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}

#[test]
fn a_missing_file_and_an_empty_folder_say_so() {
    let dir = tempfile::tempdir().unwrap();
    let message = read(&[dir.path().join("no.csv")], Options::default())
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("no.csv") && message.contains("cannot be read"),
        "{message}"
    );
    let message = read(&[dir.path().to_owned()], Options::default())
        .unwrap_err()
        .to_string();
    assert!(message.contains("no data"), "{message}");
}

#[test]
fn a_column_nobody_reads_is_noted() {
    let data =
        read_texts(&["condition,technique_a,technique_b,votes_a,votes_b,asks\nc,x,y,1,2,H1\n"])
            .unwrap();
    assert!(
        data.notes[0].contains("`asks`") && data.notes[0].contains("hypothesis"),
        "{:?}",
        data.notes
    );
}

/// A results folder with one data file of these rows.
fn results_folder(rows: &[TrialRow], conditions: Option<&str>) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let data = dir.path().join("data");
    std::fs::create_dir(&data).unwrap();
    let mut bytes = line::header().into_bytes();
    for row in rows {
        bytes.extend(line::encode(row).unwrap());
    }
    std::fs::write(data.join("study-s_subject-P1_session-1_data.csv"), bytes).unwrap();
    if let Some(conditions) = conditions {
        let study = format!(
            "{{\"study_id\":\"s\",\"protocol_hash\":\"{}\",\"conditions\":{conditions}}}",
            "ab".repeat(32)
        );
        std::fs::write(dir.path().join("study.json"), study).unwrap();
    }
    dir
}

fn row(participant: &str, trial_index: u32, condition: &str) -> TrialRow {
    TrialRow {
        condition: condition.to_owned(),
        ..crate::record::tests::row(participant, trial_index)
    }
}

#[test]
fn a_results_folder_carries_base_orders_and_leaves_out_what_does_not_count() {
    let rows = [
        TrialRow {
            phase: Phase::Practice,
            ..row("P1", 0, "warm-up")
        },
        TrialRow {
            phase: Phase::Catch,
            ..row("P1", 1, "same")
        },
        TrialRow {
            pilot: true,
            ..row("P2", 2, "b")
        },
        row("P1", 3, "b"),
        TrialRow {
            input_device: InputDevice::Scripted,
            ..row("P1", 4, "a")
        },
    ];
    let study = r#"[{"id":"b","scene":"atrium","first_technique":"blizzard24","second_technique":"none","hypothesis":"H1"},
        {"id":"a","scene":"atrium","first_technique":"none","second_technique":"blizzard24"}]"#;
    let dir = results_folder(&rows, Some(study));
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    let ids: Vec<&str> = data.conditions.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids, ["b", "a"], "the study's order");
    // The rows show none first and choose the second: blizzard24, which is b's technique a.
    assert_eq!(data.conditions[0].technique_a, "blizzard24");
    assert_eq!(data.conditions[0].votes, Votes { a: 1, b: 0 });
    assert_eq!(data.conditions[1].votes, Votes { a: 0, b: 1 });
    assert_eq!(data.conditions[0].hypothesis.as_deref(), Some("H1"));
    assert_eq!(data.conditions[1].hypothesis, None);
    assert_eq!(
        (data.sources[0].rows_used, data.sources[0].rows_left_out),
        (2, 3)
    );
    for part in [
        "1 practice",
        "1 catch",
        "1 trials of pilot",
        "1 trials were answered by a scripted",
    ] {
        assert!(
            data.notes.iter().any(|note| note.starts_with(part)),
            "{part}: {:?}",
            data.notes
        );
    }
    let with_pilot = Options {
        include_pilot: true,
        ..Options::default()
    };
    let data = read(&[dir.path().to_owned()], with_pilot).unwrap();
    assert_eq!(data.conditions[0].votes, Votes { a: 2, b: 0 });
}

/// A rejection is a file beside the claim; nothing in the data tells of it.
/// Who stands first in the folder's list of files is not who came first.
#[test]
fn participants_appear_in_the_order_they_took_part() {
    let dir = tempfile::tempdir().unwrap();
    let data = dir.path().join("data");
    std::fs::create_dir(&data).unwrap();
    for (id, minute) in [("A", 30), ("B", 10), ("C", 20)] {
        let row = TrialRow {
            answered_utc: format!("2026-11-02T09:{minute}:00Z"),
            ..row(id, 0, "a")
        };
        let file = data.join(format!("study-s_subject-{id}_session-1_data.csv"));
        let mut bytes = line::header().into_bytes();
        bytes.extend(line::encode(&row).unwrap());
        std::fs::write(file, bytes).unwrap();
    }
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(data.participants, ["B", "C", "A"]);
}

#[test]
fn rejected_participants_are_left_out_and_named() {
    let dir = results_folder(
        &[row("P1", 0, "a"), row("P2", 0, "a"), row("P2", 1, "b")],
        None,
    );
    let slots = dir.path().join("slots");
    std::fs::create_dir(&slots).unwrap();
    let write = |name: &str, text: &str| std::fs::write(slots.join(name), text).unwrap();
    for (slot, id) in ["P1", "P2"].iter().enumerate() {
        write(
            &format!("slot-000{slot}_claim-1.json"),
            &format!(r#"{{"participant":"{id}","station":"lab","claimed_utc":""}}"#),
        );
    }
    write(
        "slot-0001_claim-1_rejected-1.json",
        r#"{"reason":"slept","rejected_utc":""}"#,
    );
    let votes = |options: Options| {
        let data = read(&[dir.path().to_owned()], options).unwrap();
        let votes: u32 = data.conditions.iter().map(|c| c.votes.a + c.votes.b).sum();
        (votes, data.notes)
    };
    let (counted, notes) = votes(Options::default());
    assert_eq!(counted, 1);
    let note = "1 rejected participants are left out (P2), 2 trials";
    assert!(notes.iter().any(|n| n.starts_with(note)), "{notes:?}");
    let everybody = Options {
        include_rejected: true,
        ..Options::default()
    };
    assert_eq!(votes(everybody).0, 3);
    write(
        "slot-0001_claim-1_reinstated-1.json",
        r#"{"reason":"","reinstated_utc":""}"#,
    );
    let (counted, notes) = votes(Options::default());
    assert_eq!(counted, 3);
    assert!(!notes.iter().any(|n| n.contains("rejected")), "{notes:?}");
}

#[test]
fn a_torn_line_of_a_session_is_passed_over_and_noted() {
    let dir = results_folder(&[row("P1", 0, "a"), row("P1", 1, "b")], None);
    let file = dir
        .path()
        .join("data/study-s_subject-P1_session-1_data.csv");
    let bytes = std::fs::read(&file).unwrap();
    std::fs::write(&file, &bytes[..bytes.len() - 30]).unwrap();
    // As a folder and as a single file.
    for input in [dir.path().to_owned(), file] {
        let data = read(&[input], Options::default()).unwrap();
        assert_eq!(data.conditions.len(), 1);
        assert!(
            data.notes[0].contains(":3: passed over"),
            "{:?}",
            data.notes
        );
    }
}

#[test]
fn answers_given_twice_in_two_sessions_are_refused_by_line() {
    let dir = results_folder(&[row("P1", 0, "a"), row("P1", 1, "a")], None);
    let message = read(&[dir.path().to_owned()], Options::default())
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("_data.csv:3:") && message.contains("_data.csv:2"),
        "{message}"
    );
}

#[test]
fn a_results_folder_without_data_says_so() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::create_dir(dir.path().join("data")).unwrap();
    let message = read(&[dir.path().to_owned()], Options::default())
        .unwrap_err()
        .to_string();
    assert!(message.contains("run a session first"), "{message}");
}

proptest! {
    /// Whatever a file holds, it is either read or refused with a message: no panic.
    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), header in 0..3_usize) {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("x.csv");
        let mut content = [TRIALS, COUNTS, ""][header].as_bytes().to_vec();
        content.extend(bytes);
        std::fs::write(&path, content).unwrap();
        if let Err(error) = read(&[path], Options::default()) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    /// Rows in any order give the same votes as long as the base order is the same.
    #[test]
    fn votes_do_not_depend_on_the_order_of_rows(
        rows in prop::collection::vec((0..4_u8, any::<bool>(), any::<bool>()), 1..40),
        turn in 0..40_usize,
    ) {
        let mut lines: Vec<String> = rows.iter().enumerate().map(|(i, (condition, reversed, first))| {
            let (one, two) = if *reversed { ("y", "x") } else { ("x", "y") };
            format!("P{i},c{condition},{one},{two},{},", if *first { "first" } else { "second" })
        }).collect();
        let by_technique = |lines: &[String]| {
            let text = format!("{TRIALS}{}\n", lines.join("\n"));
            let data = read_texts(&[&text]).unwrap();
            data.conditions.iter().map(|c| {
                let votes = if c.technique_a == "x" { (c.votes.a, c.votes.b) } else { (c.votes.b, c.votes.a) };
                (c.id.clone(), votes)
            }).collect::<Vec<_>>()
        };
        let before = by_technique(&lines);
        let turn = turn % lines.len();
        lines.rotate_left(turn);
        prop_assert_eq!(before, by_technique(&lines));
    }
}
