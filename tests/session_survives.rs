//! What happens to answers when the program is killed or the disk is full.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod tiny_study;

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use greyfield::record::{TrialRow, read_folder};
use greyfield::seed;
use tiny_study::{TRIALS, TinyStudy, acknowledged, stderr, stdout, what_was_asked_and_answered};

const PARTICIPANTS: u32 = 20;

fn asked_and_answered(results: &Path) -> Vec<TrialRow> {
    let rows = read_folder(results).unwrap().rows;
    rows.iter().map(what_was_asked_and_answered).collect()
}

/// Starts a run, kills it after a while, and gives what it had acknowledged.
/// The second value is false if it was through before.
fn run_and_kill(study: &TinyStudy, results: &Path, after: Duration) -> (Vec<String>, bool) {
    let mut child = study
        .command(results, "random:7", PARTICIPANTS)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(after);
    let was_running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    let mut text = String::new();
    child
        .stdout
        .take()
        .unwrap()
        .read_to_string(&mut text)
        .unwrap();
    // The last line may be cut off: it was not said then.
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    (acknowledged(whole), was_running)
}

#[test]
fn a_killed_session_loses_nothing_it_acknowledged_and_goes_on_as_it_would_have() {
    let study = TinyStudy::new();
    let whole = study.path("uninterrupted");
    assert!(study.run(&whole, "random:7", PARTICIPANTS).status.success());
    let results = study.path("killed");
    let mut rng = seed::generator(1, "kill", 0);
    let mut acknowledged = BTreeSet::new();
    let mut kills = 0;
    for _ in 0..60 {
        let after = Duration::from_micros(seed::below(&mut rng, 60_000).into());
        let (said, killed) = run_and_kill(&study, &results, after);
        kills += usize::from(killed);
        acknowledged.extend(said);
        if results.join("data").exists() {
            let rows = read_folder(&results).unwrap().rows;
            let on_disk: BTreeSet<&str> = rows.iter().map(|row| row.row_id.as_str()).collect();
            for row_id in &acknowledged {
                assert!(on_disk.contains(row_id.as_str()), "{row_id} was lost");
            }
        }
    }
    assert!(
        kills > 10,
        "only {kills} of the runs were killed before their end"
    );
    let output = study.run(&results, "random:7", PARTICIPANTS);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(asked_and_answered(&results), asked_and_answered(&whole));
}

/// The gap of an interruption is on record once, in the first row after it.
#[test]
fn an_interruption_is_on_record() {
    let study = TinyStudy::new();
    let results = study.path("results");
    limited(&study, &results);
    assert!(study.run(&results, "random:7", 2).status.success());
    let rows = read_folder(&results).unwrap().rows;
    let second: Vec<&TrialRow> = rows.iter().filter(|row| row.slot == 1).collect();
    let resumed = second.iter().position(|row| row.segment == 2).unwrap();
    assert!(second[resumed..].iter().all(|row| row.segment == 2));
    for (index, row) in second.iter().enumerate() {
        assert_eq!(row.resume_gap_ms.is_some(), index == resumed);
    }
    assert!(
        results
            .join("slots/slot-0001_claim-1_segment-2.json")
            .exists()
    );
}

/// One participant without a limit, then a second who runs into a file-size limit:
/// the same as a full disk, a row that fits in part only.
fn limited(study: &TinyStudy, results: &Path) -> std::process::Output {
    assert!(study.run(results, "random:7", 1).status.success());
    let run = study.command(results, "random:7", 2);
    // Blocks of 512 bytes; without the trap the signal would end the process.
    let script = "trap '' XFSZ; ulimit -f 5; exec \"$0\" \"$@\"";
    Command::new("dash")
        .args(["-c", script])
        .arg(run.get_program())
        .args(run.get_args())
        .output()
        .unwrap()
}

#[test]
fn a_full_disk_is_one_clear_error_and_half_a_row_is_no_answer() {
    let study = TinyStudy::new();
    let results = study.path("results");
    let output = limited(&study, &results);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for part in [
        "random7p0002",
        "could not be saved",
        "_data.csv",
        "run the same command",
    ] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
    let said = acknowledged(&stdout(&output));
    assert!(!said.is_empty() && said.len() < TRIALS, "{said:?}");
    let read = read_folder(&results).unwrap();
    let on_disk: Vec<&str> = read.rows[TRIALS..]
        .iter()
        .map(|row| row.row_id.as_str())
        .collect();
    assert_eq!(on_disk, said);
    assert_eq!(read.warnings.len(), 1, "the torn line is reported");

    // With room again the session goes on; the torn part stays where it is.
    let again = study.run(&results, "random:7", 2);
    assert!(again.status.success(), "{}", stderr(&again));
    assert!(
        stderr(&again).contains("cut off by a crash"),
        "{}",
        stderr(&again)
    );
    let whole = study.path("uninterrupted");
    assert!(study.run(&whole, "random:7", 2).status.success());
    assert_eq!(asked_and_answered(&results), asked_and_answered(&whole));
}

#[test]
fn a_folder_that_cannot_be_written_is_one_clear_error() {
    let study = TinyStudy::new();
    let blocked = study.path("a-file");
    std::fs::write(&blocked, "").unwrap();
    for results in [blocked.join("results"), "/sys/greyfield-results".into()] {
        let output = study.run(&results, "first", 1);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains(results.to_str().unwrap()), "{message}");
        assert!(message.contains("cannot create the folder"), "{message}");
        assert_eq!(stdout(&output), "");
    }
}
