use super::*;
use crate::analysis::dataset::{Answer, ConditionData, Dataset, Order, OrderCounts};
use crate::analysis::settings::Settings;
use crate::protocol::Position;
use proptest::prelude::*;
use triads::{circular, distribution, most_circular};

/// Observers who answer conditions (scene, a, b); `b` for technique b, `a` for a, else nothing.
fn study(conditions: &[(Option<&str>, &str, &str)], answers: &[&str]) -> Dataset {
    let mut data = Dataset {
        conditions: conditions
            .iter()
            .enumerate()
            .map(|(at, &(scene, a, b))| ConditionData {
                id: format!("c{at}"),
                technique_a: a.into(),
                technique_b: b.into(),
                scene: scene.map(str::to_owned),
                orders: Some(OrderCounts::default()),
                ..ConditionData::default()
            })
            .collect(),
        ..Dataset::default()
    };
    for (participant, line) in answers.iter().enumerate() {
        data.participants.push(format!("P{participant}"));
        for (condition, said) in line.chars().enumerate() {
            let order = if (participant + condition).is_multiple_of(2) {
                Order::AThenB
            } else {
                Order::BThenA
            };
            let chosen = match said {
                'a' | 'b' => Some(if (said == 'b') == (order == Order::AThenB) {
                    Position::Second
                } else {
                    Position::First
                }),
                _ => None,
            };
            let known = &mut data.conditions[condition];
            if let Some(counts) = &mut known.orders {
                counts.add(order, chosen);
                known.votes = counts.votes();
            }
            data.answers.push(Answer {
                participant: participant as u32,
                condition: condition as u32,
                order,
                chosen,
                response_time_ms: None,
            });
        }
    }
    data
}

fn report(data: &Dataset) -> Section {
    section(&Context::of(data, &Settings::default())).unwrap()
}

fn column<'a>(section: &'a Section, table: &str, key: &str) -> Vec<&'a Cell> {
    let found = section.tables.iter().find(|part| part.id == table);
    found.unwrap().table.column(key).collect()
}

fn number(cell: &Cell) -> f64 {
    match cell {
        Cell::Number(number) => *number,
        Cell::Probability(p) => p.value(),
        Cell::Count(count) => f64::from(*count),
        _ => panic!("{cell:?}"),
    }
}

fn values(kind: &str) -> impl Iterator<Item = (String, String, String)> + use<'_> {
    let text = include_str!("../../../tests/data/consistency.csv");
    text.lines().skip(1).filter_map(move |line| {
        let cells: Vec<&str> = line.split(',').collect();
        (cells[0] == kind).then(|| (cells[1].into(), cells[2].into(), cells[3].into()))
    })
}

/// Kendall & Babington Smith 1940 counted these by hand up to seven; so does `consistency.py`.
#[test]
fn circular_triads_of_all_tournaments_are_counted() {
    let mut rows = 0;
    for (t, d, count) in values("triads") {
        let t: u8 = t.parse().unwrap();
        let d: usize = d.parse().unwrap();
        let count: f64 = count.parse().unwrap();
        let ours = distribution(t)[d] * 2_f64.powi(i32::from(t) * (i32::from(t) - 1) / 2);
        assert!(
            (ours - count).abs() < 1e-9 * count.max(1.0),
            "{t} {d}: {ours} {count}"
        );
        rows += 1;
    }
    assert_eq!(rows, 2 + 3 + 6 + 9 + 15);
    // Their table for four: 24, 16 and 24 of 64.
    assert_eq!(distribution(4), [24.0 / 64.0, 16.0 / 64.0, 24.0 / 64.0]);
}

#[test]
fn the_distribution_has_the_moments_that_moran_proved() {
    for t in 3..=10_u8 {
        let known = distribution(t);
        let moment = |f: &dyn Fn(f64) -> f64| -> f64 {
            known.iter().enumerate().map(|(d, p)| p * f(d as f64)).sum()
        };
        let n = f64::from(t);
        let triples = n * (n - 1.0) * (n - 2.0) / 6.0;
        let mean = moment(&|d| d);
        assert!((moment(&|_| 1.0) - 1.0).abs() < 1e-12);
        assert!((mean / (triples / 4.0) - 1.0).abs() < 1e-12);
        let variance = moment(&|d| (d - mean).powi(2));
        assert!((variance / (triples * 3.0 / 16.0) - 1.0).abs() < 1e-12);
        let third = moment(&|d| (d - mean).powi(3));
        assert!((third + triples * (n - 4.0) * 3.0 / 32.0).abs() < 1e-10 * triples);
    }
}

