//! Who has taken part so far, and what that makes of the design's balance.

use crate::protocol::balance::{Aspect, Balance};
use crate::protocol::exhibit::Exhibits;
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
    let plan = |slot| SessionPlan::new(protocol, conditions, slot);
    let in_pairs = matches!(
        protocol.procedure.exhibits,
        Exhibits::Pairs | Exhibits::PairsWithReference
    );
    lines.extend(balance(plan, finished, next, in_pairs).unwrap_or_default());
    Ok(lines)
}

fn is_finished(standing: &Standing, pairs: usize) -> bool {
    standing.released.is_none() && standing.rejected.is_none() && standing.answered >= pairs
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
    let rejected = standings.iter().filter(|s| s.rejected.is_some()).count();
    if rejected > 0 {
        parts.push(format!("{rejected} rejected"));
    }
    parts.join("; ")
}

/// How evenly the finished sessions spread what the design spreads, and what the next
/// place will make of it; nothing before there are any.
fn balance(
    plan: impl Fn(u32) -> Result<SessionPlan, PlanError>,
    finished: impl Iterator<Item = u32>,
    next: u32,
    in_pairs: bool,
) -> Result<Vec<String>, PlanError> {
    let mut balance = Balance::default();
    for slot in finished {
        balance.add(&plan(slot)?);
    }
    if balance.sessions() == 0 {
        return Ok(Vec::new());
    }
    let after = balance.if_next(&plan(next)?);
    Ok(vec![
        format!(
            "Balance of the {} finished: {}",
            balance.sessions(),
            counts(&balance, in_pairs)
        ),
        format!("With the next participant: {}", counts(&after, in_pairs)),
    ])
}

fn counts(balance: &Balance, in_pairs: bool) -> String {
    let times = |aspect| balance.evenness(aspect).range;
    let stood = format!(
        "each condition stood in each position {} times, right after each other {} times",
        times(Aspect::Position),
        times(Aspect::CarryOver),
    );
    if !in_pairs {
        return stood;
    }
    format!(
        "{stood}; each pair was reversed {} times, in each position {} were",
        times(Aspect::InnerOrder),
        times(Aspect::InnerOrderAtPosition),
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    const PROTOCOL: &str = include_str!("../../../protocols/thesis-2010.toml");

    fn said(finished: &[u32], next: u32) -> Vec<String> {
        let protocol = Protocol::parse(Path::new("p.toml"), PROTOCOL).unwrap();
        let conditions: Vec<Condition> = ["a", "b", "c"]
            .map(|id| Condition {
                id: id.to_owned(),
                scene: "atrium".to_owned(),
                techniques: vec!["none".to_owned(), "blizzard24".to_owned()],
                reference: None,
                hypothesis: String::new(),
            })
            .into();
        let plan = |slot| SessionPlan::new(&protocol, &conditions, slot);
        balance(plan, finished.iter().copied(), next, true).unwrap()
    }

    /// Three pairs: participants 0 to 2 see a Latin square, 3 to 5 the same reversed.
    #[test]
    fn the_last_participant_of_a_block_makes_it_even() {
        let lines = said(&[0, 1, 2, 3, 4], 5);
        let [now, then] = lines.as_slice() else {
            panic!("{lines:?}")
        };
        assert!(now.starts_with("Balance of the 5 finished: "), "{now}");
        assert!(
            now.contains("in each position 1 to 2 times, right after")
                && now.contains("was reversed 2 times"),
            "{now}"
        );
        assert!(
            then.contains("in each position 2 times, right after")
                && then.contains("was reversed 3 times"),
            "{then}"
        );
        assert!(then.ends_with("in each position 3 were"), "{then}");
    }

    #[test]
    fn before_anybody_has_finished_there_is_nothing_to_say() {
        assert!(said(&[], 0).is_empty());
    }
}
