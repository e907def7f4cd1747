//! An audit finds what is wrong, says where, and finds nothing where nothing is.

use std::path::{Path, PathBuf};

use time::OffsetDateTime;

use super::row;
use super::studies::{NOW, id};
use crate::digest;
use crate::protocol::{Condition, Protocol, SessionPlan};
use crate::record::audit::{Finding, Severity, audit};
use crate::record::{Study, StudyIdentity, TrialRow, line};

const PROTOCOL: &str = include_str!("../../../protocols/thesis-2010.toml");

fn protocol() -> Protocol {
    Protocol::parse(Path::new("p.toml"), PROTOCOL).unwrap()
}

fn open(folder: &Path) -> Study {
    let conditions: Vec<Condition> = ["c0", "c1", "c2"]
        .map(|id| Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            techniques: vec!["none".to_owned(), "blizzard24".to_owned()],
            reference: None,
            hypothesis: "H1".to_owned(),
        })
        .into();
    let mut identity = StudyIdentity::new(&protocol(), &conditions);
    identity.image_sha256 = (0..6).map(|n| digest::sha256_hex(&[n])).collect();
    let pairs: Vec<_> = identity
        .image_sha256
        .chunks(2)
        .map(
            |pair| serde_json::json!({"first": {"sha256": pair[0]}, "second": {"sha256": pair[1]}}),
        )
        .collect();
    let manifest = serde_json::json!({ "pairs": pairs }).to_string();
    let study = Study::open(folder, identity, PROTOCOL).unwrap();
    study
        .keep("materials/manifest.json", manifest.as_bytes())
        .unwrap();
    study
}

/// The row that the plan of a slot asks for.
fn planned(study: &Study, participant: &str, slot: u32, trial: usize) -> TrialRow {
    let plan = SessionPlan::new(&protocol(), &study.identity().conditions, slot).unwrap();
    let trial = &plan.trials[trial];
    let (first, second) = plan.techniques(trial);
    let image = |second: bool| {
        let n = 2 * trial.condition + usize::from(second != trial.reversed);
        study.identity().image_sha256[n].clone()
    };
    let start_ns = trial.index as u64 * 20_000_000_000;
    let base = row(participant, u32::try_from(trial.index).unwrap());
    let later = |ns: Option<u64>| ns.map(|ns| ns + start_ns);
    TrialRow {
        study_id: study.identity().study_id.clone(),
        protocol_hash: study.identity().protocol_hash.clone(),
        slot,
        condition: plan.conditions[trial.condition].id.clone(),
        technique_first: first.to_owned(),
        technique_second: second.to_owned(),
        chosen_technique: Some(second.to_owned()),
        first_image_sha256: image(false),
        second_image_sha256: image(true),
        first_onset_ns: later(base.first_onset_ns),
        first_offset_ns: later(base.first_offset_ns),
        grey_onset_ns: later(base.grey_onset_ns),
        grey_offset_ns: later(base.grey_offset_ns),
        second_onset_ns: later(base.second_onset_ns),
        second_offset_ns: later(base.second_offset_ns),
        question_onset_ns: later(base.question_onset_ns),
        response_ns: later(base.response_ns),
        ..base
    }
}

/// P01 in slot 0 and P02 in slot 1, both whole.
fn whole(folder: &Path) -> Study {
    let study = open(folder);
    for (slot, name) in (0..).zip(["P01", "P02"]) {
        let mut enrolment = study.enrol(&id(name), "lab", NOW).unwrap();
        assert_eq!(enrolment.slot, slot);
        for trial in 0..3 {
            let row = planned(&study, name, slot, trial);
            enrolment.log.append_row(&row).unwrap();
        }
    }
    study
}

fn data(study: &Study, participant: &str) -> PathBuf {
    study.data_path(&id(participant))
}

