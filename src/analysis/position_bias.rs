//! Did participants choose by position? And was each condition shown equally often in both orders?

use super::dataset::{ConditionData, Dataset, OrderCounts, Votes};
use super::exact_binomial::exact_p;
use super::settings::Settings;
use super::statistic::{About, ConditionStatistic, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use super::wilson;

const ABOUT: About = About {
    id: "position_bias",
    name: "position bias",
    formula: "share of trials in which the image shown first was chosen, against ½ (exact binomial, Wilson interval)",
    source: "R. R. Davidson, R. J. Beaver (1977), Biometrics 33(4), 693–702, on order effects within pairs",
    validity: "pooled trials of one participant are not independent: the pooled p is a warning, not a finding",
};

/// By condition.
pub const BY_CONDITION: ConditionStatistic = ConditionStatistic {
    about: ABOUT,
    columns: &[
        Column::new("shown_ab", "shown a, b", Style::Count, Group::Position),
        Column::new("shown_ba", "shown b, a", Style::Count, Group::Position),
        Column::new("missing", "missing", Style::Count, Group::Position),
        Column::new("chose_first", "chose 1st", Style::Count, Group::Position),
        Column::new("chose_second", "chose 2nd", Style::Count, Group::Position),
        Column::new("p_position", "p", Style::P, Group::Position),
    ],
    cells: condition_cells,
    test: None,
};

/// Pooled, and by participant.
pub const POOLED: StudyStatistic = StudyStatistic {
    about: ABOUT,
    section,
};

fn condition_cells(condition: &ConditionData, _: &Settings) -> Vec<Cell> {
    let Some(orders) = condition.orders else {
        return vec![Cell::Undefined(Undefined::COUNTS_ONLY); BY_CONDITION.columns.len()];
    };
    let ((shown_ab, shown_ba), (first, second)) = (orders.orders(), orders.positions());
    let p = exact_p(positions_as_votes(&orders));
    vec![
        Cell::Count(shown_ab),
        Cell::Count(shown_ba),
        Cell::Count(orders.missing),
        Cell::Count(first),
        Cell::Count(second),
        Cell::or_undefined(p, Cell::Probability),
    ]
}

/// First against second, in the shape the share statistics take: "b" is the first position.
#[must_use]
pub fn positions_as_votes(orders: &OrderCounts) -> Votes {
    let (first, second) = orders.positions();
    Votes {
        a: second,
        b: first,
    }
}

/// Positions chosen over all conditions.
#[must_use]
pub fn pooled(data: &Dataset) -> Votes {
    data.conditions
        .iter()
        .filter_map(|condition| condition.orders.as_ref().map(positions_as_votes))
        .fold(Votes::default(), |sum, votes| Votes {
            a: sum.a + votes.a,
            b: sum.b + votes.b,
        })
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if !data.has_answers() {
        return None;
    }
    let votes = pooled(data);
    let mut findings = Vec::new();
    if let (Ok(p), Ok(interval)) = (exact_p(votes), wilson::interval(votes, settings.alpha)) {
        findings.push(format!(
            "The image shown first was chosen in {} of {} trials ({:.1}\u{a0}%, {}\u{a0}% interval {:.1} to {:.1}\u{a0}%; exact p {}).",
            votes.b,
            votes.total(),
            100.0 * f64::from(votes.b) / f64::from(votes.total()),
            settings.alpha.confidence_percent(),
            100.0 * interval.low,
            100.0 * interval.high,
            super::conclusion::p_text(p),
        ));
        if p.at_most(settings.alpha) {
            findings.push(
                "That is more than chance would give: look at the two orders of each condition apart."
                    .to_owned(),
            );
        }
    }
    findings.push(balance(data));
    Some(Section {
        id: "position_bias",
        title: "Position bias",
        status: Status::Ok,
        findings,
        tables: vec![SectionTable {
            id: "by_participant",
            caption: "Position chosen, by participant",
            long: true,
            table: by_participant(data),
        }],
    })
}

/// How even the orders were, in a sentence.
fn balance(data: &Dataset) -> String {
    let orders = || {
        data.conditions
            .iter()
            .filter_map(|condition| condition.orders.map(|counts| (condition, counts.orders())))
    };
    let uneven = orders().filter(|(_, (ab, ba))| ab != ba).count();
    let Some((worst, (ab, ba))) = orders().max_by_key(|(_, (ab, ba))| ab.abs_diff(*ba)) else {
        return "No condition was answered.".to_owned();
    };
    if uneven == 0 {
        return "Every condition was answered equally often in both orders.".to_owned();
    }
    format!(
        "The two orders are uneven in {uneven} of {}, most in {}: {} first {ab} times, {} first {ba} times.",
        super::conclusion::plural(data.conditions.len(), "condition"),
        worst.id,
        worst.technique_a,
        worst.technique_b,
    )
}

fn by_participant(data: &Dataset) -> Table {
    let mut counts = vec![OrderCounts::default(); data.participants.len()];
    for answer in &data.answers {
        counts[answer.participant as usize].add(answer.order, answer.chosen);
    }
    Table {
        columns: vec![
            Column::new("participant", "participant", Style::Text, Group::Key),
            Column::new("chose_first", "chose 1st", Style::Count, Group::Position),
            Column::new("chose_second", "chose 2nd", Style::Count, Group::Position),
            Column::new("missing", "missing", Style::Count, Group::Position),
            Column::new("p_position", "p", Style::P, Group::Position),
        ],
        rows: data
            .participants
            .iter()
            .zip(&counts)
            .map(|(participant, counts)| {
                let votes = positions_as_votes(counts);
                vec![
                    Cell::Text(participant.clone()),
                    Cell::Count(votes.b),
                    Cell::Count(votes.a),
                    Cell::Count(counts.missing),
                    Cell::or_undefined(exact_p(votes), Cell::Probability),
                ]
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::dataset::{Answer, Order};
    use crate::protocol::Position;

    /// Two participants, one condition, both orders; both always choose the first image.
    fn always_first() -> Dataset {
        let mut orders = OrderCounts::default();
        let answers: Vec<Answer> = [Order::AThenB, Order::BThenA]
            .into_iter()
            .zip(0..)
            .map(|(order, participant)| {
                orders.add(order, Some(Position::First));
                Answer {
                    participant,
                    condition: 0,
                    order,
                    chosen: Some(Position::First),
                    response_time_ms: None,
                }
            })
            .collect();
        Dataset {
            conditions: vec![ConditionData {
                id: "c".into(),
                technique_a: "none".into(),
                technique_b: "crytek24".into(),
                votes: orders.votes(),
                orders: Some(orders),
                ..ConditionData::default()
            }],
            participants: vec!["P1".into(), "P2".into()],
            answers,
            ..Dataset::default()
        }
    }

    #[test]
    fn choosing_by_position_is_no_preference_but_shows_here() {
        let data = always_first();
        assert_eq!(data.conditions[0].votes, Votes { a: 1, b: 1 });
        assert_eq!(pooled(&data), Votes { a: 0, b: 2 });
        let section = section(&Context::of(&data, &Settings::default())).unwrap();
        assert!(section.findings[0].contains("2 of 2"), "{section:?}");
        assert!(section.findings[1].contains("equally often"), "{section:?}");
        assert_eq!(section.tables[0].table.rows.len(), 2);
    }

    #[test]
    fn counts_alone_say_why_there_is_no_position() {
        let mut data = always_first();
        data.answers.clear();
        data.conditions[0].orders = None;
        assert!(section(&Context::of(&data, &Settings::default())).is_none());
        let cells = condition_cells(&data.conditions[0], &Settings::default());
        assert!(
            cells
                .iter()
                .all(|cell| *cell == Cell::Undefined(Undefined::COUNTS_ONLY))
        );
    }
}
