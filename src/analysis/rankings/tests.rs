use super::*;
use crate::analysis::dataset::{Rank, Rankings};

/// Rankings of `conditions`: for every participant and condition the ranks of the techniques, NaN
/// for one that was not ranked.
fn ranked(ranks: &[&[&[f32]]], techniques: &[&str]) -> Dataset {
    let mut answers = Vec::new();
    for (participant, of_conditions) in (0..).zip(ranks) {
        for (condition, row) in (0..).zip(*of_conditions) {
            let given = (0..).zip(*row).filter(|(_, rank)| rank.is_finite());
            answers.extend(given.map(|(technique, &rank)| Rank {
                participant,
                condition,
                technique,
                rank,
            }));
        }
    }
    let conditions = ranks.iter().map(|it| it.len()).max().unwrap_or(0);
    Dataset {
        participants: (0..ranks.len()).map(|i| format!("P{i}")).collect(),
        rankings: Rankings {
            conditions: (0..conditions).map(|i| format!("c{i}")).collect(),
            techniques: techniques.iter().map(|it| (*it).to_owned()).collect(),
            answers,
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

fn p(cell: &Cell) -> f64 {
    match cell {
        Cell::Probability(p) => p.value(),
        other => panic!("{other:?}"),
    }
}

const NAN: f32 = f32::NAN;

#[test]
fn mean_ranks_tests_and_pairs_by_hand() {
    let row: &[f32] = &[3.0, 2.0, 1.0];
    let data = ranked(&[&[row][..]; 6], &["none", "gtao", "traced"]);
    let section = section_of(&data);
    assert_eq!(
        column(&section, "ranks", "mean_rank"),
        [&Cell::Number(3.0), &Cell::Number(2.0), &Cell::Number(1.0)]
    );
    assert_eq!(
        column(&section, "ranks", "firsts"),
        [&Cell::Count(0), &Cell::Count(0), &Cell::Count(6)]
    );
    // All six alike: 6 of the 6^6 equally likely.
    let exact = p(column(&section, "rank_tests", "p_exact")[0]);
    assert!((exact - 6.0_f64.powi(-5)).abs() < 1e-15);
    assert_eq!(
        column(&section, "rank_tests", "kendall_w"),
        [&Cell::Number(1.0)]
    );
    assert_eq!(column(&section, "rank_tests", "n"), [&Cell::Count(6)]);
    // Each pair 0 : 6, two-sided 2/64, Holm times three.
    for (alone, corrected) in column(&section, "rank_pairs", "p_exact")
        .into_iter()
        .zip(column(&section, "rank_pairs", "p_exact_holm"))
    {
        assert!((p(alone) - 1.0 / 32.0).abs() < 1e-15);
        assert!((p(corrected) - 3.0 / 32.0).abs() < 1e-14);
    }
    assert!(
        section.findings[0].starts_with(
            "The ranks differ between the techniques in c0: Friedman's χ²(2) = 12.00, n = 6"
        ),
        "{:?}",
        section.findings
    );
    assert!(
        section
            .findings
            .iter()
            .any(|it| it.contains("Of 3 pairs of techniques 0 differ"))
    );
}

#[test]
fn incomplete_rankings_are_counted_and_left_out() {
    let whole: &[f32] = &[1.0, 2.0, 3.0];
    let part: &[f32] = &[1.0, NAN, 2.0];
    let data = ranked(&[&[whole], &[part], &[whole]], &["x", "y", "z"]);
    let section = section_of(&data);
    assert_eq!(
        column(&section, "rank_tests", "incomplete"),
        [&Cell::Count(1)]
    );
    assert_eq!(column(&section, "ranks", "n")[0], &Cell::Count(2));
    assert!(
        section
            .findings
            .iter()
            .any(|it| it.starts_with("1 rankings of a condition lack"))
    );
}

/// Over all conditions, a participant who ranks everywhere alike counts once.
#[test]
fn all_conditions_together_count_people_not_trials() {
    let row: &[f32] = &[1.0, 2.0];
    let data = ranked(&[&[row, row, row], &[row, row, row]], &["x", "y"]);
    let section = section_of(&data);
    let names: Vec<String> = column(&section, "rank_tests", "blocks")
        .iter()
        .map(|it| match it {
            Cell::Text(text) => text.clone(),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        names[3..],
        [
            "participants × conditions",
            "participants, means over conditions"
        ]
    );
    let exact: Vec<f64> = column(&section, "rank_tests", "p_exact")
        .into_iter()
        .map(p)
        .collect();
    assert!((exact[3] - 2.0 / 64.0).abs() < 1e-15, "six blocks");
    assert!((exact[4] - 0.5).abs() < 1e-15, "two people");
    assert!(
        section.findings[0].contains("over all conditions")
            && section.findings[0].contains("n = 2")
    );
}

#[test]
fn ties_alone_and_one_ranking_have_no_test() {
    let tied: &[f32] = &[1.5, 1.5];
    for (data, reason) in [
        (ranked(&[&[tied], &[tied]], &["x", "y"]), "every block ties"),
        (ranked(&[&[tied]], &["x", "y"]), "fewer than two complete"),
    ] {
        let section = section_of(&data);
        assert_eq!(section.status, Status::Degenerate);
        assert!(
            section.findings[0].contains(reason),
            "{:?}",
            section.findings
        );
    }
    assert!(section(&Context::of(&Dataset::default(), &Settings::default())).is_none());
}
