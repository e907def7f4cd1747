use proptest::prelude::*;
use serde_json::Value;

use super::*;

/// Against scipy and counting all signs (`tests/data/ranks.py`).
#[test]
fn the_statistics_are_those_of_other_programs() {
    let data: Value = serde_json::from_str(include_str!("../../../tests/data/ranks.json")).unwrap();
    for case in data["wilcoxon"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        let differences = case["differences"].as_array().unwrap().iter();
        let ours = signed_rank(differences.map(|it| it.as_f64().unwrap())).unwrap();
        assert_eq!(u64::from(ours.n), case["n"].as_u64().unwrap(), "{name}");
        for (ours, key) in [
            (ours.positive, "v"),
            (ours.p.value(), "p"),
            (ours.biserial, "biserial"),
        ] {
            let expected = case[key].as_f64().unwrap();
            let error = (ours - expected).abs();
            assert!(
                error <= 1e-11 * expected.abs(),
                "{name} {key}: {ours}, {expected}"
            );
        }
    }
}

/// Ties by a decimal that binary numbers miss are ties: 0.3 − 0.2 and 0.2 − 0.1.
#[test]
fn rounding_makes_no_order() {
    let ours = signed_rank([0.3 - 0.2, -(0.2 - 0.1), 0.1].into_iter()).unwrap();
    assert_eq!((ours.n, ours.positive), (3, 4.0));
}

#[test]
fn without_a_difference_there_is_no_test() {
    for differences in [&[][..], &[0.0, 0.0]] {
        let why = signed_rank(differences.iter().copied()).unwrap_err();
        assert!(why.reason.contains("differently"));
    }
}

proptest! {
    #[test]
    fn signs_turned_round_give_the_same_p(
        differences in prop::collection::vec((-5..6_i8).prop_map(f64::from), 1..130),
    ) {
        let ours = signed_rank(differences.iter().copied());
        let turned = signed_rank(differences.iter().map(|d| -d));
        match (ours, turned) {
            (Ok(ours), Ok(turned)) => {
                prop_assert!((ours.p.value() - turned.p.value()).abs() < 1e-12);
                prop_assert!((ours.biserial + turned.biserial).abs() < 1e-12);
                prop_assert!(ours.p.value() > 0.0 && ours.p.value() <= 1.0);
            }
            (ours, turned) => prop_assert_eq!(ours, turned),
        }
    }
}
