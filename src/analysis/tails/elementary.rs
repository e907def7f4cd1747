//! Elementary functions less their linear part, without cancellation.

/// ln(1 + w) − w for w > −1.
pub fn ln_1p_minus(w: f64) -> f64 {
    if !(-0.5..=1.0).contains(&w) {
        return w.ln_1p() - w;
    }
    // ln(1 + w) = 2 atanh(r), and w − 2r = w r.
    let r = w / (2.0 + w);
    let square = r * r;
    let (mut power, mut odd, mut sum) = (square, 3.0, 0.0_f64);
    while power > sum * 1e-17 {
        sum += power / odd;
        power *= square;
        odd += 2.0;
    }
    r * (2.0 * sum - w)
}

/// e^u − 1 − u.
pub fn exp_minus(u: f64) -> f64 {
    if u.abs() > 0.5 {
        return u.exp_m1() - u;
    }
    let (mut term, mut k, mut sum) = (0.5 * u * u, 2.0, 0.0_f64);
    while term.abs() > sum.abs() * 1e-17 {
        sum += term;
        k += 1.0;
        term *= u / k;
    }
    sum
}
