use super::balance::latin_orders;
use super::published::Printed;
use super::*;
use crate::analysis::dataset::{
    Answer, ConditionData, Dataset, Exclusion, Order, OrderCounts, Published, Votes,
};
use crate::analysis::settings::Settings;
use crate::protocol::Position;
use proptest::prelude::*;

/// The counts of 2010 and what table 4 of the thesis prints of them, from the file itself.
fn thesis() -> Dataset {
    let table = include_str!("../../../stimuli/thesis-2010-votes.csv");
    let conditions = (table.lines().skip(1))
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            ConditionData {
                id: cells[0].into(),
                technique_a: cells[1].into(),
                technique_b: cells[2].into(),
                votes: Votes {
                    a: cells[3].parse().unwrap(),
                    b: cells[4].parse().unwrap(),
                },
                published: Published {
                    chi_square: Some(cells[6].into()),
                    p: Some(cells[7].into()),
                },
                ..ConditionData::default()
            }
        })
        .collect();
    Dataset {
        conditions,
        ..Dataset::default()
    }
}

fn run(data: &Dataset) -> Section {
    section(&Context::of(data, &Settings::default())).unwrap()
}

/// check, subject, verdict, status, finding.
fn rows(data: &Dataset) -> Vec<[String; 5]> {
    (run(data).tables[0].table.rows.iter())
        .map(|row| {
            let texts: Vec<String> = (row.iter())
                .map(|cell| match cell {
                    Cell::Text(text) => text.clone(),
                    Cell::Undefined(why) => why.reason.to_owned(),
                    other => panic!("{other:?}"),
                })
                .collect();
            texts.try_into().unwrap()
        })
        .collect()
}

fn of<'a>(rows: &'a [[String; 5]], check: &str) -> Vec<&'a [String; 5]> {
    let found: Vec<_> = rows.iter().filter(|row| row[0] == check).collect();
    assert!(!found.is_empty(), "{check} not in {rows:#?}");
    found
}

/// χ² 49/9 and 4/9 print as 5.444 and 0.444, p 0.0196306… as .020; the table has 5.445, 0.445, .019.
#[test]
fn the_rounding_faults_of_2010_are_named_and_nothing_else_is() {
    let rows = rows(&thesis());
    let faults: Vec<(&str, &str)> = (rows.iter())
        .filter(|row| row[2] == "fault")
        .map(|row| (row[0].as_str(), row[1].as_str()))
        .collect();
    assert_eq!(
        faults,
        [
            ("published χ²", "sponza-moderate-h2"),
            ("published p", "sponza-moderate-h2"),
            ("published χ²", "characters-moderate"),
            ("published χ²", "sponza-high-h1"),
            ("published p", "sponza-high-h1"),
        ]
    );
    assert_eq!(
        of(&rows, "published numbers")[0][4],
        "9 of 14 are the recomputed ones, rounded"
    );
    assert_eq!(
        of(&rows, "published χ²")[0][4],
        "printed 5.445, exact 5.444444, which rounds to 5.444; the decision at alpha = 0.05 stays the same"
    );
    assert!(
        of(&rows, "published p")[0][4]
            .starts_with("printed 0.019, exact 0.019631, which rounds to 0.020;")
    );
}

#[test]
fn in_2010_nothing_stays_significant_and_the_orders_were_21_to_15() {
    let section = run(&thesis());
    let rows = rows(&thesis());
    let correction = of(&rows, "significance after correction");
    assert_eq!(correction.len(), 2);
    for row in correction {
        assert_eq!(row[2], "note");
        assert!(row[4].contains("uncorrected: 2 (sponza-moderate-h2, sponza-high-h1); with Holm's correction: none; published as significant: 2"), "{row:?}");
    }
    let balance = of(&rows, "orders within pairs")[0];
    assert_eq!(balance[2], "note");
    assert!(
        balance[4].ends_with("21 times in one order and 15 times in the other"),
        "{balance:?}"
    );
    assert!(section.findings[0].contains("5 faults"), "{section:?}");
    assert_eq!(of(&rows, "participants")[0][3], "not available");
    assert_eq!(of(&rows, "equal numbers of votes")[0][2], "ok");
}

