//! Rows as lines, and lines that were cut off.

use std::path::Path;

use proptest::prelude::*;

use super::row;
use crate::record::columns::COLUMNS;
use crate::record::log::RowLog;
use crate::record::read::{Flaw, parse, read_rows};
use crate::record::{InputDevice, RecordError, TrialRow, line};

fn file_of(rows: &[TrialRow]) -> Vec<u8> {
    let mut bytes = line::header().into_bytes();
    for row in rows {
        bytes.extend(line::encode(row).unwrap());
    }
    bytes
}

#[test]
fn the_columns_described_are_the_columns_written() {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.serialize(row("P01", 0)).unwrap();
    let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
    let written: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let described: Vec<&str> = COLUMNS.iter().map(|column| column.name).collect();
    assert_eq!(written, described[..described.len() - 1]);
    assert_eq!(described[described.len() - 1], "row_crc32");
}

/// CRC-32 of "123456789" is cbf43926: the check value of the CRC catalogue.
#[test]
fn the_checksum_is_the_common_crc32() {
    assert_eq!(
        line::checked(b"123456789,xcbf43926"),
        Some(&b"123456789"[..])
    );
    assert_eq!(line::checked(b"123456780,xcbf43926"), None);
    assert_eq!(line::checked(b""), None);
}

#[test]
fn a_formula_is_neutral_in_the_file_and_itself_again_when_read() {
    let mut dangerous = row("P01", 0);
    dangerous.station_id = "=HYPERLINK(\"x\")".to_owned();
    let bytes = file_of(&[dangerous.clone()]);
    let text = String::from_utf8(bytes.clone()).unwrap();
    assert!(text.contains("'=HYPERLINK"), "{text}");
    assert_eq!(parse(Path::new("f"), &bytes).unwrap().rows, [dangerous]);
}

#[test]
fn a_line_break_in_a_row_is_refused() {
    let mut broken = row("P01", 0);
    broken.station_id = "two\nlines".to_owned();
    assert!(line::encode(&broken).is_err());
}

#[test]
fn another_programs_file_is_not_taken_for_data() {
    for text in ["a,b,c\n1,2,3\n", "\n", "row_id,x\n"] {
        let message = parse(Path::new("f.csv"), text.as_bytes())
            .unwrap_err()
            .to_string();
        assert!(message.starts_with("f.csv:1:"), "{message}");
    }
}

#[test]
fn an_edited_row_and_a_repeated_one_are_passed_over_with_a_warning() {
    let mut bytes = file_of(&[row("P01", 0), row("P01", 1), row("P01", 1)]);
    let text = String::from_utf8(bytes.clone()).unwrap();
    bytes = text.replacen(",second,", ",first,", 1).into_bytes();
    let read = parse(Path::new("f.csv"), &bytes).unwrap();
    assert_eq!(read.rows, [row("P01", 1)]);
    let flaws: Vec<(u64, Flaw)> = read.warnings.iter().map(|w| (w.line, w.flaw)).collect();
    assert_eq!(flaws, [(2, Flaw::Damaged), (4, Flaw::Repeated)]);
    assert!(read.warnings[0].to_string().starts_with("f.csv:2: "));
}

#[test]
fn line_ends_of_windows_do_no_harm() {
    let text = String::from_utf8(file_of(&[row("P01", 0)])).unwrap();
    let read = parse(Path::new("f"), text.replace('\n', "\r\n").as_bytes()).unwrap();
    assert_eq!((read.rows, read.warnings), (vec![row("P01", 0)], vec![]));
}

