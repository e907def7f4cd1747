//! What an experimenter decides about participants: nothing is lost by it, and it can
//! be taken back.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::studies::{NOW, answer, id, identity, open};
use crate::record::{RecordError, Study, TrialRow, read_folder, rejections};

/// Every file of a folder and its bytes.
fn files_of(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for part in ["slots", "data"] {
        for entry in std::fs::read_dir(folder.join(part)).unwrap() {
            let path = entry.unwrap().path();
            files.insert(path.clone(), std::fs::read(&path).unwrap());
        }
    }
    files
}

/// What was on record before is there after, as it was.
fn assert_only_added(before: &BTreeMap<PathBuf, Vec<u8>>, folder: &Path) {
    let after = files_of(folder);
    for (path, bytes) in before {
        let now = after.get(path).map(Vec::as_slice);
        assert_eq!(now, Some(bytes.as_slice()), "{}", path.display());
    }
}

/// Participant, slot, rows, released, rejected.
fn told(study: &Study) -> Vec<(String, u32, usize, bool, bool)> {
    let standings = study.standings().unwrap().into_iter();
    standings
        .map(|s| {
            let (released, rejected) = (s.released.is_some(), s.rejected.is_some());
            (s.participant, s.slot, s.answered, released, rejected)
        })
        .collect()
}

#[test]
fn a_drop_outs_slot_goes_to_the_next_and_both_stay_on_record() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..1);
    answer(&study, "P02", 0..3);
    assert_eq!(study.release(&id("P01"), "fire alarm", NOW).unwrap(), 0);
    let error = study.resume(&id("P01"), "lab", NOW).unwrap_err();
    assert!(
        matches!(error, RecordError::Released { slot: 0, .. }),
        "{error}"
    );
    let again = study.release(&id("P01"), "twice", NOW).unwrap_err();
    assert!(again.to_string().contains("fire alarm"), "{again}");
    assert_eq!(study.enrol(&id("P03"), "lab", NOW).unwrap().slot, 0);
    assert_eq!(study.next_slot().unwrap(), 2);
    assert_eq!(
        told(&study),
        [
            ("P01".to_owned(), 0, 1, true, false),
            ("P03".to_owned(), 0, 0, false, false),
            ("P02".to_owned(), 1, 3, false, false),
        ]
    );
    let released = study.standings().unwrap()[0].released.clone().unwrap();
    assert_eq!(released.reason, "fire alarm");
    let rows: Vec<TrialRow> = read_folder(folder.path()).unwrap().rows;
    assert_eq!(rows.len(), 4);
}

#[test]
fn a_rejection_marks_the_data_and_can_be_taken_back_any_number_of_times() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..3);
    answer(&study, "P02", 0..3);
    for round in 1..=3 {
        let before = files_of(folder.path());
        study.reject(&id("P01"), "slept", NOW).unwrap();
        assert_eq!(study.rejected_ids().unwrap(), ["P01".to_owned()].into());
        assert_eq!(rejections(folder.path()).unwrap()["P01"].reason, "slept");
        let again = study.reject(&id("P01"), "still", NOW).unwrap_err();
        assert!(again.to_string().contains("slept"), "{again}");
        assert_only_added(&before, folder.path());
        let before = files_of(folder.path());
        let taken_back = study.reinstate(&id("P01"), "was awake", NOW).unwrap();
        assert!(!taken_back.took_slot_back);
        assert_only_added(&before, folder.path());
        assert!(study.rejected_ids().unwrap().is_empty());
        let name = format!("slots/slot-0000_claim-1_reinstated-{round}.json");
        assert!(folder.path().join(name).exists());
    }
    let error = study.reinstate(&id("P01"), "", NOW).unwrap_err();
    assert!(
        matches!(error, RecordError::NothingToReinstate { .. }),
        "{error}"
    );
    // A rejected participant keeps the slot until it is released.
    study.reject(&id("P01"), "slept", NOW).unwrap();
    assert_eq!(study.next_slot().unwrap(), 2);
    study.release(&id("P01"), "slept", NOW).unwrap();
    assert_eq!(study.next_slot().unwrap(), 0);
    assert_eq!(told(&study)[0], ("P01".to_owned(), 0, 3, true, true));
}

#[test]
fn a_released_participant_takes_the_slot_back_and_the_session_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..1);
    answer(&study, "P01", 1..2);
    study.release(&id("P01"), "ill", NOW).unwrap();
    study.reject(&id("P01"), "ill", NOW).unwrap();
    let taken_back = study.reinstate(&id("P01"), "well again", NOW).unwrap();
    assert_eq!((taken_back.slot, taken_back.took_slot_back), (0, true));
    assert!(folder.path().join("slots/slot-0000_claim-2.json").exists());
    assert_eq!(
        told(&study),
        [("P01".to_owned(), 0, 2, false, false)],
        "one participant, not two"
    );
    assert_eq!(study.next_slot().unwrap(), 1);
    // Segments 1 and 2 were before the release.
    let enrolment = study.resume(&id("P01"), "lab", NOW).unwrap();
    assert_eq!((enrolment.slot, enrolment.segment), (0, 3));
    drop(enrolment);
    assert_eq!(study.resume(&id("P01"), "lab", NOW).unwrap().segment, 4);
}