/// What an audit finds after a change: severity, line, message.
fn found(change: impl Fn(&Study)) -> Vec<(Severity, Option<u64>, String)> {
    let folder = tempfile::tempdir().unwrap();
    change(&whole(folder.path()));
    let report = audit(folder.path()).unwrap();
    let severities: Vec<Severity> = report.findings.iter().map(|f| f.severity).collect();
    assert!(severities.is_sorted(), "the worst first");
    let told = |finding: Finding| {
        assert!(!finding.mend.is_empty());
        let message = format!("{}: {}", finding.path.display(), finding.message);
        (finding.severity, finding.line, message)
    };
    report.findings.into_iter().map(told).collect()
}

/// One finding and no other.
fn only(
    found: &[(Severity, Option<u64>, String)],
    severity: Severity,
    line: Option<u64>,
    parts: &[&str],
) {
    assert_eq!(found.len(), 1, "{found:#?}");
    assert_eq!((found[0].0, found[0].1), (severity, line), "{found:?}");
    for part in parts {
        assert!(found[0].2.contains(part), "{part:?} not in {found:?}");
    }
}

/// Rewrites one row of P01 as it would be written, checksum and all.
fn with_row(trial: usize, change: fn(&mut TrialRow)) -> Vec<(Severity, Option<u64>, String)> {
    found(|study| {
        let mut bytes = line::header().into_bytes();
        for index in 0..3 {
            let mut row = planned(study, "P01", 0, index);
            if index == trial {
                change(&mut row);
            }
            bytes.extend(line::encode(&row).unwrap());
        }
        std::fs::write(data(study, "P01"), bytes).unwrap();
    })
}

fn remove(study: &Study, name: &str) {
    std::fs::remove_file(study.folder().join(name)).unwrap();
}

#[test]
fn nothing_is_found_where_nothing_is() {
    assert_eq!(found(|_| {}), []);
    let folder = tempfile::tempdir().unwrap();
    whole(folder.path());
    let report = audit(folder.path()).unwrap();
    assert_eq!(
        (report.participants, report.data_files, report.rows),
        (2, 2, 6)
    );
}

#[test]
fn rows_are_held_against_their_plan_their_slot_and_the_images() {
    type Case = (fn(&mut TrialRow), &'static str);
    let cases: [Case; 7] = [
        (|row| row.slot = 5, "slot is 5, expected 0"),
        (|row| row.pilot = true, "pilot is true"),
        (
            |row| row.participant_id = "P09".into(),
            "participant_id is P09",
        ),
        (|row| row.protocol_hash = "0".into(), "protocol_hash is 0"),
        (
            |row| row.first_image_sha256 = "0".into(),
            "the first image shown has SHA-256 0",
        ),
        (|row| row.condition = "other".into(), "shows other ("),
        (
            |row| std::mem::swap(&mut row.technique_first, &mut row.technique_second),
            "the plan of slot 0 says",
        ),
    ];
    for (change, part) in cases {
        only(
            &with_row(1, change),
            Severity::Error,
            Some(3),
            &["P01", part],
        );
    }
}

#[test]
fn a_missing_trial_is_told_once_and_one_out_of_order_too() {
    let without = |gone: usize| {
        found(|study| {
            let rows = (0..3).filter(|&n| n != gone);
            let lines = rows.map(|n| line::encode(&planned(study, "P01", 0, n)).unwrap());
            let bytes = [line::header().into_bytes(), lines.flatten().collect()].concat();
            std::fs::write(data(study, "P01"), bytes).unwrap();
        })
    };
    let told = without(1);
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].2.contains("trial 1 is missing"), "{told:?}");
    assert!(told[1].2.contains("unfinished: 2 of 3"), "{told:?}");
    only(
        &without(2),
        Severity::Warning,
        None,
        &["unfinished: 2 of 3"],
    );
    let swapped = found(|study| {
        let lines = [1, 0, 2].map(|n| line::encode(&planned(study, "P01", 0, n)).unwrap());
        let bytes = [line::header().into_bytes(), lines.concat()].concat();
        std::fs::write(data(study, "P01"), bytes).unwrap();
    });
    assert!(
        swapped
            .iter()
            .any(|f| f.1 == Some(3) && f.2.contains("out of order")),
        "{swapped:?}"
    );
}