/// Where counting stops, chi-square is as close as it gets for a distribution as ragged as that of
/// ten techniques (largest difference 0.0105).
#[test]
fn kendalls_chi_square_is_close_where_counting_stops() {
    let mut chance = Chance::default();
    for d in 0..=most_circular(10) {
        let exact = chance.at_most(&[10], d).value();
        let near = triads::approximate(&[10], d).value();
        assert!((exact - near).abs() < 0.0105, "{d}: {exact} {near}");
    }
    for d in [0, 50, 200, 285] {
        assert!(chance.at_most(&[20], d).ln().is_finite());
        assert!(chance.at_most(&[3; 500], d).ln().is_finite());
    }
    // Sets add up: two of three techniques have no circle with probability (3/4)².
    assert!((chance.at_most(&[3, 3], 0).value() - 0.5625).abs() < 1e-15);
}

proptest! {
    /// The formula against all triples, and ζ = 1 exactly where the order is transitive.
    #[test]
    fn the_formula_counts_circular_triads(t in 3..8_usize, code in any::<u32>()) {
        let pairs: Vec<(usize, usize)> =
            (0..t).flat_map(|i| (i + 1..t).map(move |j| (i, j))).collect();
        let mut beats = vec![vec![false; t]; t];
        let mut scores = vec![0_u32; t];
        for (at, &(i, j)) in pairs.iter().enumerate() {
            let first = code >> at & 1 == 1;
            beats[i][j] = first;
            beats[j][i] = !first;
            scores[if first { i } else { j }] += 1;
        }
        let mut count = 0;
        for i in 0..t {
            for j in i + 1..t {
                for k in j + 1..t {
                    let around = (beats[i][j] && beats[j][k] && beats[k][i])
                        || (beats[j][i] && beats[k][j] && beats[i][k]);
                    count += u32::from(around);
                }
            }
        }
        prop_assert_eq!(circular(&scores), count);
        prop_assert!(count <= most_circular(t));
        // An order is transitive where everybody has another score.
        let mut sorted = scores;
        sorted.sort_unstable();
        sorted.dedup();
        prop_assert_eq!(count == 0, sorted.len() == t);
        // The same through the section.
        let names = ["t0", "t1", "t2", "t3", "t4", "t5", "t6"];
        let conditions: Vec<_> = pairs.iter().map(|&(i, j)| (None, names[i], names[j])).collect();
        let line: String = (0..pairs.len()).map(|at| if code >> at & 1 == 1 { 'a' } else { 'b' }).collect();
        let section = report(&study(&conditions, &[&line, &line]));
        prop_assert_eq!(column(&section, "by_participant", "circular_triads")[0], &Cell::Count(count));
        let zeta = number(column(&section, "by_participant", "zeta")[0]);
        prop_assert_eq!((zeta - 1.0).abs() < 1e-12, count == 0);
        prop_assert!((0.0..=1.0).contains(&zeta));
        // Two who say the same agree completely.
        prop_assert!((number(column(&section, "agreement", "u")[0]) - 1.0).abs() < 1e-12);
    }
}

/// Every value of u that small groups can have, with its exact p: `consistency.py`.
#[test]
fn u_and_its_p_hold_for_all_outcomes_of_small_groups() {
    for (m, t) in [(2_u32, 3_u32), (3, 3), (4, 3), (5, 3), (3, 4)] {
        let pairs = t * (t - 1) / 2;
        let kind = format!("u {m} {t}");
        let expected: Vec<(u32, f64, f64)> = values(&kind)
            .map(|(s, u, p)| (s.parse().unwrap(), u.parse().unwrap(), p.parse().unwrap()))
            .collect();
        assert!(expected.len() > 2);
        let mut seen = std::collections::BTreeSet::new();
        for code in 0..(m + 1).pow(pairs) {
            let for_i: Vec<u32> = (0..pairs)
                .map(|at| code / (m + 1).pow(at) % (m + 1))
                .collect();
            let two = |n: u32| n * n.saturating_sub(1) / 2;
            let agreeing: u32 = for_i.iter().map(|c| two(*c) + two(m - c)).sum();
            let ours = agreement::coefficient(m, &for_i).unwrap();
            let (_, u, p) = expected.iter().find(|row| row.0 == agreeing).unwrap();
            assert!((ours.u - u).abs() < 1e-12);
            assert!(
                (ours.p_exact.unwrap().value() - p).abs() < 1e-12,
                "{for_i:?}"
            );
            seen.insert(agreeing);
        }
        assert_eq!(seen.len(), expected.len());
    }
    assert!(agreement::coefficient(1, &[1, 1, 0]).is_err());
    let many = agreement::coefficient(1_000_000, &[500_000; 45]).unwrap();
    assert!(many.p_exact.is_err() && many.u < 0.0);
}

