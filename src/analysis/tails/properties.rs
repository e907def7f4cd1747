//! What must hold whatever the arguments are, and relations between the distributions.

use proptest::num::f64::ANY;
use proptest::prelude::*;

use super::*;

/// Any double at all, and the values that code forgets.
fn hostile() -> impl Strategy<Value = f64> {
    let special = prop::sample::select(vec![
        0.0,
        -0.0,
        5e-324,
        f64::MIN_POSITIVE,
        1e-290,
        1e-17,
        0.5,
        1.0 - f64::EPSILON / 2.0,
        1.0,
        1.0 + f64::EPSILON,
        1e17,
        1e150,
        1e200,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ]);
    prop_oneof![1 => special, 1 => ANY, 2 => (-300.0..300.0_f64).prop_map(|e| 10_f64.powf(e)), 1 => 0.0..=1.0_f64]
}

/// A positive number between powers of ten.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|e| 10_f64.powf(e))
}

/// Shapes that analyses meet.
fn shape() -> impl Strategy<Value = f64> {
    prop_oneof![
        decades(-3.0, 7.0),
        (1..10_000_000_u32).prop_map(|k| 0.5 * f64::from(k))
    ]
}

fn close(left: f64, right: f64, tolerance: f64) -> Result<(), TestCaseError> {
    let same = left == right || (left / right - 1.0).abs() <= tolerance;
    prop_assert!(same, "{left:e} {right:e}");
    Ok(())
}

/// Logarithms of one value that went two ways: 1e-12 of the value, 1e-13 of a large logarithm.
fn close_ln(left: f64, right: f64) -> Result<(), TestCaseError> {
    let allowed = 1e-12_f64.max(1e-13 * left.abs());
    let same = left == right || (left - right).abs() <= allowed;
    prop_assert!(same, "{left:e} {right:e}");
    Ok(())
}

