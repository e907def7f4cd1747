use super::*;
use proptest::prelude::*;

/// Allowed relative error, of a logarithm or of an interval's end.
const ALLOWED: f64 = 1e-12;

#[test]
fn every_value_of_the_table_holds() {
    let mut rows = 0;
    for line in include_str!("../../../tests/data/evidence.csv")
        .lines()
        .skip(1)
    {
        let cells: Vec<&str> = line.split(',').collect();
        if !matches!(cells[0], "ln_bayes_factor" | "credible") {
            continue;
        }
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        let votes = Votes {
            a: cells[1].parse().unwrap(),
            b: cells[2].parse().unwrap(),
        };
        let (ours, expected): (Vec<f64>, Vec<f64>) = match cells[0] {
            "ln_bayes_factor" => (vec![ln_bayes_factor(votes, number(3))], vec![number(4)]),
            _ => {
                let interval = credible_interval(votes, Alpha::try_from(number(3)).unwrap());
                (
                    vec![interval.low, interval.high],
                    vec![number(4), number(5)],
                )
            }
        };
        rows += 1;
        for (ours, expected) in ours.iter().zip(&expected) {
            // A factor near 1 has a logarithm near 0: there the error of the factor counts.
            let allowed = ALLOWED
                * if cells[0] == "credible" {
                    expected.abs()
                } else {
                    expected.abs().max(1.0)
                };
            assert!((ours - expected).abs() <= allowed, "{line}: {ours}");
        }
    }
    assert!(rows > 60, "{rows} rows");
}

/// One vote tells nothing of an even split: either way it had probability ½ under both.
#[test]
fn one_vote_is_no_evidence() {
    for s in [0.5, 1.0, 2.0, 5.0, 10.0] {
        assert!(ln_bayes_factor(Votes { a: 0, b: 1 }, s).abs() < 1e-14);
        assert!(ln_bayes_factor(Votes::default(), s).abs() < 1e-14);
    }
}

#[test]
fn no_votes_have_no_factor_and_a_billion_have_one() {
    let of = |a, b| {
        let condition = ConditionData {
            votes: Votes { a, b },
            ..ConditionData::default()
        };
        cells(&condition, &Settings::default())
    };
    assert_eq!(of(0, 0), vec![Cell::Undefined(Undefined::NO_VOTES); 3]);
    for cells in [of(0, 1_000_000_000), of(1_000_000_000, 1_000_000_000)] {
        for cell in cells {
            match cell {
                Cell::Number(x) => assert!(x.is_finite()),
                Cell::Interval(i) => assert!(0.0 <= i.low && i.low <= i.high && i.high <= 1.0),
                other => panic!("{other:?}"),
            }
        }
    }
}

#[test]
fn the_words_are_jeffreys() {
    assert_eq!(category(-1e-17), "none either way");
    assert_eq!(category(0.49), "barely worth mentioning, for a preference");
    assert_eq!(category(0.5), "substantial for a preference");
    assert_eq!(category(-1.2), "strong for an even split");
    assert_eq!(category(1.5), "very strong for a preference");
    assert_eq!(category(3e8), "decisive for a preference");
    assert_eq!(factor_text(3_f64.log10()), "BF₁₀ = 3.00");
    assert_eq!(factor_text(-300.04), "BF₁₀ = 10^-300.0");
}

#[test]
fn the_section_tells_the_range_over_priors() {
    let condition = |id: &str, a, b| ConditionData {
        id: id.into(),
        votes: Votes { a, b },
        ..ConditionData::default()
    };
    let data = Dataset {
        conditions: vec![
            condition("even", 18, 18),
            condition("leaning", 11, 25),
            condition("clear", 2, 34),
            condition("silent", 0, 0),
        ],
        ..Dataset::default()
    };
    let section = section(&Context::of(&data, &Settings::default())).unwrap();
    assert_eq!(section.status, Status::Ok);
    assert!(
        section.findings[0].contains(
            "for a preference in 1 of 3 conditions, for an even split in 1, and for neither in 1"
        ),
        "{section:?}"
    );
    let table = &section.tables[0].table;
    for row in &table.rows[..3] {
        let number = |i: usize| match row[i] {
            Cell::Number(x) => x,
            ref other => panic!("{other:?}"),
        };
        assert!((1..=5).all(|i| number(6) <= number(i) && number(i) <= number(7)));
    }
    assert_eq!(table.rows[3][1], Cell::Undefined(Undefined::NO_VOTES));
}

proptest! {
    /// BF(k votes more) is BF times twice the posterior prediction of the next vote.
    #[test]
    fn is_the_product_of_predictions(a in 0_u32..2_000_000, b in 0_u32..2_000_000, s in 0.5..10.0_f64) {
        let here = ln_bayes_factor(Votes { a, b }, s);
        let next = ln_bayes_factor(Votes { a, b: b + 1 }, s);
        let predicted = 2.0 * (f64::from(b) + s) / (f64::from(a) + f64::from(b) + 2.0 * s);
        let allowed = 1e-13 * here.abs().max(100.0);
        prop_assert!((next - here - predicted.ln()).abs() < allowed, "{here} {next}");
        let turned = ln_bayes_factor(Votes { a: b, b: a }, s);
        prop_assert!((here - turned).abs() <= allowed);
    }
}
