//! Every row of `tests/data/tails.csv` (60-digit arithmetic, `tests/data/tails.py`) against ours.

use super::*;

/// Allowed error of the logarithm: 1e-12 relative in the value, as long as the value is a double.
/// Below, the logarithm itself is what is printed and its own rounding counts: 1e-8 on log10 p is asked,
/// 1e-14 relative is kept.
fn allowed(ln: f64) -> f64 {
    if ln > -708.0 { 1e-12 } else { 1e-14 * ln.abs() }
}

#[test]
fn every_value_of_the_table_holds() {
    let table = include_str!("../../../tests/data/tails.csv");
    let mut worst = std::collections::BTreeMap::<&str, (f64, &str)>::new();
    let mut rows = 0;
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        let whole = |i: usize| cells[i].parse::<u32>().unwrap();
        let expected = number(4);
        let ours = match cells[0] {
            "binomial_two_sided" => two_sided_even(whole(1), whole(2)).ln(),
            "binomial_upper" => Binomial::new(whole(2), number(3))
                .unwrap()
                .upper_tail(whole(1))
                .ln(),
            "clopper_pearson_low" => {
                let alpha = Alpha::try_from(number(3)).unwrap();
                clopper_pearson(whole(1), whole(2), alpha).0.ln()
            }
            "normal_upper" => normal_upper(number(1)).ln(),
            "normal_quantile" => normal_quantile(number(1)).unwrap().ln(),
            "chi_square_upper" => chi_square_upper(number(1), whole(2)).ln(),
            other => panic!("unknown function {other}"),
        };
        let error = (ours - expected).abs() / allowed(expected);
        let entry = worst.entry(cells[0]).or_insert((0.0, line));
        if error.is_nan() || error > entry.0 {
            *entry = (error, line);
        }
        rows += 1;
    }
    println!("{worst:#?}");
    assert!(rows > 600, "{rows} rows");
    for (function, (error, line)) in worst {
        assert!(
            error <= 1.0,
            "{function}: {error} times the allowed error at {line}"
        );
    }
}