/// left ≤ right, beyond rounding.
fn not_above(left: Probability, right: Probability) -> Result<(), TestCaseError> {
    let allowed = 1e-12_f64.max(1e-13 * right.ln().abs());
    prop_assert!(
        left.ln() <= right.ln() + allowed || left == right,
        "{left:?} {right:?}"
    );
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_000))]

    #[test]
    fn whatever_the_arguments_a_tail_is_a_probability(
        x in hostile(), a in hostile(), b in hostile(), df in any::<u32>(),
    ) {
        for tail in [
            beta_lower(x, a, b), beta_upper(x, a, b), student_t_upper(x, a), student_t_upper(-x, a),
            f_upper(x, a, b), gamma_lower(x, a), gamma_upper(x, a), normal_upper(x),
            chi_square_lower(x, df), chi_square_upper(x, df),
        ] {
            prop_assert!(tail.ln() <= 0.0, "{tail:?}");
            prop_assert!((0.0..=1.0).contains(&tail.value()));
        }
        prop_assert!(!ln_beta(a, b).is_nan() && !ln_gamma(a).is_nan());
    }

    #[test]
    fn whatever_the_arguments_a_quantile_is_in_its_range(
        tail in hostile(), a in hostile(), b in hostile(), df in any::<u32>(),
    ) {
        let inside = |x: Option<f64>| x.is_none_or(|x| x.is_finite() && x >= 0.0);
        let quantiles = [
            beta_quantile(tail, a, b).filter(|x| !(0.0..=1.0).contains(x)).map(|_| f64::NAN),
            student_t_quantile(tail, a), f_quantile(tail, a, b), chi_square_quantile(tail, df),
            normal_quantile(tail),
        ];
        for quantile in quantiles {
            prop_assert!(inside(quantile), "{quantile:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn tails_sum_to_one(x in 0.0..=1.0_f64, a in shape(), b in shape(), factor in decades(-2.0, 2.0)) {
        let whole = beta_lower(x, a, b).value() + beta_upper(x, a, b).value();
        prop_assert!((whole - 1.0).abs() < 1e-13);
        let near_mode = a / (a + b) + (x - 0.5) / (a + b).sqrt();
        let whole = beta_lower(near_mode, a, b).value() + beta_upper(near_mode, a, b).value();
        prop_assert!((whole - 1.0).abs() < 1e-13);
        let whole = gamma_lower(a * factor, a).value() + gamma_upper(a * factor, a).value();
        prop_assert!((whole - 1.0).abs() < 1e-13);
    }

    #[test]
    fn the_beta_is_symmetric(x in 0.5..=1.0_f64, a in shape(), b in shape()) {
        // 1 − x is exact here.
        close_ln(beta_lower(x, a, b).ln(), beta_upper(1.0 - x, b, a).ln())?;
        close_ln(beta_upper(x, a, b).ln(), beta_lower(1.0 - x, b, a).ln())?;
    }

    #[test]
    fn tails_fall(x in 0.0..1.0_f64, y in 0.0..1.0_f64, a in shape(), b in shape(), scale in decades(-4.0, 3.0)) {
        let (low, high) = (x.min(y), x.max(y));
        not_above(beta_upper(high, a, b), beta_upper(low, a, b))?;
        not_above(beta_lower(low, a, b), beta_lower(high, a, b))?;
        not_above(student_t_upper(high * scale, a), student_t_upper(low * scale, a))?;
        not_above(f_upper(high * scale, a, b), f_upper(low * scale, a, b))?;
        let (low, high) = (low * scale * a, high * scale * a);
        not_above(gamma_upper(high, a), gamma_upper(low, a))?;
        not_above(gamma_lower(low, a), gamma_lower(high, a))?;
    }

    #[test]
    fn one_degree_of_freedom_is_cauchys(t in decades(-10.0, 150.0)) {
        let exact = (1.0 / t).atan() / std::f64::consts::PI;
        close(student_t_upper(t, 1.0).value(), exact, 1e-13)?;
        close(student_t_upper(-t, 1.0).value(), 1.0 - exact, 1e-13)?;
        // The other closed form: ½ − t / (2 √(2 + t²)) = 1 / (√(2 + t²) (√(2 + t²) + t)).
        let root = 2_f64.sqrt().hypot(t);
        close(student_t_upper(t, 2.0).ln(), -root.ln() - (root + t).ln(), 1e-12)?;
    }

    #[test]
    fn squares_of_t_are_f(t in decades(-3.0, 2.0), df in shape()) {
        close_ln(f_upper(t * t, 1.0, df).ln(), student_t_upper(t, df).times(2.0).ln())?;
    }

    #[test]
    fn f_turned_over_is_f(f in decades(-3.0, 3.0), d1 in shape(), d2 in shape()) {
        let whole = f_upper(f, d1, d2).value() + f_upper(1.0 / f, d2, d1).value();
        // 1/f is rounded, and near the middle of 10⁷ degrees that shows.
        prop_assert!((whole - 1.0).abs() < 1e-12, "{whole}");
    }

    #[test]
    fn f_with_no_end_of_degrees_is_chi_square(x in decades(-2.0, 2.0), df in 1_u32..1_000_000) {
        let degrees = f64::from(df);
        close_ln(f_upper(x / degrees, degrees, f64::INFINITY).ln(), f_upper(x / degrees, degrees, 1e25).ln())?;
    }

    #[test]
    fn t_with_no_end_of_degrees_is_normal(t in -30.0..30.0_f64) {
        close_ln(student_t_upper(t, 1e19).ln(), normal_upper(t).ln())?;
    }

    #[test]
    fn one_degree_of_chi_square_is_a_gamma(x in decades(-12.0, 3.0)) {
        close_ln(chi_square_upper(x, 1).ln(), gamma_upper(0.5 * x, 0.5).ln())?;
    }

    #[test]
    fn binomial_tails_are_beta_tails(n in 1_u32..10_000_000, at in 0.0..1.0_f64, p in 0.0..=1.0_f64) {
        let k = 1 + (f64::from(n - 1) * at) as u32;
        let (a, b) = (f64::from(k), f64::from(n - k) + 1.0);
        close_ln(Binomial::new(n, p).unwrap().upper_tail(k).ln(), beta_lower(p, a, b).ln())?;
        let near = (at + 9.0 * (p - 0.5) * (0.25 / f64::from(n)).sqrt()).clamp(0.0, 1.0);
        close_ln(Binomial::new(n, near).unwrap().upper_tail(k).ln(), beta_lower(near, a, b).ln())?;
    }

    #[test]
    fn quantiles_undo_tails(ln_tail in -690.0..-0.694_f64, a in shape(), b in shape(), df in 1_u32..10_000_000) {
        let tail = ln_tail.exp();
        // A quantile's own rounding moves the tail by its logarithm's slope, which a tail near its end or with large
        // shapes has much of: what is left of 12 digits.
        let allowed = 1e-12 * (1.0 + (a + b).sqrt() * -ln_tail * 1e-2);
        if let Some(t) = student_t_quantile(tail, a) {
            prop_assert!((student_t_upper(t, a).ln() - ln_tail).abs() < 1e-12 * (1.0 - ln_tail), "t");
        }
        if let Some(f) = f_quantile(tail, 2.0 * b, 2.0 * a) {
            prop_assert!((f_upper(f, 2.0 * b, 2.0 * a).ln() - ln_tail).abs() < allowed, "f");
        }
        let x = chi_square_quantile(tail, df).unwrap();
        let allowed_here = 1e-12 * (1.0 + f64::from(df).sqrt() * -ln_tail * 1e-2);
        prop_assert!((chi_square_upper(x, df).ln() - ln_tail).abs() < allowed_here, "chi-square");
        let x = beta_quantile(tail, a, b).unwrap();
        if x > f64::MIN_POSITIVE && x < 0.5 {
            prop_assert!((beta_lower(x, a, b).ln() - ln_tail).abs() < allowed, "beta");
        }
    }
}

#[test]
fn critical_values_are_the_printed_ones() {
    // Any textbook's table, two-sided 5 %.
    for (df, printed) in [(1.0, 12.706), (5.0, 2.571), (35.0, 2.030), (120.0, 1.980)] {
        let t = student_t_critical(Alpha::FIVE_PERCENT, df).unwrap();
        assert!((t - printed).abs() < 5e-4, "{df}: {t}");
    }
    assert_eq!(
        student_t_critical(Alpha::FIVE_PERCENT, f64::INFINITY),
        Some(normal_critical(Alpha::FIVE_PERCENT))
    );
    assert_eq!(student_t_critical(Alpha::FIVE_PERCENT, 0.0), None);
    assert!((chi_square_quantile(0.05, 1).unwrap() - 3.841_459).abs() < 5e-7);
    assert!((f_quantile(0.05, 6.0, 210.0).unwrap() - 2.142).abs() < 5e-4);
}

#[test]
fn beta_functions_of_whole_numbers() {
    assert!((ln_beta(1.0, 1.0)).abs() < 1e-15);
    assert!((ln_beta(3.0, 4.0) + 60_f64.ln()).abs() < 1e-15 * 60.0);
    assert!((ln_beta(0.5, 0.5) - std::f64::consts::PI.ln()).abs() < 1e-15);
    assert_eq!(ln_beta(0.0, 1.0), f64::INFINITY);
    assert_eq!(ln_gamma(1.0), 0.0);
}