/// A crash may leave any first part of what was written. Wherever it cuts, no
/// whole row is lost, no part is taken for a row, and the session goes on.
#[test]
fn a_file_cut_off_anywhere_keeps_its_whole_rows_and_takes_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let rows = [row("P01", 0), row("P01", 1)];
    let whole = file_of(&rows);
    let ends: Vec<usize> = (0..=2).map(|count| file_of(&rows[..count]).len()).collect();
    // Every byte around the ends of lines, every seventh between (each costs three syncs).
    let near_an_end = |cut: usize| ends.iter().any(|&end| cut.abs_diff(end) <= 12);
    for cut in (0..=whole.len()).filter(|&cut| cut % 7 == 0 || near_an_end(cut)) {
        let path = folder.path().join(format!("{cut}.csv"));
        std::fs::write(&path, &whole[..cut]).unwrap();
        // A row that lacks nothing but its line break is whole.
        let count = ends[1..].iter().filter(|&&end| cut + 1 >= end).count();
        let torn = cut + 1 < whole.len()
            && cut >= ends[0]
            && !ends.contains(&cut)
            && !ends.contains(&(cut + 1));
        let (mut log, read) = RowLog::reopen(&path, "P01").unwrap();
        assert_eq!(read.rows, rows[..count], "cut at {cut}");
        assert_eq!(read.warnings.len(), usize::from(torn), "cut at {cut}");
        log.append_row(&row("P01", 2)).unwrap();
        let read = read_rows(&path).unwrap();
        let mut expected = rows[..count].to_vec();
        expected.push(row("P01", 2));
        assert_eq!(read.rows, expected, "cut at {cut}");
        let bytes = std::fs::read(&path).unwrap();
        assert!(bytes.starts_with(&whole[..cut]), "nothing is taken away");
    }
}

#[test]
fn a_removed_data_file_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x_data.csv");
    let mut log = RowLog::create(&path).unwrap().unwrap();
    log.append_row(&row("P01", 0)).unwrap();
    std::fs::remove_file(&path).unwrap();
    let message = log.append_row(&row("P01", 1)).unwrap_err().to_string();
    assert!(message.contains("removed or replaced"), "{message}");
}

#[test]
fn a_session_is_open_in_one_place_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x_data.csv");
    let log = RowLog::create(&path).unwrap().unwrap();
    assert!(matches!(
        RowLog::reopen(&path, "P01"),
        Err(RecordError::InUse { .. })
    ));
    drop(log);
    assert!(RowLog::reopen(&path, "P01").is_ok());
}

prop_compose! {
    pub(crate) fn any_row()(
        station_id in "[^\\p{C}]{1,64}",
        technique_first in "[=+@'\" ,;a-z0-9-]{1,20}",
        times in prop::array::uniform8(prop::option::of(any::<u64>())),
        response_time_ms in prop::option::of(0.0_f64..1e9),
        missed_frames in prop::option::of(any::<u32>()),
        pilot: bool,
        resume_gap_ms in prop::option::of(any::<u64>()),
    ) -> TrialRow {
        TrialRow {
            station_id,
            chosen_technique: Some(technique_first.clone()),
            technique_first,
            first_onset_ns: times[0],
            first_offset_ns: times[1],
            grey_onset_ns: times[2],
            grey_offset_ns: times[3],
            second_onset_ns: times[4],
            second_offset_ns: times[5],
            question_onset_ns: times[6],
            response_ns: times[7],
            response_time_ms,
            missed_frames,
            pilot,
            resume_gap_ms,
            input_device: InputDevice::Gamepad,
            ..row("P01", 0)
        }
    }
}

proptest! {
    #[test]
    fn every_row_comes_back_as_it_was(row in any_row()) {
        let bytes = file_of(std::slice::from_ref(&row));
        let read = parse(Path::new("f"), &bytes).unwrap();
        prop_assert_eq!(read.rows, [row]);
        prop_assert!(read.warnings.is_empty());
    }

    #[test]
    fn no_bytes_make_the_reader_panic(junk in prop::collection::vec(any::<u8>(), 0..300)) {
        let mut bytes = line::header().into_bytes();
        bytes.extend(&junk);
        let read = parse(Path::new("f"), &bytes).unwrap();
        prop_assert!(read.rows.is_empty());
        let _ = parse(Path::new("f"), &junk);
    }
}
