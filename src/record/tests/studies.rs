//! Results folders: who may open them, who holds which slot, who may go on.

use std::path::Path;

use time::OffsetDateTime;
use time::macros::datetime;

use super::row;
use crate::protocol::Condition;
use crate::record::{ParticipantId, RecordError, Study, StudyIdentity};

pub(super) const NOW: OffsetDateTime = datetime!(2026-03-01 10:00 UTC);

pub(super) fn identity() -> StudyIdentity {
    StudyIdentity {
        study_id: "thesis-2010".to_owned(),
        protocol_hash: "ab".repeat(32),
        conditions: ["c0", "c1", "c2"]
            .map(|id| Condition {
                id: id.to_owned(),
                scene: "atrium".to_owned(),
                techniques: vec!["none".to_owned(), "blizzard24".to_owned()],
                reference: None,
                hypothesis: "H1".to_owned(),
            })
            .into(),
        image_sha256: vec!["cd".repeat(32)],
    }
}

pub(super) fn open(folder: &Path) -> Study {
    Study::open(folder, identity(), "the protocol\n").unwrap()
}

pub(super) fn id(text: &str) -> ParticipantId {
    ParticipantId::new(text).unwrap()
}

pub(super) fn answer(study: &Study, participant: &str, trials: std::ops::Range<u32>) {
    let mut enrolment = match study.answered(&id(participant)).unwrap() {
        None => study.enrol(&id(participant), "lab", NOW).unwrap(),
        Some(_) => study.resume(&id(participant), "lab", NOW).unwrap(),
    };
    for trial in trials {
        enrolment.log.append_row(&row(participant, trial)).unwrap();
    }
}

#[test]
fn ids_that_are_not_safe_everywhere_are_refused() {
    for text in [
        "",
        "-P1",
        "_P1",
        "a b",
        "ä",
        "../x",
        "a/b",
        "P1\n",
        "=1",
        &"x".repeat(65),
    ] {
        let message = ParticipantId::new(text).unwrap_err().to_string();
        assert!(message.contains("64 at most"), "{message}");
    }
    for text in ["P01", "a-b_c", "0", &"x".repeat(64)] {
        assert!(ParticipantId::new(text).is_ok(), "{text}");
    }
}

#[test]
fn every_id_has_a_file_name_of_its_own_that_psych_ds_allows() {
    let names: std::collections::HashSet<String> = ["P01", "P-01", "P_01", "P0_1", "P0-1"]
        .map(|text| id(text).file_value())
        .into();
    assert_eq!(names.len(), 5);
    assert!(names.contains("P01"));
    for name in names {
        assert!(name.chars().all(|c| c.is_ascii_alphanumeric()), "{name}");
    }
}

#[test]
fn a_folder_has_the_layout_of_psych_ds() {
    let folder = tempfile::tempdir().unwrap();
    answer(&open(folder.path()), "P01", 0..1);
    let data = folder
        .path()
        .join("data/study-thesis2010_subject-P01_session-1_data.csv");
    let text = std::fs::read_to_string(data).unwrap();
    let description: serde_json::Value = serde_json::from_slice(
        &std::fs::read(folder.path().join("dataset_description.json")).unwrap(),
    )
    .unwrap();
    // The rules of Psych-DS: these keys, and every column of every file described.
    assert_eq!(description["@context"], "https://schema.org/");
    assert_eq!(description["@type"], "Dataset");
    assert!(description["name"].is_string() && description["description"].is_string());
    let described: Vec<&str> = description["variableMeasured"]
        .as_array()
        .unwrap()
        .iter()
        .map(|variable| {
            assert_eq!(variable["@type"], "PropertyValue");
            variable["name"].as_str().unwrap()
        })
        .collect();
    let columns: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert_eq!(columns, described);
    let protocol = std::fs::read(folder.path().join("materials/protocol.toml")).unwrap();
    assert_eq!(protocol, b"the protocol\n");
}

