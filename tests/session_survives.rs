//! What happens to answers when the program is killed or the disk is full.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod tiny_study;

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use greyfield::record::audit::{Severity, audit};
use greyfield::record::read::Flaw;
use greyfield::record::{TrialRow, read_folder, read_rows};
use greyfield::seed;
use rand_chacha::ChaCha20Rng;
use tiny_study::{TRIALS, TinyStudy, acknowledged, stderr, stdout, what_was_asked_and_answered};

/// Folders on which processes are killed at the same time.
const FOLDERS: u32 = 4;
const KILLS_OF_A_FOLDER: u32 = 260;
/// More than are ever reached.
const MANY: u32 = 50_000;

fn asked_and_answered(results: &Path) -> Vec<TrialRow> {
    let rows = read_folder(results).unwrap().rows;
    rows.iter().map(what_was_asked_and_answered).collect()
}

/// A process that is killed loses nothing that the system has taken, on whatever disk:
/// a folder in memory shows the same, and a thousand kills spare the disk.
fn room() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").unwrap_or_else(|_| tempfile::tempdir().unwrap())
}

/// Starts a run and kills it: after a while, or soon after it has said a few things.
/// Gives what it had acknowledged, and whether it was running when it was killed.
fn run_and_kill(command: &mut Command, rng: &mut ChaCha20Rng) -> (String, bool) {
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    let mut text = String::new();
    if seed::below(rng, 4) == 0 {
        let after = Duration::from_micros(seed::below(rng, 40_000).into());
        std::thread::sleep(after);
    } else {
        for _ in 0..seed::below(rng, 12) {
            output.read_line(&mut text).unwrap();
        }
        std::thread::sleep(Duration::from_micros(seed::below(rng, 1_000).into()));
    }
    let was_running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    output.read_to_string(&mut text).unwrap();
    // The last line may be cut off: it was not said then.
    text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
    (text, was_running)
}

/// A run that may write files of so many blocks of 512 bytes only: the row that does not
/// fit is written in part.
fn limited_to(blocks: u32, run: &Command) -> Command {
    // Without the trap the signal would end the process.
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut command = Command::new("dash");
    command
        .args(["-c", &script])
        .arg(run.get_program())
        .args(run.get_args());
    command
}

/// The data file with room for more rows, if there is one.
fn unfinished(results: &Path) -> Option<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(results.join("data"))
        .ok()?
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().ends_with("_data.csv"))
        .filter(|path| {
            path.file_name()
                .unwrap()
                .to_string_lossy()
                .starts_with("study")
        })
        .collect();
    files.sort();
    let last = files.pop()?;
    (read_rows(&last).ok()?.rows.len() < TRIALS).then_some(last)
}

/// What a computer that loses its power in the middle of a write may leave.
fn tear(path: &Path, rng: &mut ChaCha20Rng) {
    let whole = fs::read(path).unwrap();
    let Some(line) = whole.split(|byte| *byte == b'\n').next_back() else {
        return;
    };
    if !line.is_empty() {
        return; // torn already
    }
    let row = fs::read_to_string(path).unwrap();
    let row = row.lines().last().unwrap().replacen(":main:", ":main:9", 1);
    let cut = 1 + seed::below(rng, u32::try_from(row.len()).unwrap() - 1) as usize;
    let mut file = OpenOptions::new().append(true).open(path).unwrap();
    file.write_all(&row.as_bytes()[..cut]).unwrap();
}

/// Kills the runs of one folder again and again, then lets one go on to its end.
fn kill_and_compare(number: u32) -> u32 {
    let study = TinyStudy::new();
    let room = room();
    let results = room.path().join("killed");
    let observer = format!("random:{number}");
    let mut rng = seed::generator(1, "kill", number.into());
    let mut said = BTreeSet::new();
    let (mut kills, mut torn) = (0, 0);
    while kills < KILLS_OF_A_FOLDER {
        let run = study.command(&results, &observer, MANY);
        let (text, killed) = if seed::below(&mut rng, 8) == 0 {
            // A whole file has about twelve blocks.
            let blocks = 4 + seed::below(&mut rng, 7);
            run_and_kill(&mut limited_to(blocks, &run), &mut rng)
        } else {
            run_and_kill(&mut { run }, &mut rng)
        };
        kills += u32::from(killed);
        let now = acknowledged(&text);
        if let Some(file) = unfinished(&results) {
            let on_disk = read_rows(&file).unwrap().rows;
            let session = file.to_string_lossy().into_owned();
            for row_id in &now {
                let participant = row_id.split(':').next().unwrap();
                if session.contains(&format!("subject-{participant}_")) {
                    let there = on_disk.iter().any(|row| &row.row_id == row_id);
                    assert!(there, "{row_id} was lost");
                }
            }
            if seed::below(&mut rng, 4) == 0 {
                tear(&file, &mut rng);
                torn += 1;
            }
        }
        said.extend(now);
    }
    let begun = u32::try_from(fs::read_dir(results.join("data")).unwrap().count()).unwrap();
    let output = study.run(&results, &observer, begun);
    assert!(output.status.success(), "{}", stderr(&output));
    let read = read_folder(&results).unwrap();
    let on_disk: BTreeSet<&str> = read.rows.iter().map(|row| row.row_id.as_str()).collect();
    for row_id in &said {
        assert!(on_disk.contains(row_id.as_str()), "{row_id} was lost");
    }
    let whole = room.path().join("uninterrupted");
    assert!(study.run(&whole, &observer, begun).status.success());
    assert_eq!(asked_and_answered(&results), asked_and_answered(&whole));
    assert!(torn > KILLS_OF_A_FOLDER / 20, "only {torn} lines were torn");
    let damaged = read
        .warnings
        .iter()
        .filter(|w| w.flaw == Flaw::Damaged)
        .count();
    assert!(
        damaged >= torn as usize / 2,
        "{damaged} of {torn} torn lines"
    );
    // Nothing is wrong, and each torn line is on record with the resume that ended it.
    let report = audit(&results).unwrap();
    assert_eq!(report.count(Severity::Error), 0, "{:#?}", report.findings);
    println!(
        "folder {number}: {kills} kills, {} rows acknowledged, {damaged} torn lines, {begun} participants",
        said.len()
    );
    kills
}

