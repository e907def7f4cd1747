//! Who has taken part so far, and what that makes of the design's balance.

use crate::protocol::{Condition, PlanError, Protocol, SessionPlan};
use crate::record::{RecordError, Standing, Study};

/// Lines on the participants of a results folder.
///
/// # Errors
/// [`RecordError`] if the folder cannot be read.
pub fn lines(
    study: &Study,
    protocol: &Protocol,
    conditions: &[Condition],
) -> Result<Vec<String>, RecordError> {
    let standings = study.standings()?;
    let next = study.next_slot()?;
    let mut lines = vec![
        attendance(&standings, conditions.len()),
        format!(
            "The next new participant takes place {} of {} planned",
            next + 1,
            protocol.planned_participants.get()
        ),
    ];
    let finished = standings
        .iter()
        .filter(|standing| is_finished(standing, conditions.len()))
        .map(|standing| standing.slot);
    // A study without a plan is refused long before this page.
    lines.extend(balance(protocol, conditions, finished).ok().flatten());
    Ok(lines)
}

fn is_finished(standing: &Standing, pairs: usize) -> bool {
    standing.released.is_none() && standing.answered >= pairs
}

fn attendance(standings: &[Standing], pairs: usize) -> String {
    if standings.is_empty() {
        return String::from("Nobody yet");
    }
    let finished = standings.iter().filter(|s| is_finished(s, pairs)).count();
    let dropped = standings.iter().filter(|s| s.released.is_some()).count();
    let unfinished: Vec<&str> = standings
        .iter()
        .filter(|s| s.released.is_none() && s.answered < pairs)
        .map(|s| s.participant.as_str())
        .collect();
    let mut parts = vec![format!("{finished} finished")];
    if !unfinished.is_empty() {
        parts.push(format!("unfinished: {}", unfinished.join(", ")));
    }
    if dropped > 0 {
        parts.push(format!("{dropped} dropped out"));
    }
    parts.join("; ")
}

/// How evenly the finished sessions spread the conditions over the positions of a
/// session, and the pairs over their two orders; `None` before there are any.
fn balance(
    protocol: &Protocol,
    conditions: &[Condition],
    finished: impl Iterator<Item = u32>,
) -> Result<Option<String>, PlanError> {
    let count = conditions.len();
    let mut at_position = vec![0_u32; count * count];
    let mut reversed = vec![0_u32; count];
    let mut sessions = 0;
    for slot in finished {
        sessions += 1;
        let plan = SessionPlan::new(protocol, conditions, slot)?;
        for trial in &plan.trials {
            at_position[trial.condition * count + trial.index] += 1;
            reversed[trial.condition] += u32::from(trial.reversed);
        }
    }
    let range = |counts: &[u32]| {
        let low = counts.iter().min().copied().unwrap_or(0);
        let high = counts.iter().max().copied().unwrap_or(0);
        if low == high {
            format!("{low}")
        } else {
            format!("{low} to {high}")
        }
    };
    Ok((sessions > 0).then(|| {
        format!(
            "Balance of the {sessions} finished: each pair stood in each position {} times, reversed {} times",
            range(&at_position),
            range(&reversed)
        )
    }))
}