#[test]
fn a_folder_belongs_to_one_protocol_one_set_of_conditions_and_its_images() {
    let folder = tempfile::tempdir().unwrap();
    open(folder.path());
    let refusal = |change: fn(&mut StudyIdentity)| {
        let mut other = identity();
        change(&mut other);
        Study::open(folder.path(), other, "").unwrap_err()
    };
    let error = refusal(|other| other.protocol_hash = "00".repeat(32));
    assert!(
        matches!(error, RecordError::OtherProtocol { .. }),
        "{error}"
    );
    assert!(error.to_string().contains(&"ab".repeat(32)), "{error}");
    let error = refusal(|other| other.conditions.truncate(2));
    assert!(
        matches!(error, RecordError::OtherConditions { .. }),
        "{error}"
    );
    let error = refusal(|other| other.image_sha256 = vec![]);
    assert!(matches!(error, RecordError::OtherImages { .. }), "{error}");
    open(folder.path());
}

#[test]
fn an_id_is_taken_once() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..2);
    let message = study.enrol(&id("P01"), "lab", NOW).unwrap_err().to_string();
    assert!(message.contains("2 trials on record"), "{message}");
    assert_eq!(study.next_slot().unwrap(), 1, "no slot was used up");
}

#[test]
fn an_interrupted_session_goes_on_in_its_slot() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P00", 0..3);
    answer(&study, "P01", 0..1);
    let later = NOW + time::Duration::minutes(5);
    let enrolment = study.resume(&id("P01"), "lab", later).unwrap();
    assert_eq!((enrolment.slot, enrolment.segment), (1, 2));
    assert_eq!(enrolment.rows, [row("P01", 0)]);
    // The row was answered after the claim.
    assert_eq!(
        enrolment.interrupted_utc,
        Some(datetime!(2026-03-01 10:00:11.2345 UTC))
    );
    drop(enrolment);
    let again = study.resume(&id("P01"), "lab", later).unwrap();
    assert_eq!(again.segment, 3);
    assert_eq!(
        again.interrupted_utc,
        Some(later),
        "the resume is on record"
    );
}

#[test]
fn what_cannot_be_resumed_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..3);
    let error = study.resume(&id("P01"), "lab", NOW).unwrap_err();
    assert!(matches!(error, RecordError::Finished { .. }), "{error}");
    let error = study.resume(&id("P02"), "lab", NOW).unwrap_err();
    assert!(
        matches!(error, RecordError::UnknownParticipant { .. }),
        "{error}"
    );
    let running = study.enrol(&id("P03"), "lab", NOW).unwrap();
    let error = study.resume(&id("P03"), "lab", NOW).unwrap_err();
    assert!(matches!(error, RecordError::InUse { .. }), "{error}");
    let error = study.release(&id("P03"), "left", NOW).unwrap_err();
    assert!(matches!(error, RecordError::InUse { .. }), "{error}");
    drop(running);
}

#[test]
fn a_crash_between_the_file_and_the_slot_is_mended_by_the_resume() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    drop(study.enrol(&id("P01"), "lab", NOW).unwrap());
    std::fs::remove_file(folder.path().join("slots/slot-0000_claim-1.json")).unwrap();
    let enrolment = study.resume(&id("P01"), "lab", NOW).unwrap();
    assert_eq!(enrolment.slot, 0);
    assert_eq!(study.next_slot().unwrap(), 1);
}

#[test]
fn try_outs_leave_no_holes_in_the_design() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path()).pilot(true);
    let pilot = study.enrol(&id("T01"), "lab", NOW).unwrap();
    assert_eq!((pilot.slot, pilot.pilot), (0, true));
    drop(pilot);
    let study = study.pilot(false);
    assert_eq!(study.next_slot().unwrap(), 0);
    // Also when it is resumed from the study proper, a try-out stays one.
    assert!(study.resume(&id("T01"), "lab", NOW).unwrap().pilot);
}

#[test]
fn a_station_name_fits_on_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    for station in ["", "two\nlines", &"x".repeat(65)] {
        let error = study.enrol(&id("P01"), station, NOW).unwrap_err();
        assert!(matches!(error, RecordError::Station { .. }), "{error}");
    }
    assert_eq!(study.answered(&id("P01")).unwrap(), None);
}