#[test]
fn a_slot_somebody_has_taken_is_not_taken_back() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..1);
    study.reject(&id("P01"), "left", NOW).unwrap();
    study.release(&id("P01"), "left", NOW).unwrap();
    answer(&study, "P02", 0..1);
    let before = files_of(folder.path());
    let error = study.reinstate(&id("P01"), "", NOW).unwrap_err();
    assert!(
        matches!(&error, RecordError::SlotTaken { holder, slot: 0, .. } if holder == "P02"),
        "{error}"
    );
    assert!(error.to_string().contains("\"P02\""), "{error}");
    assert_eq!(files_of(folder.path()), before, "nothing was changed");
    assert!(!study.rejected_ids().unwrap().is_empty());
    // Once the other one has left too, it is free.
    study.release(&id("P02"), "left too", NOW).unwrap();
    assert_eq!(study.reinstate(&id("P01"), "", NOW).unwrap().slot, 0);
    assert!(folder.path().join("slots/slot-0000_claim-3.json").exists());
    assert!(study.rejected_ids().unwrap().is_empty());
    let error = study.reinstate(&id("P02"), "", NOW).unwrap_err();
    assert!(
        matches!(&error, RecordError::SlotTaken { holder, .. } if holder == "P01"),
        "{error}"
    );
}

#[test]
fn nothing_is_decided_about_a_running_session_or_somebody_unknown() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    let running = study.enrol(&id("P01"), "lab", NOW).unwrap();
    for error in [
        study.release(&id("P01"), "x", NOW).unwrap_err(),
        study.reject(&id("P01"), "x", NOW).unwrap_err(),
        study.reinstate(&id("P01"), "x", NOW).unwrap_err(),
    ] {
        assert!(matches!(error, RecordError::InUse { .. }), "{error}");
    }
    drop(running);
    let error = study.reject(&id("P02"), "x", NOW).unwrap_err();
    assert!(
        matches!(error, RecordError::UnknownParticipant { .. }),
        "{error}"
    );
    std::fs::remove_file(folder.path().join("slots/slot-0000_claim-1.json")).unwrap();
    let error = open(folder.path())
        .reject(&id("P01"), "x", NOW)
        .unwrap_err();
    assert!(matches!(error, RecordError::NoSlot { .. }), "{error}");
}

#[test]
fn a_try_out_can_be_decided_about_from_the_study_proper() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path()).pilot(true);
    answer(&study, "T01", 0..1);
    let study = study.pilot(false);
    study.reject(&id("T01"), "x", NOW).unwrap();
    assert_eq!(study.rejected_ids().unwrap(), ["T01".to_owned()].into());
    assert!(study.standings().unwrap().is_empty());
    let pilots = study.pilot(true).standings().unwrap();
    assert!(pilots[0].pilot && pilots[0].rejected.is_some());
}

#[test]
fn a_folder_is_opened_as_it_is_and_nothing_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let error = Study::open_existing(folder.path()).unwrap_err();
    assert!(matches!(error, RecordError::NoStudy { .. }), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    answer(&open(folder.path()), "P01", 0..2);
    let study = Study::open_existing(folder.path()).unwrap();
    assert_eq!(study.identity(), &identity());
    assert_eq!(told(&study), [("P01".to_owned(), 0, 2, false, false)]);
    let error = study.protocol().unwrap_err().to_string();
    assert!(error.contains("materials/protocol.toml:1"), "{error}");
}

/// The repair of a line that a crash has cut off is on record with the resume.
#[test]
fn a_mended_line_is_told_and_on_record() {
    let folder = tempfile::tempdir().unwrap();
    let study = open(folder.path());
    answer(&study, "P01", 0..2);
    let path = study.data_path(&id("P01"));
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 20]).unwrap();
    let enrolment = study.resume(&id("P01"), "lab", NOW).unwrap();
    assert_eq!(enrolment.rows.len(), 1);
    let warning = &enrolment.warnings[0];
    assert!(warning.contains("_data.csv:3: "), "{warning}");
    assert!(warning.contains("cut off by a crash"), "{warning}");
    drop(enrolment);
    let segment = |number: u32| -> serde_json::Value {
        let name = format!("slots/slot-0000_claim-1_segment-{number}.json");
        serde_json::from_slice(&std::fs::read(folder.path().join(name)).unwrap()).unwrap()
    };
    assert_eq!(segment(2)["ended_torn_line"], 3);
    assert_eq!(segment(2)["damaged_lines"], serde_json::json!([3]));
    drop(study.resume(&id("P01"), "lab", NOW).unwrap());
    assert_eq!(segment(3).get("ended_torn_line"), None);
    assert_eq!(segment(3)["damaged_lines"], serde_json::json!([3]));
}
