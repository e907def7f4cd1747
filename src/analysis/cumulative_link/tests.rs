use proptest::prelude::*;

use super::fit::{Fit, Observation, fit};
use super::*;
use crate::analysis::table::Status;

const DATA: &str = include_str!("../../../tests/data/cumulative_link_data.csv");
const EXPECTED: &str = include_str!("../../../tests/data/cumulative_link.csv");

/// A dataset of `(participant, condition, technique, points)`.
fn rated<'a>(rows: impl Iterator<Item = (&'a str, &'a str, &'a str, f32)>) -> Dataset {
    let mut data = Dataset::default();
    data.ratings.scales = vec!["realism".to_owned()];
    fn number(names: &mut Vec<String>, name: &str) -> u32 {
        let known = names.iter().position(|known| known == name);
        let at = known.unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        u32::try_from(at).unwrap()
    }
    for (participant, condition, technique, value) in rows {
        data.ratings.answers.push(Rating {
            participant: number(&mut data.participants, participant),
            condition: number(&mut data.ratings.conditions, condition),
            technique: number(&mut data.ratings.techniques, technique),
            scale: 0,
            value,
        });
    }
    data
}

fn of_case(name: &str) -> Dataset {
    rated(DATA.lines().skip(1).filter_map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        let [case, participant, condition, technique, rating] = fields[..] else {
            panic!("{line}")
        };
        (case == name).then(|| (participant, condition, technique, rating.parse().unwrap()))
    }))
}

/// Against R: ordinal's clm and sandwich's vcovCL (`tests/data/cumulative_link.R`).
#[test]
fn effects_and_errors_are_those_of_other_programs() {
    let settings = Settings::default();
    let mut seen = 0;
    for line in EXPECTED.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let data = of_case(fields[0]);
        let model = model(&data, 0);
        let rows = model.rows(&settings);
        let row = rows
            .iter()
            .find(|row| data.ratings.techniques[row.technique] == fields[1])
            .unwrap();
        for (ours, expected) in [(row.estimate, fields[2]), (row.error, fields[3])] {
            let (ours, expected) = (ours.unwrap(), expected.parse::<f64>().unwrap());
            assert!(
                (ours - expected).abs() < 1e-8 * expected.abs().max(1.0),
                "{line}: {ours}"
            );
        }
        seen += 1;
    }
    assert_eq!(seen, 6);
}

fn one(category: usize, technique: usize, condition: usize, cluster: u32) -> Observation {
    Observation {
        category,
        technique,
        condition,
        cluster,
    }
}

/// With two points and two techniques the effect is the log odds ratio, by hand.
#[test]
fn two_by_two_is_the_odds_ratio() {
    let counts = [(0, 0, 7), (1, 0, 3), (0, 1, 4), (1, 1, 9)];
    let observations: Vec<Observation> = counts
        .iter()
        .flat_map(|&(category, technique, n)| (0..n).map(move |_| (category, technique)))
        .enumerate()
        .map(|(i, (category, technique))| one(category, technique, 0, u32::try_from(i).unwrap()))
        .collect();
    let Fit { effects, errors } = fit(&observations, [2, 2, 1]).unwrap();
    let expected = (9.0 * 7.0 / (4.0 * 3.0_f64)).ln();
    assert!((effects[0] - expected).abs() < 1e-12);
    // Every rating its own cluster: White's errors, here the classical ones but for n/(n − 1).
    let classical: f64 = [7.0, 3.0, 4.0, 9.0].iter().map(|n| 1.0 / n).sum();
    let se = (classical * 23.0 / 22.0).sqrt();
    assert!((errors[0].unwrap() - se).abs() < 1e-10, "{errors:?} {se}");
}

fn status(data: &Dataset) -> (Status, String) {
    let model = model(data, 0);
    let why = model.fit.as_ref().unwrap_err();
    (why.status, model.sentence(data, &Settings::default()))
}

#[test]
fn what_has_no_estimate_says_why() {
    let people = ["P1", "P2", "P3"];
    let all = |value: fn(usize, &str) -> f32| {
        let rows = people.iter().enumerate().flat_map(move |(i, who)| {
            ["x", "y"].map(move |technique| (*who, "c", technique, value(i, technique)))
        });
        rated(rows)
    };
    let (state, said) = status(&all(
        |_, technique| if technique == "x" { 1.0 } else { 2.0 },
    ));
    assert_eq!(state, Status::NoFiniteEstimate);
    assert!(said.contains("no maximum at a finite value"), "{said}");
    // Quasi-complete: y shares the middle point with x and is never below it.
    let overlap = |i: usize, technique: &str| match (technique, i) {
        ("x", 0) => 1.0,
        ("x", _) => 2.0,
        (_, 2) => 3.0,
        _ => 2.0,
    };
    assert_eq!(status(&all(overlap)).0, Status::NoFiniteEstimate);
    let (state, said) = status(&all(|_, _| 4.0));
    assert_eq!(state, Status::Degenerate);
    assert!(said.contains("all ratings are the same"), "{said}");
    let apart = [
        ("P1", "c", "x", 1.0),
        ("P1", "d", "y", 2.0),
        ("P2", "c", "x", 2.0),
        ("P2", "d", "y", 1.0),
    ];
    assert_eq!(status(&rated(apart.into_iter())).0, Status::Disconnected);
    let many = (0..30_u8).map(|i| ("P", "c", if i % 2 == 0 { "x" } else { "y" }, f32::from(i)));
    assert_eq!(status(&rated(many)).0, Status::NotAvailable);
}

