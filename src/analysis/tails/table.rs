//! Every row of `tests/data/tails.csv` (60-digit arithmetic, `tests/data/tails.py`) against ours.

use super::*;

/// Allowed error of the logarithm: 1e-12 relative in the value, as long as the value is a double.
/// Below, the logarithm itself is what is printed and its own rounding counts: 1e-8 on log10 p is asked,
/// 1e-14 relative is kept.
fn allowed(ln: f64) -> f64 {
    if ln > -708.0 { 1e-12 } else { 1e-14 * ln.abs() }
}

/// The logarithm of one function of the table at its arguments.
fn ours(function: &str, arguments: &[&str]) -> f64 {
    let number = |i: usize| arguments[i].parse::<f64>().unwrap();
    let whole = |i: usize| arguments[i].parse::<u32>().unwrap();
    let clopper_pearson = || {
        let alpha = Alpha::try_from(number(2)).unwrap();
        clopper_pearson(whole(0), whole(1), alpha)
    };
    match function {
        "binomial_two_sided" => two_sided_even(whole(0), whole(1)).ln(),
        "binomial_upper" => Binomial::new(whole(1), number(2))
            .unwrap()
            .upper_tail(whole(0))
            .ln(),
        "clopper_pearson_low" => clopper_pearson().0.ln(),
        "clopper_pearson_high" => clopper_pearson().1.ln(),
        "normal_upper" => normal_upper(number(0)).ln(),
        "normal_quantile" => normal_quantile(number(0)).unwrap().ln(),
        "chi_square_upper" => chi_square_upper(number(0), whole(1)).ln(),
        "chi_square_lower" => chi_square_lower(number(0), whole(1)).ln(),
        "chi_square_quantile" => chi_square_quantile(number(0), whole(1)).unwrap().ln(),
        "gamma_upper" => gamma_upper(number(0), number(1)).ln(),
        "gamma_lower" => gamma_lower(number(0), number(1)).ln(),
        "beta_upper" => beta_upper(number(0), number(1), number(2)).ln(),
        "beta_lower" => beta_lower(number(0), number(1), number(2)).ln(),
        "beta_quantile" => beta_quantile(number(0), number(1), number(2)).unwrap().ln(),
        "ln_beta" => ln_beta(number(0), number(1)),
        "student_t_upper" => student_t_upper(number(0), number(1)).ln(),
        "student_t_quantile" => student_t_quantile(number(0), number(1)).unwrap().ln(),
        "f_upper" => f_upper(number(0), number(1), number(2)).ln(),
        "f_quantile" => f_quantile(number(0), number(1), number(2)).unwrap().ln(),
        other => panic!("unknown function {other}"),
    }
}

#[test]
fn every_value_of_the_table_holds() {
    let table = include_str!("../../../tests/data/tails.csv");
    let mut worst = std::collections::BTreeMap::<&str, (f64, &str)>::new();
    let mut rows = 0;
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let expected = cells[4].parse::<f64>().unwrap();
        let error = (ours(cells[0], &cells[1..4]) - expected).abs() / allowed(expected);
        let entry = worst.entry(cells[0]).or_insert((0.0, line));
        if error.is_nan() || error > entry.0 {
            *entry = (error, line);
        }
        rows += 1;
    }
    println!("{worst:#?}");
    assert!(rows > 3000, "{rows} rows");
    assert_eq!(worst.len(), 19, "{:?}", worst.keys());
    for (function, (error, line)) in worst {
        assert!(
            error <= 1.0,
            "{function}: {error} times the allowed error at {line}"
        );
    }
}
