use super::*;
use crate::analysis::dataset::ConditionData;
use crate::analysis::settings::Settings;
use proptest::prelude::*;

fn stratum(cells: [u32; 4]) -> Stratum {
    let [ab_b, ab_a, ba_b, ba_a] = cells.map(f64::from);
    Stratum {
        ab_b,
        ab_a,
        ba_b,
        ba_a,
    }
}

fn study(strata: &[[u32; 4]]) -> Dataset {
    Dataset {
        conditions: (strata.iter().enumerate())
            .map(|(i, [ab_b, ab_a, ba_b, ba_a])| {
                let orders = OrderCounts {
                    ab_first: *ab_a,
                    ab_second: *ab_b,
                    ba_first: *ba_b,
                    ba_second: *ba_a,
                    missing: 0,
                };
                ConditionData {
                    id: format!("c{i}"),
                    votes: orders.votes(),
                    orders: Some(orders),
                    ..ConditionData::default()
                }
            })
            .collect(),
        ..Dataset::default()
    }
}

fn run(strata: &[[u32; 4]]) -> Section {
    section(&Context::of(&study(strata), &Settings::default())).unwrap()
}

/// statsmodels' StratifiedTable and R's mantelhaen.test: `tests/data/within.py`.
#[test]
fn every_value_of_the_table_holds() {
    let mut rows = 0;
    for line in include_str!("../../../tests/data/within.csv").lines() {
        let Some(cells) = line.strip_prefix("order,") else {
            continue;
        };
        let (strata, numbers) = cells.split_once(',').unwrap();
        let strata: Vec<[u32; 4]> = (strata.split('|'))
            .map(|cells| {
                let cells: Vec<u32> = cells.split(' ').map(|c| c.parse().unwrap()).collect();
                cells.try_into().unwrap()
            })
            .collect();
        let expected: Vec<f64> = numbers.split(',').map(|c| c.parse().unwrap()).collect();
        let mut row = run(&strata).tables[0].table.rows[0].clone();
        // The number of strata, and the one degree of freedom.
        row.drain(0..1);
        row.remove(1);
        let ours: Vec<f64> = (row.iter())
            .flat_map(|cell| match cell {
                Cell::Number(x) => vec![*x],
                Cell::Probability(p) => vec![p.value()],
                Cell::Interval(i) => vec![i.low, i.high],
                Cell::Count(n) => vec![f64::from(*n)],
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(ours.len(), expected.len());
        for (ours, expected) in ours.iter().zip(&expected) {
            assert!(
                (ours - expected).abs() <= 1e-10 * expected,
                "{line}: {ours} {expected}"
            );
        }
        rows += 1;
    }
    assert!(rows >= 5, "{rows} rows");
}

#[test]
fn strata_that_cannot_tell_change_nothing_and_are_named() {
    let telling = [[9, 5, 4, 8], [7, 6, 3, 9]];
    let with_silent = [
        telling[0],
        telling[1],
        [5, 4, 0, 0],
        [3, 0, 6, 0],
        [1, 0, 0, 0],
    ];
    let (plain, silent) = (run(&telling), run(&with_silent));
    assert_eq!(plain.tables[0].table.rows, silent.tables[0].table.rows);
    let last = silent.findings.last().unwrap();
    assert!(
        last.starts_with("3 conditions were shown") && last.ends_with("c2, c3, c4."),
        "{last}"
    );
}

#[test]
fn degenerate_strata_have_a_status_and_no_number() {
    let one_order = run(&[[5, 4, 0, 0]]);
    assert_eq!(one_order.status, Status::Degenerate);
    // Always the second image: the test is there, the ratio is not.
    let second = run(&[[5, 0, 0, 5], [6, 0, 0, 4]]);
    assert_eq!(second.status, Status::NoFiniteEstimate);
    let row = &second.tables[0].table.rows[0];
    assert!(matches!(row[1], Cell::Number(x) if x > 10.0));
    assert_eq!(row[4], Cell::Undefined(NO_FINITE_RATIO));
    assert_eq!(row[6], Cell::Undefined(NO_FINITE_RATIO));
    let one = run(&[[5, 2, 3, 5]]);
    assert_eq!(one.status, Status::Ok);
    assert_eq!(one.tables[0].table.rows[0][6], Cell::Undefined(ONE_STRATUM));
    assert!(section(&Context::of(&study(&[[0; 4]]), &Settings::default())).is_none());
}

proptest! {
    /// Turning round the base order of every condition turns the tables, not the result.
    #[test]
    fn base_orders_are_a_convention(cells in prop::collection::vec(prop::array::uniform4(0_u32..40), 1..6)) {
        let strata: Vec<Stratum> = cells.iter().copied().map(stratum).collect();
        let turned: Vec<Stratum> = (strata.iter())
            .map(|s| Stratum { ab_b: s.ba_a, ab_a: s.ba_b, ba_b: s.ab_a, ba_a: s.ab_b })
            .collect();
        let close = |x: f64, y: f64| (x - y).abs() <= 1e-9 * x.abs().max(1.0);
        match (chi_square(&strata), chi_square(&turned)) {
            (Ok(x), Ok(y)) => prop_assert!(close(x, y) && x.is_finite()),
            (x, y) => prop_assert_eq!(x, y),
        }
        match (common_odds_ratio(&strata), common_odds_ratio(&turned)) {
            (Ok((x, v)), Ok((y, w))) => prop_assert!(close(x, y) && close(v, w) && v.is_finite()),
            (x, y) => prop_assert_eq!(x, y),
        }
        match (homogeneity(&strata), homogeneity(&turned)) {
            (Ok((x, d)), Ok((y, e))) => prop_assert!(close(x, y) && d == e && x.is_finite()),
            (x, y) => prop_assert_eq!(x, y),
        }
    }

    /// The fitted table has the common odds ratio.
    #[test]
    fn expected_tables_have_the_ratio(cells in prop::array::uniform4(1_u32..1000), ln_ratio in -8.0..8.0_f64) {
        let (table, ratio) = (stratum(cells), ln_ratio.exp());
        let (x, v) = table.expected(ratio);
        let (row, column) = table.margins();
        let fitted = x * (table.n() - row - column + x) / ((row - x) * (column - x));
        prop_assert!(x > 0.0 && x < row.min(column) && v > 0.0);
        prop_assert!((fitted / ratio - 1.0).abs() < 1e-6, "{fitted} {ratio}");
    }
}
