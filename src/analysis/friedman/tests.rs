use proptest::prelude::*;
use serde_json::Value;

use super::super::blocks::Unit;
use super::*;
use crate::analysis::table::Status;

fn of(rows: &[Vec<f64>]) -> Blocks {
    Blocks {
        condition: Some(0),
        unit: Unit::Participant,
        techniques: (0..rows.first().map_or(0, Vec::len)).collect(),
        values: rows.concat(),
        incomplete: 0,
    }
}

fn numbers(row: &Value) -> Vec<f64> {
    let numbers = row.as_array().unwrap().iter();
    numbers.map(|it| it.as_f64().unwrap()).collect()
}

fn assert_near(name: &str, ours: f64, expected: &Value, relative: f64) {
    let expected = expected.as_f64().unwrap();
    let error = (ours - expected).abs();
    assert!(
        error <= relative * expected.abs(),
        "{name}: {ours}, expected {expected}"
    );
}

/// Against scipy, R, and counting (`tests/data/ranks.py`).
#[test]
fn the_statistics_are_those_of_other_programs() {
    let data: Value = serde_json::from_str(include_str!("../../../tests/data/ranks.json")).unwrap();
    let mut counted = 0;
    for case in data["friedman"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        let rows: Vec<Vec<f64>> = case["rows"]
            .as_array()
            .unwrap()
            .iter()
            .map(numbers)
            .collect();
        let ours = friedman(&of(&rows)).unwrap();
        assert_near(name, ours.chi_square, &case["chi_square"], 1e-11);
        assert_near(
            name,
            ours.p_chi_square.value(),
            &case["p_chi_square"],
            1e-10,
        );
        assert_near(name, ours.w, &case["w"], 1e-11);
        match ours.f {
            Ok((f, p)) => {
                assert_near(name, f, &case["f"], 1e-10);
                assert_near(name, p.value(), &case["p_f"], 1e-9);
            }
            Err(why) => {
                assert!(case["f"].is_null(), "{name}");
                assert_eq!(why.status, Status::NoFiniteEstimate);
            }
        }
        if !case["p_exact"].is_null() {
            counted += 1;
            let p = ours.p_exact.unwrap().value();
            assert_near(name, p, &case["p_exact"], 1e-12);
        }
    }
    assert_eq!(counted, 8);
}

/// Conover (1999), section 5.8, example 1, as printed.
#[test]
fn conovers_grasses() {
    let data: Value = serde_json::from_str(include_str!("../../../tests/data/ranks.json")).unwrap();
    let rows = data["friedman"][0]["rows"].as_array().unwrap();
    let rows: Vec<Vec<f64>> = rows.iter().map(numbers).collect();
    let ours = friedman(&of(&rows)).unwrap();
    assert_eq!(format!("{:.3}", ours.chi_square), "8.097");
    assert_eq!(format!("{:.2}", ours.f.unwrap().0), "3.19");
}

/// The table of the exact distribution that Friedman (1937) printed for three ranks: n = 4.
#[test]
fn friedmans_own_table() {
    for (rows, chi_square, p) in [
        (vec![[1.0, 2.0, 3.0]; 4], 8.0, 0.0046),
        (
            vec![
                [1.0, 2.0, 3.0],
                [1.0, 2.0, 3.0],
                [1.0, 2.0, 3.0],
                [2.0, 1.0, 3.0],
            ],
            6.5,
            0.042,
        ),
    ] {
        let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.to_vec()).collect();
        let ours = friedman(&of(&rows)).unwrap();
        assert!((ours.chi_square - chi_square).abs() < 1e-12);
        let digits = if p < 0.01 { 4 } else { 3 };
        assert_eq!(
            format!("{:.digits$}", ours.p_exact.unwrap().value()),
            format!("{p:.digits$}")
        );
    }
}

#[test]
fn what_cannot_be_tested_says_why() {
    for (rows, reason) in [
        (vec![vec![1.0, 2.0]], "fewer than two complete blocks"),
        (vec![vec![1.0], vec![1.0]], "fewer than two techniques"),
        (vec![vec![3.0; 4]; 5], "every block ties"),
        (vec![], "fewer than two techniques"),
    ] {
        let why = friedman(&of(&rows)).unwrap_err();
        assert_eq!(why.status, Status::Degenerate);
        assert!(why.reason.contains(reason), "{why:?}");
    }
    let many: Vec<Vec<f64>> = (0..40)
        .map(|i| (0..7).map(|j| f64::from((i * j) % 11)).collect())
        .collect();
    let ours = friedman(&of(&many)).unwrap();
    assert_eq!(ours.p_exact.unwrap_err().status, Status::NotAvailable);
    assert_eq!(ours.p().1, "F");
}

proptest! {
    /// Neither the order of the techniques nor that of the blocks matters, and all is finite.
    #[test]
    fn techniques_and_blocks_are_exchangeable(
        rows in (2..5_usize).prop_flat_map(|k| prop::collection::vec(
            prop::collection::vec((0..4_u8).prop_map(f64::from), k), 2..8)),
        turn in 0..4_usize,
    ) {
        let ours = friedman(&of(&rows));
        let mut turned = rows.clone();
        turned.reverse();
        for row in &mut turned {
            let k = row.len();
            row.rotate_left(turn % k);
        }
        let other = friedman(&of(&turned));
        match (ours, other) {
            (Ok(ours), Ok(other)) => {
                prop_assert!((ours.chi_square - other.chi_square).abs() < 1e-12);
                let (p, q) = (ours.p_exact.unwrap().value(), other.p_exact.unwrap().value());
                prop_assert!((p - q).abs() < 1e-12);
                prop_assert!(p > 0.0 && p <= 1.0 && (0.0..=1.0).contains(&ours.w));
                prop_assert!(ours.chi_square.is_finite());
            }
            (ours, other) => prop_assert_eq!(ours, other),
        }
    }
}