/// Every number of the outlier table, looked up observer by observer in `consistency.py`.
#[test]
fn the_outlier_score_is_that_of_looking_up_every_other_observer() {
    let lines: Vec<String> = values("answers").map(|row| row.2).collect();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    let section = report(&study(&[(None, "x", "y"); 6], &lines));
    for (kind, key) in [
        ("majority", "agreement"),
        ("mean", "mean_log_likelihood"),
        ("z", "agreement_z"),
        ("score", "outlier_score"),
    ] {
        let ours = column(&section, "by_participant", key);
        for (at, (_, _, expected)) in values(kind).enumerate() {
            let expected: f64 = expected.parse().unwrap();
            assert!((number(ours[at]) - expected).abs() < 1e-12, "{kind} {at}");
        }
    }
}

/// Thirty observers share an opinion but for a slip each; one has the opposite.
#[test]
fn who_answers_against_everybody_is_named() {
    let mut lines: Vec<String> = (0..30)
        .map(|at| {
            (0..8)
                .map(|c| if c == at % 8 { 'a' } else { 'b' })
                .collect()
        })
        .collect();
    lines[17] = "aaaaaaaa".into();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    let section = report(&study(&[(None, "x", "y"); 8], &lines));
    assert!(
        section.findings[0].starts_with("1 of 30 observers"),
        "{:?}",
        section.findings
    );
    assert!(section.findings[0].contains(": P17. Nobody was left out"));
}

#[test]
fn hard_cases_have_reasons() {
    let one = report(&study(&[(None, "x", "y")], &["b"]));
    assert_eq!(one.status, Status::Degenerate);
    assert!(matches!(
        column(&one, "by_participant", "agreement")[0],
        Cell::Undefined(_)
    ));
    let unanimous = report(&study(&[(None, "x", "y")], &["b"; 9]));
    assert_eq!(unanimous.status, Status::Degenerate);
    assert_eq!(
        number(column(&unanimous, "by_participant", "agreement")[0]),
        1.0
    );
    let missing = report(&study(&[(None, "x", "y")], &["b", "-", "a"]));
    assert_eq!(
        column(&missing, "by_participant", "answers")[1],
        &Cell::Count(0)
    );
    let context = (Dataset::default(), Settings::default());
    assert!(section(&Context::of(&context.0, &context.1)).is_none());
}

/// A scene is a set of its own; an incomplete one, or an observer with a gap or a tie, is none.
#[test]
fn sets_are_complete_or_not_counted() {
    let conditions = [
        (Some("hall"), "x", "y"),
        (Some("hall"), "z", "y"),
        (Some("hall"), "x", "z"),
        (Some("yard"), "x", "y"),
        (Some("yard"), "y", "z"),
    ];
    // x > y, y > z, z > x: a circle; x > y > z, x > z: none; a gap.
    let data = study(&conditions, &["abbaa", "abaaa", "a-aaa"]);
    let section = report(&data);
    let circles = column(&section, "by_participant", "circular_triads");
    assert_eq!(circles[..2], [&Cell::Count(1), &Cell::Count(0)]);
    assert!(matches!(circles[2], Cell::Undefined(_)));
    assert_eq!(number(column(&section, "by_participant", "zeta")[0]), 0.0);
    assert_eq!(
        number(column(&section, "by_participant", "p_triads")[1]),
        0.75
    );
    assert_eq!(
        column(&section, "agreement", "scene"),
        [&Cell::Text("hall".into())]
    );
    assert_eq!(
        column(&section, "agreement", "observers"),
        [&Cell::Count(2)]
    );
    // Two agree on x > y and y > z and differ on x, z: u = 2·2/3 − 1.
    assert!((number(column(&section, "agreement", "u")[0]) - 1.0 / 3.0).abs() < 1e-12);
    // The same pair twice, once each way, is undecided.
    let twice = [
        (None, "x", "y"),
        (None, "y", "z"),
        (None, "x", "z"),
        (None, "y", "x"),
    ];
    let section = report(&study(&twice, &["aaaa", "aaab"]));
    let circles = column(&section, "by_participant", "circular_triads");
    assert!(matches!(circles[0], Cell::Undefined(_)));
    assert_eq!(circles[1], &Cell::Count(0));
}
