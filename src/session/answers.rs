//! Whether an answer is one to what was asked, and what it becomes on record.

use super::Answer;
use super::machine::Rules;
use super::trial_log::list;
use crate::protocol::procedure::Ask;
use crate::protocol::{SessionPlan, Trial};
use crate::record::row::LIST_SEPARATOR;
use crate::record::{Response, TrialRow};

/// Whether the answer is one that the question has.
pub(super) fn fits(answer: &Answer, ask: Ask, rules: &Rules, trial: &Trial) -> bool {
    match (answer, ask) {
        (Answer::Choice(_), Ask::Choice | Ask::CloserToReference) => true,
        (Answer::CannotTell, Ask::Choice | Ask::CloserToReference) => rules.cannot_tell,
        (Answer::Ratings(ratings), Ask::Ratings) => {
            let scales = &rules.scales;
            let on_its_scale = |(rating, scale): (&u32, &crate::protocol::options::Scale)| {
                (1..=scale.points.get()).contains(rating)
            };
            ratings.len() == scales.len() && ratings.iter().zip(scales).all(on_its_scale)
        }
        (Answer::Ranking(places), Ask::Ranking) => {
            let mut sorted = places.clone();
            sorted.sort_unstable();
            sorted.into_iter().eq(0..trial.places.len())
        }
        _ => false,
    }
}

/// The row with the answer in it.
pub(super) fn on_record(
    row: TrialRow,
    answer: &Answer,
    plan: &SessionPlan,
    trial: &Trial,
    rules: &Rules,
) -> TrialRow {
    let shown: Vec<&str> = plan.shown(trial).collect();
    match answer {
        Answer::Choice(position) => {
            let chosen = shown.get(position.place()).copied().unwrap_or_default();
            TrialRow {
                response: Some((*position).into()),
                correct: trial.correct.as_deref().map(|correct| correct == chosen),
                chosen_technique: Some(chosen.to_owned()),
                ..row
            }
        }
        Answer::CannotTell => TrialRow {
            response: Some(Response::CannotTell),
            correct: trial.correct.as_ref().map(|_| false),
            ..row
        },
        Answer::Ratings(ratings) => {
            let rated = |(scale, rating): (&crate::protocol::options::Scale, &u32)| {
                format!("{}={rating}", &*scale.id)
            };
            let ratings: Vec<String> = rules.scales.iter().zip(ratings).map(rated).collect();
            TrialRow {
                ratings: ratings.join(&LIST_SEPARATOR.to_string()),
                ..row
            }
        }
        Answer::Ranking(places) => TrialRow {
            ranking: list(places.iter().filter_map(|&place| shown.get(place).copied())),
            ..row
        },
    }
}
