//! Exports: nothing lost, nothing that was not asked for, whole or not at all.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use time::OffsetDateTime;
use time::macros::datetime;

use super::{Draft, Exported, FORMATS, Format, Material, Selection, bids, csv, export, pwcmp};
use crate::protocol::{Condition, Phase};
use crate::record::read::parse;
use crate::record::tests::{lines::any_row, row};
use crate::record::{
    ParticipantId, RecordError, Study, StudyIdentity, TrialRow, line, read_folder, read_rows,
};

const NOW: OffsetDateTime = datetime!(2026-03-01 10:00 UTC);

fn condition(id: &str) -> Condition {
    Condition {
        id: id.to_owned(),
        scene: "atrium".to_owned(),
        techniques: vec!["none".to_owned(), "blizzard24".to_owned()],
        reference: None,
        hypothesis: "H1".to_owned(),
    }
}

/// P01 and P-02 with three rows each, P03 rejected, T01 a try-out.
fn study(folder: &Path) -> Study {
    let identity = StudyIdentity {
        study_id: "s-1".to_owned(),
        protocol_hash: "ab".repeat(32),
        conditions: ["c0", "c1", "c2"].map(condition).into(),
        image_sha256: Vec::new(),
    };
    let mut study = Study::open(folder, identity, "the protocol\n").unwrap();
    for (name, pilot) in [
        ("P01", false),
        ("P-02", false),
        ("P03", false),
        ("T01", true),
    ] {
        study = study.pilot(pilot);
        let id = ParticipantId::new(name).unwrap();
        let mut enrolment = study.enrol(&id, "=lab \"n/a\"", NOW).unwrap();
        for trial in 0..3 {
            let row = TrialRow {
                station_id: "=lab \"n/a\"".to_owned(),
                slot: enrolment.slot,
                pilot,
                ..row(name, trial)
            };
            enrolment.log.append_row(&row).unwrap();
        }
    }
    let study = study.pilot(false);
    let rejected = ParticipantId::new("P03").unwrap();
    study.reject(&rejected, "=slept\tdeeply", NOW).unwrap();
    study
}

fn format(name: &str) -> &'static Format {
    FORMATS.iter().find(|format| format.name == name).unwrap()
}

fn everything() -> Selection {
    Selection {
        include_pilot: true,
        include_rejected: true,
    }
}

/// Every file under a folder.
fn files(folder: &Path) -> BTreeMap<PathBuf, String> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                found.insert(name, fs::read_to_string(&path).unwrap());
            }
        }
    }
    found
}

fn exported(name: &str, selection: Selection) -> (Exported, BTreeMap<PathBuf, String>) {
    let folder = tempfile::tempdir().unwrap();
    let results = folder.path().join("results");
    study(&results);
    let before = files(&results);
    let out = folder.path().join("out");
    let done = export(&results, format(name), selection, &out).unwrap();
    assert_eq!(files(&results), before, "the results are as they were");
    let files = files(&out);
    let names: Vec<PathBuf> = files.keys().cloned().collect();
    let mut told = done.files.clone();
    told.sort();
    assert_eq!(told, names);
    let beside = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(beside, 2, "no draft is left");
    (done, files)
}

#[test]
fn pilots_and_rejected_participants_are_left_out_and_counted_unless_asked_for() {
    for format in FORMATS {
        let (done, _) = exported(format.name, Selection::default());
        assert_eq!(done.rows, 6, "{}", format.name);
        let told = done.notes.join("\n");
        assert!(told.contains("3 rows of pilot sessions"), "{told}");
        assert!(told.contains("3 rows of rejected participants"), "{told}");
        assert!(told.contains("(P03)"), "{told}");
        let (done, _) = exported(format.name, everything());
        assert_eq!(done.rows, 12, "{}", format.name);
        assert!(
            !done.notes.join("\n").contains("left out"),
            "{:?}",
            done.notes
        );
    }
}

#[test]
fn the_flat_file_has_every_row_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let (results, out) = (folder.path().join("results"), folder.path().join("out"));
    study(&results);
    // An empty folder may be named.
    fs::create_dir(&out).unwrap();
    export(&results, format("csv"), everything(), &out).unwrap();
    let read = read_rows(&out.join("rows.csv")).unwrap();
    assert!(read.warnings.is_empty());
    assert_eq!(read.rows, read_folder(&results).unwrap().rows);
}

#[test]
fn psych_ds_is_a_folder_of_described_files() {
    let (_, files) = exported("psych-ds", Selection::default());
    let names: Vec<&str> = files.keys().filter_map(|name| name.to_str()).collect();
    assert_eq!(
        names,
        [
            "README.md",
            "data/study-s1_subject-P01_session-1_data.csv",
            // CRC-32 of "P-02"
            "data/study-s1_subject-P02xcd4d627e_session-1_data.csv",
            "dataset_description.json",
            "materials/protocol.toml",
        ]
    );
    let text = &files[Path::new("dataset_description.json")];
    let description: serde_json::Value = serde_json::from_str(text).unwrap();
    let measured = description["variableMeasured"].as_array().unwrap();
    let described: Vec<&str> = measured
        .iter()
        .map(|variable| variable["name"].as_str().unwrap())
        .collect();
    let data = files.iter().filter(|(name, _)| name.starts_with("data"));
    for (_, text) in data {
        let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        assert_eq!(header, described);
    }
}

