//! Votes that break careless code.

use super::*;

#[test]
fn no_conditions_no_section() {
    let context = (Dataset::default(), Settings::default());
    assert!((super::super::STATISTIC.section)(&Context::of(&context.0, &context.1)).is_none());
}

#[test]
fn no_votes_are_degenerate() {
    let section = report_of(&counted(&[("x", "y", 0, 0), ("y", "z", 0, 0)]));
    assert_eq!(section.status, Status::Degenerate);
    assert!(all_finite(&section));
    assert!(matches!(
        cell(table(&section, "jod"), 0, "jod"),
        Cell::Undefined(_)
    ));
    assert_eq!(
        section.findings,
        ["There is no vote, so there is no scale."]
    );
}

#[test]
fn one_vote_is_penalised_and_says_so() {
    let section = report_of(&counted(&[("x", "y", 1, 0)]));
    assert_eq!(section.status, Status::NoFiniteEstimate);
    assert!(all_finite(&section));
    let jod = table(&section, "jod");
    assert_eq!(cell(jod, 1, "status"), &Cell::Text("Firth".into()));
    assert!(
        matches!(cell(jod, 1, "jod_unpenalised"), Cell::Undefined(why) if why.status == Status::NoFiniteEstimate)
    );
    assert!(number(cell(jod, 1, "jod")) < 0.0);
    assert!(
        section.findings[0].contains("between {x} and {y} to the former"),
        "{:?}",
        section.findings
    );
}

#[test]
fn a_technique_that_never_wins_is_named() {
    let section = report_of(&counted(&[
        ("x", "y", 12, 24),
        ("x", "z", 30, 0),
        ("y", "z", 36, 0),
    ]));
    assert_eq!(section.status, Status::NoFiniteEstimate);
    assert!(all_finite(&section));
    assert!(
        section.findings[0].contains("between {x, y} and {z} to the former"),
        "{:?}",
        section.findings
    );
    assert!(
        table(&section, "pairwise")
            .column("status")
            .all(|cell| *cell == Cell::Text("Firth".into()))
    );
    assert!(matches!(
        cell(table(&section, "fit"), 0, "g2"),
        Cell::Undefined(_)
    ));
}

#[test]
fn ties_of_everything_stand_at_one_place() {
    let section = report_of(&counted(&[
        ("x", "y", 5, 5),
        ("y", "z", 5, 5),
        ("x", "z", 5, 5),
    ]));
    assert_eq!(section.status, Status::Ok);
    for row in 0..3 {
        assert_eq!(number(cell(table(&section, "jod"), row, "jod")), 0.0);
    }
    assert_eq!(number(cell(table(&section, "fit"), 0, "g2")), 0.0);
    assert!(section.findings.iter().any(|f| f.contains("same place")));
    for p in table(&section, "pairwise").column("p") {
        assert!(matches!(p, Cell::Probability(p) if p.value() == 1.0));
    }
}

/// The standard errors go with 1/√n and nothing else moves.
#[test]
fn a_thousand_million_votes_give_the_scale_of_a_hundred() {
    let rows = |n: u32| {
        counted(&[
            ("x", "y", 40 * n, 60 * n),
            ("y", "z", 55 * n, 45 * n),
            ("x", "z", 30 * n, 70 * n),
        ])
    };
    let small = report_of(&rows(1));
    for n in [10_000, 10_000_000] {
        let large = report_of(&rows(n));
        assert_eq!(large.status, Status::Ok);
        assert!(all_finite(&large));
        for row in 1..3 {
            for (key, factor) in [("jod", 1.0), ("se", f64::from(n).sqrt())] {
                let (few, many) = (
                    cell(table(&small, "jod"), row, key),
                    cell(table(&large, "jod"), row, key),
                );
                assert!((number(few) / (number(many) * factor) - 1.0).abs() < 1e-9);
            }
        }
        let g2 = |section| number(cell(table(section, "fit"), 0, "g2"));
        assert!((g2(&large) / (g2(&small) * f64::from(n)) - 1.0).abs() < 1e-7);
    }
}

#[test]
fn all_but_one_of_a_thousand_million_votes() {
    let most = 999_999_999;
    let section = report_of(&counted(&[
        ("x", "y", 1, most),
        ("y", "z", 1, most),
        ("z", "w", most, 1),
    ]));
    assert_eq!(section.status, Status::Ok);
    assert!(all_finite(&section));
    // A tree: every distance is the probit of its share, z(1e-9) = 5.9978070150076865 (scipy).
    let expected = 2.0 * 5.997_807_015_007_686_5 / super::super::link::PROBIT_OF_JOD;
    let jod = number(cell(table(&section, "jod"), 2, "jod"));
    assert!((jod / expected - 1.0).abs() < 1e-10, "{jod} {expected}");
}

#[test]
fn a_long_chain_of_one_way_votes_has_finite_penalised_numbers() {
    let names: Vec<String> = (0..20).map(|at| format!("t{at}")).collect();
    let rows: Vec<(&str, &str, u32, u32)> = names
        .windows(2)
        .map(|pair| (pair[0].as_str(), pair[1].as_str(), 0, 1_000_000_000))
        .collect();
    let section = report_of(&counted(&rows));
    assert_eq!(section.status, Status::NoFiniteEstimate);
    assert!(all_finite(&section));
    let values: Vec<f64> = table(&section, "jod").column("jod").map(number).collect();
    assert!(
        values.windows(2).all(|pair| pair[0] < pair[1]),
        "{values:?}"
    );
}

#[test]
fn too_many_techniques_are_refused_in_words() {
    let names: Vec<String> = (0..300).map(|at| format!("t{at}")).collect();
    let rows: Vec<(&str, &str, u32, u32)> = names
        .windows(2)
        .map(|pair| (pair[0].as_str(), pair[1].as_str(), 1, 1))
        .collect();
    let section = report_of(&counted(&rows));
    assert_eq!(section.status, Status::NotAvailable);
    let section = report_of(&counted(&rows[..150]));
    assert_eq!(section.status, Status::Ok);
    assert!(all_finite(&section));
}
