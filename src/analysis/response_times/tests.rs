use super::*;
use crate::analysis::dataset::{ConditionData, Order};
use crate::protocol::Position;

const TABLE: &str = include_str!("../../../tests/data/within.csv");

fn numbers(prefix: &str) -> Vec<Vec<f64>> {
    (TABLE.lines())
        .filter_map(|line| line.strip_prefix(prefix))
        .map(|cells| cells.split(',').map(|c| c.parse().unwrap()).collect())
        .collect()
}

fn answer(participant: u32, condition: u32, second: bool, time: Option<f32>) -> Answer {
    Answer {
        participant,
        condition,
        order: Order::AThenB,
        chosen: Some(if second {
            Position::Second
        } else {
            Position::First
        }),
        response_time_ms: time,
    }
}

fn study(conditions: usize, answers: Vec<Answer>) -> Dataset {
    Dataset {
        conditions: (0..conditions)
            .map(|i| ConditionData {
                id: format!("{i}"),
                ..ConditionData::default()
            })
            .collect(),
        answers,
        ..Dataset::default()
    }
}

fn of_table() -> Dataset {
    let answers = (numbers("time,").iter())
        .map(|row| {
            answer(
                row[0] as u32,
                row[1] as u32,
                row[2] > 0.5,
                Some(row[3] as f32),
            )
        })
        .collect();
    study(4, answers)
}

fn run(data: &Dataset) -> Section {
    section(&Context::of(data, &Settings::default())).unwrap()
}

fn values(row: &[Cell]) -> Vec<f64> {
    (row.iter())
        .flat_map(|cell| match cell {
            Cell::Number(x) => vec![*x],
            Cell::Count(n) => vec![f64::from(*n)],
            Cell::Probability(p) => vec![p.value()],
            Cell::Interval(i) => vec![i.low, i.high],
            Cell::Text(_) => vec![],
            Cell::Undefined(why) => panic!("{why:?}"),
        })
        .collect()
}

fn assert_close(ours: &[f64], expected: &[f64]) {
    assert_eq!(ours.len(), expected.len());
    for (ours, expected) in ours.iter().zip(expected) {
        assert!(
            (ours - expected).abs() <= 1e-10 * expected.abs(),
            "{ours} {expected}"
        );
    }
}

/// scipy and NumPy: `tests/data/within.py`.
#[test]
fn every_value_of_the_table_holds() {
    let section = run(&of_table());
    assert_eq!(section.status, Status::Ok);
    let by_condition = numbers("time_condition,");
    assert_eq!(by_condition.len(), 4);
    for (row, expected) in section.tables[0].table.rows.iter().zip(&by_condition) {
        assert_close(&values(row), &expected[1..]);
    }
    let by_position = numbers("time_position,");
    assert_eq!(by_position.len(), 2);
    for (row, expected) in section.tables[1].table.rows.iter().zip(&by_position) {
        assert_close(&values(&row[2..5]), &expected[1..]);
    }
    let position = &numbers("time_test,position,")[0];
    let ours = values(&section.tables[2].table.rows[0]);
    assert_close(&ours[1..], position);
    let condition = &numbers("time_test,condition,")[0];
    let ours = values(&section.tables[3].table.rows[0]);
    assert_close(&[ours[2], ours[4], ours[0]], condition);
    assert!(
        section.findings[0].contains("59 trials are used; left out: 1 with a time of 0"),
        "{section:?}"
    );
}

#[test]
fn the_order_of_rows_does_not_matter_to_ranks_and_quantiles() {
    let mut data = of_table();
    let before = run(&data);
    data.answers.reverse();
    let after = run(&data);
    assert_eq!(before.tables[3], after.tables[3]);
    for (before, after) in (before.tables[0].table.rows.iter()).zip(&after.tables[0].table.rows) {
        assert_eq!(before[5..], after[5..]);
    }
}

#[test]
fn without_times_the_section_says_so() {
    let unanswered = Answer {
        chosen: None,
        ..answer(1, 0, true, Some(900.0))
    };
    let section = run(&study(1, vec![answer(0, 0, true, None), unanswered]));
    assert_eq!(section.status, Status::NotAvailable);
    assert!(section.tables.is_empty());
    assert!(super::section(&Context::of(&study(1, vec![]), &Settings::default())).is_none());
}

/// One time, equal times, times of 0, one participant: reasons in place of numbers.
#[test]
fn degenerate_times_have_reasons() {
    let one = run(&study(1, vec![answer(0, 0, true, Some(800.0))]));
    assert_eq!(one.tables[0].table.rows[0][3], Cell::Undefined(ONE_TIME));
    assert_eq!(one.tables[1].table.rows[0][3], Cell::Undefined(NO_TIMES));
    assert_eq!(
        one.tables[2].table.rows[0][3],
        Cell::Undefined(ONE_PARTICIPANT)
    );
    assert_eq!(
        one.tables[3].table.rows[0][2],
        Cell::Undefined(FEW_CONDITIONS)
    );

    let equal: Vec<Answer> = (0..4)
        .flat_map(|participant| {
            [
                answer(participant, 0, true, Some(500.0)),
                answer(participant, 1, false, Some(500.0)),
            ]
        })
        .collect();
    let equal = run(&study(2, equal));
    assert_eq!(equal.tables[2].table.rows[0][3], Cell::Undefined(NO_SPREAD));
    assert_eq!(equal.tables[3].table.rows[0][2], Cell::Undefined(ALL_TIED));

    let sparse: Vec<Answer> = (0..4)
        .map(|i| answer(i, i, true, Some(f32::MIN_POSITIVE)))
        .collect();
    let sparse = run(&study(4, sparse));
    assert_eq!(
        sparse.tables[3].table.rows[0][2],
        Cell::Undefined(FEW_COMPLETE)
    );

    // Two times as far apart as single precision goes: the interval has no bound.
    let far = vec![
        answer(0, 0, true, Some(1e-38)),
        answer(1, 0, true, Some(3e38)),
    ];
    let far = run(&study(1, far));
    assert!(matches!(far.tables[0].table.rows[0][3], Cell::Undefined(_)));
    for section in [one, equal, sparse, far] {
        for cell in section
            .tables
            .iter()
            .flat_map(|part| part.table.rows.iter().flatten())
        {
            match cell {
                Cell::Number(x) => assert!(x.is_finite()),
                Cell::Interval(i) => assert!(i.low.is_finite() && i.high.is_finite()),
                _ => {}
            }
        }
    }
}