#[test]
fn a_thousand_killed_sessions_lose_nothing_and_go_on_as_they_would_have() {
    let started = Instant::now();
    let kills: u32 = std::thread::scope(|scope| {
        let folders: Vec<_> = (1..=FOLDERS)
            .map(|number| scope.spawn(move || kill_and_compare(number)))
            .collect();
        folders
            .into_iter()
            .map(|folder| folder.join().unwrap())
            .sum()
    });
    assert!(
        kills >= 1000,
        "only {kills} runs were killed before their end"
    );
    println!("{kills} kills in {:?}", started.elapsed());
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
fn limited(study: &TinyStudy, results: &Path) -> Output {
    assert!(study.run(results, "random:7", 1).status.success());
    let run = study.command(results, "random:7", 2);
    limited_to(5, &run).output().unwrap()
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

/// Runs a shell script in which `$M` may be mounted; `None`, with the reason printed,
/// where this machine does not let us.
fn with_mounts(study: &TinyStudy, script: &str) -> Option<Output> {
    let mount = study.path("mount");
    fs::create_dir_all(&mount).unwrap();
    let run = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["-rm", "dash", "-c", script]).env("M", &mount);
        let run = study.command(&mount.join("results"), "random:7", MANY);
        command.arg(run.get_program()).args(run.get_args());
        command.output()
    };
    match run("mount -t tmpfs -o size=64k none \"$M\"") {
        Ok(output) if output.status.success() => Some(run(script).unwrap()),
        Ok(output) => {
            println!("skipped, nothing can be mounted here: {}", stderr(&output));
            None
        }
        Err(error) => {
            println!("skipped, unshare is not here: {error}");
            None
        }
    }
}

/// A disk that is really full, wherever it happens to be: a row, a slot or a draft.
#[test]
fn a_small_disk_that_fills_up_keeps_what_was_acknowledged() {
    let study = TinyStudy::new();
    let kept = study.path("kept");
    let script = format!(
        "mount -t tmpfs -o size=96k none \"$M\" && \"$0\" \"$@\"; code=$?; cp -r \"$M/results\" {:?}; exit $code",
        kept.to_str().unwrap()
    );
    let Some(output) = with_mounts(&study, &script) else {
        return;
    };
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for part in ["mount/results", "No space left", "free some space"] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
    let said = acknowledged(&stdout(&output));
    assert!(said.len() > TRIALS, "{said:?}");
    let on_disk: Vec<String> = read_folder(&kept)
        .unwrap()
        .rows
        .into_iter()
        .map(|row| row.row_id)
        .collect();
    assert_eq!(on_disk, said);
}

#[test]
fn a_folder_that_is_read_only_is_one_clear_error() {
    let study = TinyStudy::new();
    let script = "mount -t tmpfs none \"$M\" && \"$0\" \"$@\" --participants 1 >/dev/null && mount -o remount,ro \"$M\" && exec \"$0\" \"$@\" --participants 2";
    // The number of participants may be given once.
    let script = script.replace(
        "\"$@\" --participants",
        "$(echo \"$@\" | sed 's/--participants [0-9]*//') --participants",
    );
    let Some(output) = with_mounts(&study, &script) else {
        return;
    };
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for part in ["mount/results/data", "cannot create", "must be writable"] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
    assert!(acknowledged(&stdout(&output)).is_empty());
}

#[test]
fn a_folder_that_is_taken_away_during_a_session_is_one_clear_error() {
    for lines in [3, 9, 20] {
        let study = TinyStudy::new();
        let (results, moved) = (study.path("results"), study.path("moved"));
        let mut child = study
            .command(&results, "random:7", MANY)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut output = BufReader::new(child.stdout.take().unwrap());
        let mut text = String::new();
        for _ in 0..lines {
            output.read_line(&mut text).unwrap();
        }
        fs::rename(&results, &moved).unwrap();
        output.read_to_string(&mut text).unwrap();
        let mut message = String::new();
        let mut errors = child.stderr.take().unwrap();
        errors.read_to_string(&mut message).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(1), "{message}");
        assert!(message.contains(results.to_str().unwrap()), "{message}");
        assert!(
            message.contains("removed or replaced") || message.contains("No such file"),
            "{message}"
        );
        let rows = read_folder(&moved).unwrap().rows;
        let on_disk: BTreeSet<&str> = rows.iter().map(|row| row.row_id.as_str()).collect();
        for row_id in acknowledged(&text) {
            assert!(on_disk.contains(row_id.as_str()), "{row_id} was lost");
        }
        assert!(!results.join("data").exists(), "nothing is made anew");
    }
}