/// One participant has an estimate and no standard error.
#[test]
fn one_participant_has_no_error() {
    let rows = [
        ("P", "c", "x", 1.0),
        ("P", "c", "y", 2.0),
        ("P", "d", "x", 2.0),
        ("P", "d", "y", 1.0),
    ];
    let data = rated(rows.into_iter());
    let rows = model(&data, 0).rows(&Settings::default());
    assert!(rows[0].estimate.unwrap().abs() < 1e-9);
    assert_eq!(rows[0].error.unwrap_err().status, Status::Degenerate);
    assert_eq!(rows[0].p.unwrap_err().status, Status::Degenerate);
}

/// With techniques alone, the bounds are differences of two parameters, and the likelihood has a
/// maximum if and only if the graph of what must not fall below what is strongly connected.
fn is_strongly_connected(
    observations: &[(usize, usize)],
    [points, techniques]: [usize; 2],
) -> bool {
    let nodes = points - 1 + techniques;
    let mut edge = vec![vec![false; nodes]; nodes];
    for &(category, technique) in observations {
        let technique = points - 1 + technique;
        if category < points - 1 {
            edge[technique][category] = true;
        }
        if category > 0 {
            edge[category - 1][technique] = true;
        }
    }
    for via in 0..nodes {
        for from in 0..nodes {
            for to in 0..nodes {
                edge[from][to] |= edge[from][via] && edge[via][to];
            }
        }
    }
    (0..nodes).all(|from| (0..nodes).all(|to| from == to || edge[from][to]))
}

/// The smallest such case: one rating of one technique, at the lowest point, and two of another.
#[test]
fn a_technique_that_is_always_at_the_lowest_point_has_no_estimate() {
    let rows = [(0, 1), (0, 0), (1, 1)];
    let observations: Vec<Observation> = (0..)
        .zip(rows)
        .map(|(i, (category, technique))| one(category, technique, 0, i))
        .collect();
    assert!(!is_strongly_connected(&rows, [2, 2]));
    assert!(fit(&observations, [2, 2, 1]).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn there_is_an_estimate_where_there_must_be_one(
        rows in prop::collection::vec((0..4_usize, 0..3_usize), 3..25),
    ) {
        // Points and techniques that nobody uses are no parameters.
        let renumber = |used: Vec<usize>| {
            let mut all = used.clone();
            all.sort_unstable();
            all.dedup();
            let numbers: Vec<usize> = used.iter().map(|it| all.binary_search(it).unwrap()).collect();
            (numbers, all.len())
        };
        let (points, point_count) = renumber(rows.iter().map(|it| it.0).collect());
        let (techniques, technique_count) = renumber(rows.iter().map(|it| it.1).collect());
        prop_assume!(point_count > 1 && technique_count > 1);
        let pairs: Vec<(usize, usize)> = points.into_iter().zip(techniques).collect();
        let observations: Vec<Observation> = (0..).zip(&pairs)
            .map(|(i, &(category, technique))| one(category, technique, 0, i))
            .collect();
        let there_is = is_strongly_connected(&pairs, [point_count, technique_count]);
        let found = fit(&observations, [point_count, technique_count, 1]);
        prop_assert_eq!(found.is_ok(), there_is, "{:?}", pairs);
        if let Ok(found) = found {
            prop_assert!(found.effects.iter().all(|it| it.is_finite()));
        }
    }

    /// Which technique is the reference does not matter: effects are differences.
    #[test]
    fn effects_are_differences(rows in prop::collection::vec((0..3_usize, 0..3_usize), 20..60)) {
        let with = |turn: usize| -> Option<Vec<f64>> {
            let observations: Vec<Observation> = (0..).zip(&rows)
                .map(|(i, &(category, technique))| one(category, (technique + turn) % 3, 0, i / 3))
                .collect();
            let mut all = vec![0.0];
            all.extend(fit(&observations, [3, 3, 1]).ok()?.effects);
            all.rotate_left(turn);
            let first = all[0];
            Some(all.iter().map(|it| it - first).collect())
        };
        let used = |of: fn(&(usize, usize)) -> usize| (0..3).all(|it| rows.iter().any(|row| of(row) == it));
        prop_assume!(used(|row| row.0) && used(|row| row.1));
        match (with(0), with(1)) {
            (Some(one), Some(other)) => {
                for (one, other) in one.iter().zip(&other) {
                    prop_assert!((one - other).abs() < 1e-8);
                }
            }
            (one, other) => prop_assert_eq!(one, other),
        }
    }
}
