//! What happened during a session that an analyst should know of: interruptions, a lost
//! focus, frames that came late, a display that was not as it should be.

use std::path::Path;

use super::finding::{Findings, Severity};
use crate::protocol::Phase;
use crate::protocol::options::Catch;
use crate::record::read::Rows;
use crate::record::{DisplayVerdict, TrialRow};

const LOOK: &str = "ask what happened; consider leaving the trial out";

/// Checks one data file. `segments` are those whose files are on record.
pub(super) fn check(path: &Path, rows: &Rows, segments: &[u32], findings: &mut Findings) {
    let mut segment = 1;
    for (row, &line) in rows.rows.iter().zip(&rows.lines) {
        if row.segment != segment {
            resumed(path, (row, line), segment, segments, findings);
            segment = row.segment;
        }
        if row.focus_lost > 0 {
            let message = match row.focus_lost {
                1 => "the window was without the keyboard focus once".to_owned(),
                times => format!("the window was without the keyboard focus {times} times"),
            };
            findings.line(Severity::Warning, (path, line), message, LOOK);
        }
    }
    display(path, rows, findings);
    missed_frames(path, rows, findings);
}

/// The first row after a resume.
fn resumed(
    path: &Path,
    (row, line): (&TrialRow, u64),
    before: u32,
    segments: &[u32],
    findings: &mut Findings,
) {
    let by_hand = "the file was changed by hand or copied from elsewhere: put back its backup";
    if row.segment < before {
        let message = format!("segment {} after segment {before}", row.segment);
        findings.line(Severity::Error, (path, line), message, by_hand);
    } else if !segments.contains(&row.segment) {
        let message = format!(
            "segment {}, of which no file under slots/ tells",
            row.segment
        );
        findings.line(Severity::Warning, (path, line), message, by_hand);
    }
    let message = match row.resume_gap_ms {
        Some(gap_ms) => format!(
            "the session went on after an interruption of {:.1} s",
            gap_ms as f64 / 1e3
        ),
        None => "the session went on after an interruption of unknown length".to_owned(),
    };
    let mend = "nothing to do; consider whether so long an interruption matters";
    findings.line(Severity::Note, (path, line), message, mend);
}

/// Late frames are common; they are told once a session.
fn missed_frames(path: &Path, rows: &Rows, findings: &mut Findings) {
    let late = |row: &&TrialRow| row.missed_frames.is_some_and(|count| count > 0);
    let trials = rows.rows.iter().filter(late).count();
    if trials == 0 {
        return;
    }
    let frames: u64 = rows
        .rows
        .iter()
        .filter_map(|r| r.missed_frames)
        .map(u64::from)
        .sum();
    let message = format!(
        "{frames} frames came late, in {trials} of {} trials",
        rows.rows.len()
    );
    let mend = "onsets of these trials are later than they should be; see missed_frames";
    findings.file(Severity::Warning, path, message, mend);
}

/// A display that was not as the protocol asks is told once a session.
fn display(path: &Path, rows: &Rows, findings: &mut Findings) {
    let warned = |row: &&TrialRow| row.display_check == DisplayVerdict::Warned;
    let Some(row) = rows.rows.iter().find(warned) else {
        return;
    };
    let period = row
        .refresh_period_ms
        .map_or_else(|| "unknown".to_owned(), |ms| format!("{ms:.2} ms"));
    let message = format!("the display was not as the protocol asks (period {period})");
    let mend = "see this participant's file under displays/; consider whether it matters";
    findings.file(Severity::Warning, path, message, mend);
}

/// The pass rule of the catch trials, once all of them are answered.
pub(super) fn attention(path: &Path, rows: &Rows, catch: &Catch, findings: &mut Findings) {
    let answered = rows.rows.iter().filter(|row| row.phase == Phase::Catch);
    let (all, right) = answered.fold((0_usize, 0_u32), |(all, right), row| {
        (all + 1, right + u32::from(row.correct == Some(true)))
    });
    let needed = catch.minimum_correct.get();
    if all < catch.trials.len() || right >= needed {
        return;
    }
    let who = rows.rows.first().map_or("", |row| &row.participant_id);
    let message = format!("{right} of {all} catch trials right, {needed} are needed to pass");
    let mend = format!(
        "consider leaving the participant out: greyfield participants RESULTS --reject {who} --reason TEXT"
    );
    findings.file(Severity::Warning, path, message, mend);
}