/// The names and keys that BIDS asks for; the tables hold every cell of every row.
#[test]
fn bids_is_a_dataset_by_its_rules() {
    let (_, files) = exported("bids", everything());
    let json = |name: &str| -> serde_json::Value {
        serde_json::from_str(&files[Path::new(name)]).unwrap()
    };
    let description = json("dataset_description.json");
    for key in ["Name", "BIDSVersion"] {
        assert!(description[key].is_string(), "{key}");
    }
    assert_eq!(description["DatasetType"], "raw");
    assert!(!files[Path::new("README")].is_empty());
    let participants = &files[Path::new("participants.tsv")];
    let subjects: Vec<&str> = participants
        .lines()
        .skip(1)
        .map(|line| line.split('\t').next().unwrap())
        .collect();
    assert_eq!(subjects.len(), 4);
    assert!(
        participants.contains("\t'=slept deeply\n"),
        "{participants}"
    );
    for subject in subjects {
        let label = subject.strip_prefix("sub-").unwrap();
        assert!(label.chars().all(|c| c.is_ascii_alphanumeric()), "{label}");
        let stem = format!("{subject}/beh/{subject}_task-s1_beh");
        let sidecar = json(&format!("{stem}.json"));
        let table = &files[Path::new(&format!("{stem}.tsv"))];
        for column in table.lines().next().unwrap().split('\t') {
            assert!(sidecar[column]["Description"].is_string(), "{column}");
        }
        assert_eq!(sidecar["response_ns"]["Units"], "ns");
        assert_eq!(sidecar["pilot"]["Levels"]["true"], "true");
        assert_eq!(table.lines().count(), 4);
        assert!(table.contains("\tn/a\t"), "missed_frames is missing");
    }
}

fn material(rows: Vec<TrialRow>, conditions: Vec<Condition>) -> Material {
    Material {
        identity: StudyIdentity {
            study_id: "s".to_owned(),
            protocol_hash: String::new(),
            conditions,
            image_sha256: Vec::new(),
        },
        protocol: None,
        sessions: vec![super::material::Session {
            participant: "P01".to_owned(),
            file: String::new(),
            rows,
            about: None,
            standing: None,
        }],
        notes: Vec::new(),
    }
}

/// Reads a BIDS table back into the cells of data files.
fn cells_of_bids(text: &[u8]) -> Vec<Vec<String>> {
    let mut reader = ::csv::ReaderBuilder::new()
        .delimiter(b'\t')
        .from_reader(text);
    let cell = |cell: &str| match cell {
        "n/a" => String::new(),
        "'n/a" => "n/a".to_owned(),
        other => other.to_owned(),
    };
    reader
        .records()
        .map(|record| record.unwrap().iter().map(cell).collect())
        .collect()
}

proptest! {
    #[test]
    fn the_flat_file_loses_nothing(rows in prop::collection::vec(any_row(), 0..5)) {
        let rows: Vec<TrialRow> = (0..).zip(rows)
            .map(|(n, row)| TrialRow { row_id: format!("P01:1:main:{n}"), ..row })
            .collect();
        let bytes = csv::rows_file(rows.iter()).unwrap();
        prop_assert_eq!(parse(Path::new("f"), &bytes).unwrap().rows, rows);
    }

    #[test]
    fn a_bids_table_loses_nothing(row in any_row(), station in "[=+@'\"n/a \t,-]{1,6}") {
        let row = TrialRow { station_id: station, ..row };
        let bytes = bids::table(std::slice::from_ref(&row)).unwrap();
        prop_assert_eq!(cells_of_bids(&bytes), [line::cells(&row).unwrap()]);
        // And the cells are the row: their line reads back.
        let whole = parse(Path::new("f"), &csv::rows_file([&row].into_iter()).unwrap()).unwrap();
        prop_assert_eq!(whole.rows, [row]);
    }
}

proptest! {
    // Each case writes and syncs three exports.
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_cell_of_any_export_is_a_formula(row in any_row(), evil in "[=+@-][a-z0-9()]{0,8}") {
        let row = TrialRow {
            station_id: evil.clone(),
            technique_first: evil.clone(),
            chosen_technique: Some(evil.clone()),
            condition: evil.clone(),
            scene: evil,
            ..row
        };
        let out = tempfile::tempdir().unwrap();
        let material = material(vec![row], Vec::new());
        let mut draft = Draft::new(&out.path().join("out")).unwrap();
        (pwcmp::PWCMP.write)(&material, &mut draft).unwrap();
        (bids::BIDS.write)(&material, &mut draft).unwrap();
        (csv::CSV.write)(&material, &mut draft).unwrap();
        for (name, delimiter) in [
            ("comparisons.csv", b','),
            ("rows.csv", b','),
            ("sub-P01/beh/sub-P01_task-s_beh.tsv", b'\t'),
        ] {
            let bytes = fs::read(draft.folder.join(name)).unwrap();
            let mut reader = ::csv::ReaderBuilder::new().delimiter(delimiter).from_reader(&bytes[..]);
            for record in reader.records() {
                for cell in record.unwrap().iter() {
                    prop_assert!(!cell.starts_with(['=', '+', '-', '@']), "{name}: {cell}");
                }
            }
        }
    }
}