#[test]
fn a_latin_design_reversed_by_halves() {
    assert_eq!(latin_orders(36, 7), (21, 15));
    assert_eq!(latin_orders(28, 7), (14, 14));
    assert_eq!(latin_orders(7, 7), (7, 0));
    assert_eq!(latin_orders(1, 1), (1, 0));
    // Counted one participant after the other.
    for (n, k) in [(36, 7), (50, 4), (13, 5)] {
        let as_is = (0..n).filter(|i| (i / k) % 2 == 0).count() as u32;
        assert_eq!(latin_orders(n, k), (as_is, n - as_is));
    }
}

#[test]
fn printed_numbers_of_all_kinds() {
    let right = |text: &str, numerator, denominator| {
        Printed::parse(text)
            .unwrap()
            .is_fraction(numerator, denominator)
    };
    assert!(right("5.444", 49, 9) && right("5.44", 49, 9) && right(" 5 ", 49, 9));
    assert!(!right("5.445", 49, 9) && !right("5.45", 49, 9) && !right("6", 49, 9));
    // A tie is right either way, and 2.5 to one decimal only one way.
    assert!(right("2", 5, 2) && right("3", 5, 2) && right("2.5", 5, 2) && !right("2.4", 5, 2));
    assert!(right("< .001", 1, 2000) && !right("<.001", 1, 1000));
    assert!(right("1.2e-3", 12, 10_000) && !right("1.3E-3", 12, 10_000));
    assert!(right("1e18", 1_000_000_000_000_000_000, 1));
    for bad in [
        "",
        "n.s.",
        "-1",
        "1.2.3",
        "1e999",
        "٣",
        "1234567890123456789",
        ".",
        "0,5",
    ] {
        assert_eq!(Printed::parse(bad), None, "{bad}");
    }
}

#[test]
fn other_tests_are_recognised_and_wrong_decisions_told() {
    let with = |a, b, chi_square: &str, p: &str| {
        let mut data = thesis();
        data.conditions.truncate(1);
        data.conditions[0].votes = Votes { a, b };
        data.conditions[0].published = Published {
            chi_square: Some(chi_square.into()),
            p: Some(p.into()),
        };
        rows(&data)
    };
    // Yates: 13²/36 = 4.694, p 0.030; the exact test's p is 0.029.
    let yates = with(11, 25, "4.694", "0.030");
    assert_eq!(of(&yates, "published χ²")[0][2], "note");
    assert!(of(&yates, "published p")[0][4].contains("Yates"));
    let exact = with(11, 25, "5.444", "0.029");
    assert!(of(&exact, "published p")[0][4].contains("exact binomial"));
    let wrong = with(12, 24, "4.00", "0.06");
    assert!(wrong.iter().all(|row| row[0] != "published χ²"));
    assert!(of(&wrong, "published p")[0][4].ends_with("the decision changes: it is significant"));
    let unread = with(12, 24, "4.00", "n.s.");
    assert_eq!(of(&unread, "published p")[0][3], "not available");
    let silent = with(0, 0, "0", "1");
    assert_eq!(of(&silent, "published p")[0][3], "degenerate");
}

/// Order shown, what was chosen, and how long it took.
type Trial = (Order, Option<Position>, Option<f32>);

/// Participants by conditions.
fn study(people: &[&[Trial]]) -> Dataset {
    let k = people.iter().map(|row| row.len()).max().unwrap_or(0);
    let mut orders = vec![OrderCounts::default(); k];
    let mut answers = Vec::new();
    for (participant, row) in (0..).zip(people) {
        for (condition, (order, chosen, time)) in row.iter().enumerate() {
            orders[condition].add(*order, *chosen);
            answers.push(Answer {
                participant,
                condition: condition as u32,
                order: *order,
                chosen: *chosen,
                response_time_ms: *time,
            });
        }
    }
    Dataset {
        conditions: (orders.iter().enumerate())
            .map(|(i, orders)| ConditionData {
                id: format!("c{i}"),
                votes: orders.votes(),
                orders: Some(*orders),
                ..ConditionData::default()
            })
            .collect(),
        participants: (0..people.len()).map(|i| format!("P{i}")).collect(),
        answers,
        ..Dataset::default()
    }
}

