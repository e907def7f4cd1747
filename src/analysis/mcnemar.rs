//! McNemar's exact test between two conditions of one technique pair: did the same participants
//! choose differently when only the scene or its lighting changed (the thesis' H3)?

use super::dataset::{Dataset, Votes};
use super::exact_binomial::exact_p;
use super::holm;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};

/// With more pairs of conditions than this the table would drown the report.
const MOST_PAIRS: usize = 200;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "mcnemar",
        name: "McNemar's exact test between conditions of one technique pair",
        formula: "of the participants who chose differently in the two conditions, those for b only in one against those for b only in the other: exact binomial, ½",
        source: "Q. McNemar (1947), Psychometrika 12(2), 153–157",
        validity: "exact; uses only participants who answered both conditions",
    },
    section,
};

/// Two conditions with the same two techniques, and the participants who answered both.
struct Pair {
    left: usize,
    right: usize,
    /// a: chose b only in the right condition; b: chose b only in the left one.
    discordant: Votes,
    concordant: u32,
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if !data.has_answers() {
        return None;
    }
    let candidates = same_technique_pairs(data);
    if candidates.is_empty() || candidates.len() > MOST_PAIRS {
        return None;
    }
    let choices = choices_by_condition(data);
    let pairs: Vec<Pair> = candidates
        .into_iter()
        .map(|(left, right)| compare(&choices, left, right, turned(data, left, right)))
        .collect();
    let p: Vec<_> = pairs.iter().map(|pair| test(pair.discordant)).collect();
    let defined: Vec<_> = p.iter().filter_map(|p| p.ok()).collect();
    let mut adjusted = holm::adjust(&defined).into_iter();
    let adjusted: Vec<_> = p
        .iter()
        .map(|p| p.map(|p| adjusted.next().unwrap_or(p)))
        .collect();
    let significant = adjusted
        .iter()
        .filter(|p| p.is_ok_and(|p| p.at_most(settings.alpha)))
        .count();
    let rows = pairs
        .iter()
        .zip(p.iter().zip(&adjusted))
        .map(|(pair, (p, adjusted))| {
            vec![
                Cell::Text(data.conditions[pair.left].id.clone()),
                Cell::Text(data.conditions[pair.right].id.clone()),
                Cell::Count(pair.discordant.b),
                Cell::Count(pair.discordant.a),
                Cell::Count(pair.concordant),
                Cell::or_undefined(*p, Cell::Probability),
                Cell::or_undefined(*adjusted, Cell::Probability),
            ]
        })
        .collect();
    Some(Section {
        id: "mcnemar",
        title: "Same techniques, another condition",
        status: Status::Ok,
        findings: vec![format!(
            "{} of {} pairs of conditions with the same two techniques differ within participants after Holm's correction at alpha = {}.",
            significant,
            pairs.len(),
            settings.alpha.get(),
        )],
        tables: vec![SectionTable {
            id: "pairs",
            caption: "McNemar's exact test; “only left”: chose technique b in the left condition and not in the right one",
            long: false,
            table: Table {
                columns: columns(),
                rows,
            },
        }],
    })
}

fn columns() -> Vec<Column> {
    vec![
        Column::new("left", "left condition", Style::Text, Group::Key),
        Column::new("right", "right condition", Style::Text, Group::Key),
        Column::new("only_left", "only left", Style::Count, Group::Choices),
        Column::new("only_right", "only right", Style::Count, Group::Choices),
        Column::new("same", "same", Style::Count, Group::Choices),
        Column::new("p_exact", "p exact", Style::P, Group::Tests),
        Column::new("p_exact_holm", "Holm", Style::P, Group::Tests),
    ]
}

fn test(discordant: Votes) -> Result<super::tails::Probability, Undefined> {
    exact_p(discordant).map_err(|_| Undefined::NOTHING_TO_COMPARE)
}

/// Pairs (i, j), i < j, of conditions that compare the same two techniques in either base order;
/// at most one more than [`MOST_PAIRS`].
fn same_technique_pairs(data: &Dataset) -> Vec<(usize, usize)> {
    let by_techniques = data.by_techniques();
    let mut pairs: Vec<(usize, usize)> = by_techniques
        .values()
        .flat_map(|group| {
            group
                .iter()
                .enumerate()
                .flat_map(|(at, &i)| group[at + 1..].iter().map(move |&j| (i, j)))
        })
        .take(MOST_PAIRS + 1)
        .collect();
    pairs.sort_unstable();
    pairs
}

