use super::*;
use crate::analysis::dataset::{Answer, ConditionData, Order};
use crate::analysis::settings::Settings;
use crate::protocol::Position;

/// `choices`: one string a participant, a letter a condition: 1 chose the technique called b in the
/// first condition, 0 the other, anything else no answer. `turned` conditions have the base order
/// turned round.
fn study(choices: &[&str], turned: &[bool]) -> Dataset {
    let conditions = (0..turned.len())
        .map(|i| {
            let (a, b) = if turned[i] { ("y", "x") } else { ("x", "y") };
            ConditionData {
                id: format!("c{i}"),
                technique_a: a.into(),
                technique_b: b.into(),
                ..ConditionData::default()
            }
        })
        .collect();
    let mut answers = Vec::new();
    for (participant, row) in (0..).zip(choices) {
        for ((condition, letter), turned) in (0..).zip(row.chars()).zip(turned) {
            let b = match letter {
                '0' => *turned,
                '1' => !turned,
                _ => continue,
            };
            answers.push(Answer {
                participant,
                condition,
                order: Order::AThenB,
                chosen: Some(if b { Position::Second } else { Position::First }),
                response_time_ms: None,
            });
        }
    }
    Dataset {
        conditions,
        answers,
        ..Dataset::default()
    }
}

fn only_row(data: &Dataset) -> (Section, Vec<Cell>) {
    let section = section(&Context::of(data, &Settings::default())).unwrap();
    let row = section.tables[0].table.rows[0].clone();
    (section, row)
}

fn value(cell: &Cell) -> f64 {
    match cell {
        Cell::Number(x) => *x,
        Cell::Probability(p) => p.value(),
        Cell::Count(n) => f64::from(*n),
        other => panic!("{other:?}"),
    }
}

/// Q and its p by statsmodels, the exact p by writing out every way: `tests/data/within.py`.
#[test]
fn every_value_of_the_table_holds() {
    let mut rows = 0;
    for line in include_str!("../../../tests/data/within.csv").lines() {
        let Some(cells) = line.strip_prefix("cochran_q,") else {
            continue;
        };
        let cells: Vec<&str> = cells.split(',').collect();
        let choices: Vec<&str> = cells[0].split(' ').collect();
        let k = choices[0].len();
        for turned in [vec![false; k], (0..k).map(|i| i % 2 == 1).collect()] {
            let (_, row) = only_row(&study(&choices, &turned));
            for (at, expected) in [(5, 1), (7, 2), (8, 3)] {
                if cells[expected].is_empty() {
                    continue;
                }
                let expected: f64 = cells[expected].parse().unwrap();
                let ours = value(&row[at]);
                assert!(
                    (ours - expected).abs() <= 1e-11 * expected,
                    "{line}: {ours}"
                );
            }
        }
        rows += 1;
    }
    assert!(rows >= 5, "{rows} rows");
}

#[test]
fn whoever_missed_a_condition_does_not_count() {
    let all = study(&["110", "100", "010", "111"], &[false; 3]);
    let with_missing = study(&["110", "1-0", "100", "010", "01-", "111"], &[false; 3]);
    assert_eq!(only_row(&all).1, only_row(&with_missing).1);
}

#[test]
fn poor_chi_square_is_said_to_be_so() {
    let (section, row) = only_row(&study(&["110", "100", "110", "111", "000"], &[false; 3]));
    assert_eq!(row[3..5], [Cell::Count(5), Cell::Count(3)]);
    assert!(
        section.findings[0].contains("poor approximation here; the exact one holds"),
        "{section:?}"
    );
}

#[test]
fn nobody_differs_or_nobody_answered_all() {
    let (section, row) = only_row(&study(&["111", "000"], &[false; 3]));
    assert_eq!(section.status, Status::Degenerate);
    assert_eq!(row[5], Cell::Undefined(ALL_ALIKE));
    let (section, row) = only_row(&study(&["11-", "-00"], &[false; 3]));
    assert_eq!(section.status, Status::Degenerate);
    assert_eq!(row[7], Cell::Undefined(INCOMPLETE));
    let two = study(&["11"], &[false; 2]);
    assert!(super::section(&Context::of(&two, &Settings::default())).is_none());
}
