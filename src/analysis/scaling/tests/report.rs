//! What the section says of the 2010 study, and of scenes.

use super::*;
use crate::analysis::input::{Options, read};

fn thesis() -> Dataset {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("votes.csv");
    let votes = include_str!("../../../../stimuli/thesis-2010-votes.csv");
    std::fs::write(&path, votes).unwrap();
    read(&[path], Options::default()).unwrap()
}

/// Two techniques were compared only with each other: two scales, each with its own zero.
#[test]
fn the_study_of_2010_has_two_scales() {
    let section = report_of(&thesis());
    assert_eq!(section.status, Status::Disconnected);
    assert!(all_finite(&section));
    let jod = table(&section, "jod");
    let names: Vec<&Cell> = jod.column("technique").collect();
    let text = |name: &str| Cell::Text(name.into());
    assert_eq!(
        names,
        [
            &text("crytek24"),
            &text("blizzard24"),
            &text("none"),
            &text("blizzard8"),
            &text("ray-march30")
        ]
    );
    let parts: Vec<&Cell> = jod.column("component").collect();
    let (one, two) = (Cell::Count(1), Cell::Count(2));
    assert_eq!(parts, [&one, &one, &one, &two, &two]);
    assert!(jod.column("status").all(|cell| *cell == text("ok")));
    // Probit of 61/108, less probit of 62/108, and of 20/36, by 0.6744897501960817: scipy 1.17.
    for (row, expected) in [
        (1, 0.241_942_973_311_932_7),
        (2, -0.034_942_066_096_664_7),
        (4, 0.207_134_799_070_329_5),
    ] {
        let value = number(cell(jod, row, "jod"));
        assert!((value - expected).abs() < 1e-12, "{row}: {value}");
    }
    assert!(
        section.findings[0].contains("{crytek24, blizzard24, none}, {blizzard8, ray-march30}"),
        "{:?}",
        section.findings
    );
}

/// A technique that was planned and never voted on is no component with a scale.
#[test]
fn a_technique_without_votes_is_named() {
    let section = report_of(&counted(&[("x", "y", 5, 6), ("x", "z", 0, 0)]));
    assert_eq!(section.status, Status::Disconnected);
    assert!(
        section.findings[0].contains("{z}"),
        "{:?}",
        section.findings
    );
    let status = cell(table(&section, "jod"), 2, "status");
    assert_eq!(status, &Cell::Text("no votes".into()));
}

#[test]
fn scenes_that_disagree_are_told_apart() {
    let mut data = counted(&[
        ("x", "y", 80, 20),
        ("y", "z", 70, 30),
        ("x", "z", 75, 25),
        ("x", "y", 20, 80),
        ("y", "z", 30, 70),
        ("x", "z", 25, 75),
    ]);
    for (at, condition) in data.conditions.iter_mut().enumerate() {
        condition.scene = Some(if at < 3 { "hall" } else { "yard" }.to_owned());
    }
    let section = report_of(&data);
    assert!(all_finite(&section));
    let test = table(&section, "one_scale");
    assert_eq!(cell(test, 0, "df"), &Cell::Count(2));
    assert!(matches!(cell(test, 0, "p"), Cell::Probability(p) if p.value() < 1e-20));
    assert!(
        section
            .findings
            .iter()
            .any(|f| f.starts_with("The scales of the scenes differ"))
    );
    assert_eq!(table(&section, "by_scene").rows.len(), 6);
    // The pooled scale says nothing is different.
    for row in 0..3 {
        assert!(number(cell(table(&section, "jod"), row, "jod")).abs() < 1e-12);
    }
}

/// The order effect is read from the data's own orders, turned base orders included.
#[test]
fn order_counts_of_turned_conditions_are_the_same_pair() {
    use super::super::order_effect::{Ordered, ordered};
    use crate::analysis::dataset::{Answer, Order, OrderCounts};
    let mut data = counted(&[("x", "y", 5, 7), ("y", "x", 3, 4)]);
    data.conditions[0].orders = Some(OrderCounts {
        ab_first: 3,
        ab_second: 1,
        ba_first: 6,
        ba_second: 2,
        missing: 0,
    });
    data.conditions[1].orders = Some(OrderCounts {
        ab_first: 1,
        ab_second: 2,
        ba_first: 2,
        ba_second: 2,
        missing: 1,
    });
    data.answers.push(Answer {
        participant: 0,
        condition: 0,
        order: Order::AThenB,
        chosen: None,
        response_time_ms: None,
    });
    let table = Comparisons::of(&data.conditions);
    // Second condition: a is y. Shown a, b is y then x.
    assert_eq!(
        ordered(&data, &table).unwrap(),
        [
            Ordered {
                first: 0,
                second: 1,
                first_wins: 5,
                second_wins: 3
            },
            Ordered {
                first: 1,
                second: 0,
                first_wins: 7,
                second_wins: 4
            },
        ]
    );
}
