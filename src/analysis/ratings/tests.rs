use proptest::prelude::*;

use super::*;
use crate::analysis::analyse;
use crate::analysis::dataset::Ratings;

/// Ratings `(participant, condition, technique, scale, value)` by number, in the order a reader has
/// them.
fn rated(mut rows: Vec<(u32, u32, u32, u32, f32)>) -> Dataset {
    rows.sort_by_key(|row| (row.0, row.1, row.3, row.2));
    rows.dedup_by_key(|row| (row.0, row.1, row.3, row.2));
    let names = |letter: &str, most: u32| (0..=most).map(|i| format!("{letter}{i}")).collect();
    let most = |of: fn(&(u32, u32, u32, u32, f32)) -> u32| rows.iter().map(of).max().unwrap_or(0);
    Dataset {
        participants: names("P", most(|it| it.0)),
        ratings: Ratings {
            conditions: names("c", most(|it| it.1)),
            techniques: names("t", most(|it| it.2)),
            scales: names("s", most(|it| it.3)),
            answers: rows
                .iter()
                .map(|it| Rating {
                    participant: it.0,
                    condition: it.1,
                    technique: it.2,
                    scale: it.3,
                    value: it.4,
                })
                .collect(),
        },
        ..Dataset::default()
    }
}

fn section_of(data: &Dataset) -> Section {
    section(&Context::of(data, &Settings::default())).unwrap()
}

fn column<'a>(section: &'a Section, table: &str, key: &str) -> Vec<&'a Cell> {
    let part = section.tables.iter().find(|it| it.id == table).unwrap();
    part.table.column(key).collect()
}

#[test]
fn means_intervals_and_medians_by_hand() {
    let values = [2.0, 4.0, 4.0, 6.0];
    let mut rows: Vec<_> = (0..).zip(values).map(|(i, v)| (i, 0, 0, 0, v)).collect();
    rows.extend((0..4).map(|i| (i, 0, 1, 0, 5.0)));
    rows.push((0, 0, 2, 0, 3.0));
    let section = section_of(&rated(rows));
    assert_eq!(column(&section, "ratings", "mean")[0], &Cell::Number(4.0));
    assert_eq!(column(&section, "ratings", "median")[0], &Cell::Number(4.0));
    let Cell::Interval(ends) = column(&section, "ratings", "mean_ci")[0] else {
        panic!("{section:?}")
    };
    // sd = √(8/3); t(0.975, 3) = 3.182446305284263 (R: qt).
    let half = 3.182_446_305_284_263 * (8.0_f64 / 3.0).sqrt() / 2.0;
    assert!((ends.high - 4.0 - half).abs() < 1e-12 && (4.0 - half - ends.low).abs() < 1e-12);
    for (row, reason) in [(1, "all ratings are the same"), (2, "one rating only")] {
        let Cell::Undefined(why) = column(&section, "ratings", "mean_ci")[row] else {
            panic!("{section:?}")
        };
        assert_eq!(why.reason, reason);
    }
}

#[test]
fn every_scale_is_tested_by_itself() {
    // On s0 t1 is always higher by one, on s1 they are alike.
    let rows = (0..8).flat_map(|i| {
        let value = (i % 3) as f32 + 1.0;
        [
            (i, 0, 0, 0, value),
            (i, 0, 1, 0, value + 1.0),
            (i, 0, 0, 1, value),
            (i, 0, 1, 1, value),
        ]
    });
    let section = section_of(&rated(rows.collect()));
    let p = column(&section, "rating_pairs", "p");
    let Cell::Probability(first) = p[0] else {
        panic!("{p:?}")
    };
    // All eight one way: 2 / 2^8.
    assert!((first.value() - 2.0 / 256.0).abs() < 1e-15);
    assert!(matches!(p[1], Cell::Undefined(_)), "{p:?}");
    assert_eq!(
        column(&section, "rating_pairs", "biserial")[0],
        &Cell::Number(1.0)
    );
    assert_eq!(
        column(&section, "rating_pairs", "v")[0],
        &Cell::Number(36.0)
    );
    assert!(
        section.findings[0].starts_with("The ratings of s0 differ between the techniques in c0"),
        "{:?}",
        section.findings
    );
    assert!(
        section
            .findings
            .iter()
            .any(|it| it.contains("ratings of s1 in c0 could not be tested: every block ties"))
    );
    assert!(section.findings.iter().any(|it| {
        it.starts_with("Proportional-odds model of s0 (16 ratings by 8 participants, 4 points")
    }));
}

proptest! {
    /// Whatever was rated, every number of the report is finite or says why it is not there.
    #[test]
    fn every_number_is_finite(
        rows in prop::collection::vec((0..4_u32, 0..2_u32, 0..3_u32, 0..2_u32, (0..5_u8).prop_map(f32::from)), 1..40),
    ) {
        let analysis = analyse(rated(rows), Settings::default());
        for section in &analysis.sections {
            for part in &section.tables {
                for row in &part.table.rows {
                    prop_assert_eq!(row.len(), part.table.columns.len());
                    for cell in row {
                        match cell {
                            Cell::Number(number) => prop_assert!(number.is_finite()),
                            Cell::Interval(ends) => prop_assert!(ends.low.is_finite() && ends.high.is_finite() && ends.low <= ends.high),
                            Cell::Probability(p) => prop_assert!((0.0..=1.0).contains(&p.value())),
                            Cell::Text(_) | Cell::Count(_) => {}
                            Cell::Undefined(why) => prop_assert!(why.status != Status::Ok && !why.reason.is_empty()),
                        }
                    }
                }
            }
            for finding in &section.findings {
                prop_assert!(!finding.contains("NaN") && !finding.contains("inf"), "{}", finding);
            }
        }
    }
}