/// A is the first technique of the base order, whichever was shown first.
#[test]
fn pwcmp_tells_who_won_in_the_base_order() {
    let reversed = |row: TrialRow| TrialRow {
        technique_first: row.technique_second,
        technique_second: row.technique_first,
        first_image_sha256: row.second_image_sha256,
        second_image_sha256: row.first_image_sha256,
        ..row
    };
    let chose = |row: TrialRow, technique: &str| TrialRow {
        chosen_technique: Some(technique.to_owned()),
        ..row
    };
    let rows = vec![
        chose(row("P01", 0), "none"),
        chose(row("P01", 1), "blizzard24"),
        reversed(chose(row("P01", 2), "none")),
        reversed(chose(row("P01", 0), "blizzard24")),
        TrialRow {
            phase: Phase::Catch,
            ..row("P01", 1)
        },
        TrialRow {
            response: None,
            chosen_technique: None,
            ..row("P01", 2)
        },
    ];
    let out = tempfile::tempdir().unwrap();
    let mut draft = Draft::new(&out.path().join("out")).unwrap();
    draft.rows = rows.len();
    let material = material(rows, ["c0", "c1", "c2"].map(condition).into());
    (pwcmp::PWCMP.write)(&material, &mut draft).unwrap();
    let text = fs::read_to_string(draft.folder.join("comparisons.csv")).unwrap();
    assert_eq!(
        text,
        "observer,session,scene,condition_A,condition_B,is_A_selected\n\
         P01,1,atrium,none,blizzard24,1\n\
         P01,1,atrium,none,blizzard24,0\n\
         P01,1,atrium,none,blizzard24,1\n\
         P01,1,atrium,none,blizzard24,0\n"
    );
    assert_eq!(draft.rows, 4);
    assert!(
        draft.notes[0].starts_with("1 practice and catch"),
        "{:?}",
        draft.notes
    );
    assert!(
        draft.notes[1].starts_with("1 rows without a choice"),
        "{:?}",
        draft.notes
    );
}

/// One scene under two lights must not be scaled as one; two questions that share an
/// image must.
#[test]
fn pwcmp_joins_conditions_that_share_an_image_and_parts_those_that_do_not() {
    let with = |trial: u32, first: &str, second: &str| TrialRow {
        first_image_sha256: first.to_owned(),
        second_image_sha256: second.to_owned(),
        ..row("P01", trial)
    };
    let rows = vec![with(0, "a", "b"), with(1, "c", "d"), with(2, "e", "b")];
    let out = tempfile::tempdir().unwrap();
    let mut draft = Draft::new(&out.path().join("out")).unwrap();
    draft.rows = rows.len();
    let material = material(rows, ["c0", "c1", "c2"].map(condition).into());
    (pwcmp::PWCMP.write)(&material, &mut draft).unwrap();
    let text = fs::read_to_string(draft.folder.join("comparisons.csv")).unwrap();
    let scenes: Vec<&str> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(2).unwrap())
        .collect();
    assert_eq!(scenes, ["atrium/c0", "atrium/c1", "atrium/c0"]);
}

#[test]
fn a_place_that_is_taken_is_refused_and_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (results, out) = (folder.path().join("results"), folder.path().join("out"));
    study(&results);
    fs::create_dir(&out).unwrap();
    fs::write(out.join("mine"), "mine").unwrap();
    for format in FORMATS {
        let error = export(&results, format, everything(), &out).unwrap_err();
        assert!(matches!(error, RecordError::ExportTaken { .. }), "{error}");
        assert_eq!(files(&out).len(), 1);
    }
    // Neither is a file a folder, nor any folder a results folder.
    let file = out.join("mine");
    assert!(export(&results, format("csv"), everything(), &file).is_err());
    let error = export(&out, format("csv"), everything(), &folder.path().join("x")).unwrap_err();
    assert!(matches!(error, RecordError::NoStudy { .. }), "{error}");
}

#[test]
fn an_export_that_fails_leaves_nothing() {
    const FAILS: Format = Format {
        name: "fails",
        summary: "",
        write: |_, draft| {
            draft.file("first", b"whole")?;
            draft.file("first/second", b"cannot be")
        },
    };
    let folder = tempfile::tempdir().unwrap();
    let (results, out) = (folder.path().join("results"), folder.path().join("out"));
    study(&results);
    export(&results, &FAILS, everything(), &out).unwrap_err();
    assert!(!out.exists());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