/// Whether the right condition's base order is the left one's turned round.
fn turned(data: &Dataset, left: usize, right: usize) -> bool {
    let (left, right) = (&data.conditions[left], &data.conditions[right]);
    left.technique_a == right.technique_b && left.technique_b == right.technique_a
}

/// For every condition (participant, chose technique b), sorted by participant.
pub(super) fn choices_by_condition(data: &Dataset) -> Vec<Vec<(u32, bool)>> {
    let mut choices = vec![Vec::new(); data.conditions.len()];
    for answer in &data.answers {
        if let Some(chose_b) = answer.chose_b() {
            choices[answer.condition as usize].push((answer.participant, chose_b));
        }
    }
    for list in &mut choices {
        list.sort_unstable();
    }
    choices
}

fn compare(choices: &[Vec<(u32, bool)>], left: usize, right: usize, turned: bool) -> Pair {
    let mut pair = Pair {
        left,
        right,
        discordant: Votes::default(),
        concordant: 0,
    };
    let mut others = choices[right].iter().peekable();
    for &(participant, chose_left) in &choices[left] {
        while others.next_if(|(other, _)| *other < participant).is_some() {}
        let Some(&(_, chose_right)) = others.next_if(|(other, _)| *other == participant) else {
            continue;
        };
        match (chose_left, chose_right != turned) {
            (true, false) => pair.discordant.b += 1,
            (false, true) => pair.discordant.a += 1,
            _ => pair.concordant += 1,
        }
    }
    pair
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::dataset::{Answer, ConditionData, Order, OrderCounts};
    use crate::analysis::settings::Settings;
    use crate::protocol::Position;

    fn condition(id: &str, a: &str, b: &str) -> ConditionData {
        ConditionData {
            id: id.into(),
            technique_a: a.into(),
            technique_b: b.into(),
            orders: Some(OrderCounts::default()),
            ..ConditionData::default()
        }
    }

    /// Nine participants chose b only in the first condition, one only in the second, two in both;
    /// the second condition's base order is turned round, and one participant misses it.
    #[test]
    fn discordant_choices_are_counted_across_turned_base_orders() {
        let mut answers = Vec::new();
        let mut answer = |participant, condition, chose_b: bool| {
            answers.push(Answer {
                participant,
                condition,
                order: Order::AThenB,
                chosen: Some(if chose_b {
                    Position::Second
                } else {
                    Position::First
                }),
                response_time_ms: None,
            });
        };
        for participant in 0..12_u32 {
            let in_first = participant != 9;
            let in_second = participant >= 9;
            answer(participant, 0, in_first);
            // Technique "b" of the first condition is technique a here.
            answer(participant, 1, !in_second);
        }
        answer(12, 0, true);
        let data = Dataset {
            conditions: vec![condition("one", "x", "y"), condition("two", "y", "x")],
            participants: (0..13).map(|i| format!("P{i}")).collect(),
            answers,
            ..Dataset::default()
        };
        let section = section(&Context::of(&data, &Settings::default())).unwrap();
        let row = &section.tables[0].table.rows[0];
        assert_eq!(row[2..5], [Cell::Count(9), Cell::Count(1), Cell::Count(2)]);
        // 2 (1 + 10) / 2^10.
        let Cell::Probability(p) = row[5] else {
            panic!("{row:?}")
        };
        assert!((p.value() - 22.0 / 1024.0).abs() < 1e-15);
        assert!(section.findings[0].starts_with("1 of 1"), "{section:?}");
    }

    #[test]
    fn different_techniques_are_not_compared() {
        let data = Dataset {
            conditions: vec![condition("one", "x", "y"), condition("two", "x", "z")],
            participants: vec!["P".into()],
            answers: vec![Answer {
                participant: 0,
                condition: 0,
                order: Order::AThenB,
                chosen: None,
                response_time_ms: None,
            }],
            ..Dataset::default()
        };
        assert!(section(&Context::of(&data, &Settings::default())).is_none());
    }
}