#[test]
fn times_that_cannot_be_are_found() {
    let backwards = with_row(1, |row| row.grey_offset_ns = Some(1));
    only(
        &backwards,
        Severity::Error,
        Some(3),
        &["negative duration", "grey_offset_ns is 1"],
    );
    // 120 frames of 16.67 ms: what is missing is more than half of one.
    let short = with_row(0, |row| row.grey_onset_ns = Some(4_008_400_000));
    only(
        &short,
        Severity::Warning,
        Some(2),
        &["1991.6 ms", "2000 ms"],
    );
    let rounded = with_row(0, |row| row.grey_onset_ns = Some(4_008_300_000));
    assert_eq!(rounded, []);
    let by_the_clock = with_row(0, |row| {
        row.grey_frames = None;
        row.grey_onset_ns = Some(4_000_000_001);
    });
    only(
        &by_the_clock,
        Severity::Warning,
        Some(2),
        &["1999.999999 ms", "2000 ms"],
    );
    let wrong = with_row(2, |row| row.response_time_ms = Some(1.0));
    only(
        &wrong,
        Severity::Error,
        Some(4),
        &["response_time_ms is 1,", "1234.5"],
    );
    let clock = with_row(1, |row| row.answered_utc = "2020-01-01T00:00:00Z".into());
    only(&clock, Severity::Warning, Some(3), &["answered_utc"]);
    let overtaken = with_row(1, |row| row.first_onset_ns = Some(2));
    only(
        &overtaken,
        Severity::Warning,
        Some(3),
        &["before the answer to the one before"],
    );
}

#[test]
fn what_happened_in_a_session_is_told() {
    let focus = with_row(1, |row| row.focus_lost = 2);
    only(
        &focus,
        Severity::Warning,
        Some(3),
        &["keyboard focus 2 times"],
    );
    let missed = with_row(1, |row| row.missed_frames = Some(4));
    only(
        &missed,
        Severity::Warning,
        None,
        &["4 frames came late, in 1 of 3"],
    );
    let resumed = with_row(2, |row| {
        row.segment = 2;
        row.resume_gap_ms = Some(61_500);
    });
    assert_eq!(resumed.len(), 2, "{resumed:?}");
    assert!(
        resumed[0].2.contains("no file under slots/ tells"),
        "{resumed:?}"
    );
    assert!(resumed[1].2.contains("61.5 s"), "{resumed:?}");
}

/// A torn line that a resume has ended is a note; one that nobody tells of is not.
#[test]
fn damaged_lines_are_told_with_what_is_known_of_them() {
    let tear = |study: &Study| {
        let path = data(study, "P01");
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() - 30]).unwrap();
    };
    let torn = found(tear);
    assert_eq!(torn.len(), 2, "{torn:?}");
    assert!(
        torn.iter()
            .any(|f| f.1 == Some(4) && f.2.contains("cut off by a crash")),
        "{torn:?}"
    );
    let resumed = found(|study| {
        tear(study);
        let now = NOW + time::Duration::minutes(1);
        let mut enrolment = study.resume(&id("P01"), "lab", now).unwrap();
        let row = TrialRow {
            segment: 2,
            resume_gap_ms: Some(48_765),
            answered_utc: crate::record::study::iso_8601(now),
            ..planned(study, "P01", 0, 2)
        };
        enrolment.log.append_row(&row).unwrap();
    });
    let notes: Vec<Severity> = resumed.iter().map(|f| f.0).collect();
    assert_eq!(notes, [Severity::Note, Severity::Note], "{resumed:?}");
    let edited = found(|study| {
        let path = data(study, "P02");
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replacen(",second,", ",first,", 1)).unwrap();
    });
    assert!(
        edited.iter().any(|f| f.2.contains("no resume tells of it")),
        "{edited:?}"
    );
    let repeated = found(|study| {
        let path = data(study, "P02");
        let text = std::fs::read_to_string(&path).unwrap();
        let last = text.lines().last().unwrap().to_owned();
        std::fs::write(&path, format!("{text}{last}\n")).unwrap();
    });
    only(
        &repeated,
        Severity::Warning,
        Some(5),
        &["row_id stands further up"],
    );
}