#[test]
fn odd_participants_are_named() {
    use Order::{AThenB, BThenA};
    let first = Some(Position::First);
    let second = Some(Position::Second);
    let plain = [
        (AThenB, first, Some(900.0)),
        (BThenA, second, Some(700.0)),
        (AThenB, second, Some(150.0)),
    ];
    let straight: Vec<_> = (0..7)
        .map(|i| (AThenB, first, Some(500.0 + i as f32)))
        .collect();
    let silent = [(AThenB, first, Some(0.0)), (AThenB, None, None)];
    let mut data = study(&[&plain, &straight, &plain, &silent]);
    // The rows of the duplicate stand in another order.
    data.answers[10..13].reverse();
    data.exclusions = vec![
        Exclusion {
            rule: "faster than 100 ms.".into(),
            participants: vec![],
            trials: 0,
        },
        Exclusion {
            rule: "failed a catch trial".into(),
            participants: vec!["P9".into()],
            trials: 7,
        },
    ];
    data.notes = vec!["14 trials were answered by a scripted observer, not by a person.".into()];
    let rows = rows(&data);
    let complete = of(&rows, "complete answers")[0];
    assert!(
        complete[4].starts_with("3 of 4 participants did not")
            && complete[4].ends_with("P0, P2, P3"),
        "{complete:?}"
    );
    assert!(of(&rows, "duplicate participants")[0][4].ends_with("P0 and P2"));
    let straight = of(&rows, "one position throughout")[0];
    assert!(
        straight[4].starts_with("1 of 1 participant: always first 1, always second 0; 0.02"),
        "{straight:?}"
    );
    assert!(
        straight[4].ends_with("(p 0.016 each, p 0.016 for so many): P1"),
        "{straight:?}"
    );
    assert_eq!(
        of(&rows, "response times")[0][4],
        "under 200 ms: 3 of 14 trials with a time, 1 of them 0 or less"
    );
    let exclusions = of(&rows, "exclusions");
    assert_eq!([&exclusions[0][2], &exclusions[1][2]], ["ok", "note"]);
    assert_eq!(
        exclusions[1][4],
        "failed a catch trial: 1 participant (P9), 7 trials"
    );
    assert!(of(&rows, "input")[0][4].contains("scripted observer"));
    assert_eq!(of(&rows, "enough votes")[0][2], "note");
    assert!(of(&rows, "equal numbers of votes")[0][4].starts_with("from 1 to 4"));
    assert_eq!(of(&rows, "orders within pairs")[0][2], "note");
}

#[test]
fn a_clean_study_has_no_notes() {
    use Order::{AThenB, BThenA};
    let row = |order, shift: u32| -> Vec<_> {
        (0..8_u32)
            .map(|i| {
                let position = if (i + shift).is_multiple_of(3) {
                    Position::First
                } else {
                    Position::Second
                };
                (
                    order,
                    Some(position),
                    Some(600.0 + (i * 31 + shift * 57) as f32),
                )
            })
            .collect()
    };
    let people: Vec<Vec<_>> = (0..16)
        .map(|i| row(if i / 8 == 0 { AThenB } else { BThenA }, i))
        .collect();
    let people: Vec<&[_]> = people.iter().map(Vec::as_slice).collect();
    let rows = rows(&study(&people));
    for row in rows.iter().filter(|row| row[0] != "published numbers") {
        assert_eq!(row[2], "ok", "{row:?}");
    }
}

proptest! {
    /// What Rust's own rounding prints is never a fault, and a unit off always is.
    #[test]
    fn correct_rounding_is_right(a in 0_u32..1_000_000, b in 1_u32..1_000_000, decimals in 0_usize..6) {
        let (difference, n) = (i128::from(a.abs_diff(b)), i128::from(a + b));
        let exact = (difference * difference) as f64 / n as f64;
        let text = format!("{exact:.decimals$}");
        prop_assert!(Printed::parse(&text).unwrap().is_fraction(difference * difference, n), "{text} {exact}");
        let off = format!("{:.decimals$}", exact + 1.01 * 10_f64.powi(-(decimals as i32)));
        prop_assert!(!Printed::parse(&off).unwrap().is_fraction(difference * difference, n), "{off} {exact}");
    }
}