#[test]
fn slots_and_data_must_belong_together() {
    let slot = "slots/slot-0000_claim-1.json";
    let copy = |study: &Study, to: &str| {
        std::fs::copy(study.folder().join(slot), study.folder().join(to)).unwrap();
    };
    let held_twice = found(|study| copy(study, "slots/slot-0000_claim-2.json"));
    only(
        &held_twice,
        Severity::Error,
        None,
        &["slot 0 is held twice", "claim 1 was not released"],
    );
    let two_slots = found(|study| copy(study, "slots/slot-0002_claim-1.json"));
    assert!(
        two_slots
            .iter()
            .any(|f| f.2.contains("\"P01\" has two slots")),
        "{two_slots:?}"
    );
    let lost = found(|study| remove(study, slot));
    assert!(
        lost.iter().any(|f| f.0 == Severity::Error
            && f.2
                .contains("3 trials of participant \"P01\", who has no slot")),
        "{lost:?}"
    );
    let gone = found(|study| std::fs::remove_file(data(study, "P02")).unwrap());
    only(
        &gone,
        Severity::Error,
        None,
        &["\"P02\" has a slot but no data file"],
    );
    let odd = found(|study| copy(study, "slots/slot-0000_claim-1_reinstated-1.json"));
    assert!(
        odd.iter()
            .any(|f| f.2.contains("rejected 0 times and reinstated 1 times")),
        "{odd:?}"
    );
    let empty = found(|study| std::fs::write(study.folder().join(slot), "").unwrap());
    assert!(
        empty
            .iter()
            .any(|f| f.0 == Severity::Error && f.2.contains("slot-0000_claim-1.json")),
        "{empty:?}"
    );
    let stray = found(|study| std::fs::write(study.folder().join("slots/.x.draft"), "").unwrap());
    only(&stray, Severity::Note, None, &["draft"]);
    let stopped = found(|study| {
        drop(
            study
                .enrol(&id("P03"), "lab", OffsetDateTime::UNIX_EPOCH)
                .unwrap(),
        );
        remove(study, "slots/slot-0002_claim-1.json");
    });
    only(
        &stopped,
        Severity::Warning,
        None,
        &["a session without a slot"],
    );
    let left = found(|study| {
        study.release(&id("P01"), "left", NOW).unwrap();
    });
    only(
        &left,
        Severity::Note,
        None,
        &["open below the highest slot: 0"],
    );
}

#[test]
fn materials_must_be_those_the_study_was_begun_with() {
    let write = |name: &'static str, text: &'static str| {
        found(move |study| std::fs::write(study.folder().join(name), text).unwrap())
    };
    let changed = write("materials/protocol.toml", "study_id = \"x\"\n");
    only(
        &changed,
        Severity::Error,
        None,
        &["protocol.toml", "has been changed"],
    );
    let other = write("materials/manifest.json", "{\"pairs\": []}");
    only(
        &other,
        Severity::Error,
        None,
        &["0 images, study.json has 6"],
    );
    let gone = found(|study| remove(study, "materials/protocol.toml"));
    only(&gone, Severity::Error, None, &["protocol.toml"]);
    let undescribed = found(|study| remove(study, "dataset_description.json"));
    only(
        &undescribed,
        Severity::Warning,
        None,
        &["dataset_description.json"],
    );
}
