//! The two pieces of Loader's saddle-point expansion of the binomial probability, which keeps
//! full precision where factorials and powers cancel: C. Loader (2000), "Fast and accurate
//! computation of binomial probabilities". Here for real arguments, with the logarithms of Γ and B that
//! follow from them.

use std::f64::consts::PI;

/// ln Γ(x + 1) − ln(√(2πx) (x/e)ˣ) for x > 0, the error of Stirling's formula; 0 for x = 0.
pub fn stirling_error(x: f64) -> f64 {
    /// x = 1 … 15: the common small counts, without the steps below.
    #[allow(clippy::excessive_precision)]
    const SMALL: [f64; 15] = [
        0.081_061_466_795_327_258_22,
        0.041_340_695_955_409_294_09,
        0.027_677_925_684_998_339_15,
        0.020_790_672_103_765_093_11,
        0.016_644_691_189_821_192_16,
        0.013_876_128_823_070_747_998,
        0.011_896_709_945_891_770_09,
        0.010_411_265_261_972_096_497,
        0.009_255_462_182_712_732_917_7,
        0.008_330_563_433_362_871_256_5,
        0.007_573_675_487_951_840_795,
        0.006_942_840_107_209_529_865_7,
        0.006_408_994_188_004_207_068_4,
        0.005_951_370_112_758_847_735_6,
        0.005_554_733_551_962_801_371,
    ];
    if x <= 0.0 {
        return 0.0;
    }
    if x <= 15.0 && x.fract() == 0.0 {
        return SMALL[x as usize - 1];
    }
    let (mut x, mut below) = (x, 0.0);
    while x < 16.0 {
        below += stirling_step(x);
        x += 1.0;
    }
    below + stirling_series(x)
}

/// What [`stirling_error`] falls by from x to x + 1: (x + ½) ln(1 + 1/x) − 1.
fn stirling_step(x: f64) -> f64 {
    if x < 0.5 {
        return (x + 0.5) * ((1.0 + x).ln() - x.ln()) - 1.0;
    }
    // (2x + 1) atanh(1/(2x + 1)) − 1, whose series has positive terms only.
    let square = (2.0 * x + 1.0).powi(-2);
    let (mut power, mut odd, mut sum) = (square, 3.0, 0.0_f64);
    while power > sum * 1e-17 {
        sum += power / odd;
        power *= square;
        odd += 2.0;
    }
    sum
}

/// DLMF 5.11.1: Σ B₂ₖ / (2k (2k−1) x²ᵏ⁻¹), k = 1 … 6; 16 digits from x = 16 on.
fn stirling_series(x: f64) -> f64 {
    let inverse_square = 1.0 / x / x;
    let series = [
        1.0 / 12.0,
        -1.0 / 360.0,
        1.0 / 1260.0,
        -1.0 / 1680.0,
        1.0 / 1188.0,
        -691.0 / 360_360.0,
    ];
    series
        .iter()
        .rev()
        .fold(0.0, |sum, term| sum * inverse_square + term)
        / x
}

/// ln Γ(x) for x > 0. +∞ where x is not positive, as the integral is; NaN never.
#[must_use]
pub fn ln_gamma(x: f64) -> f64 {
    if x > 0.0 {
        libm::lgamma(x)
    } else {
        f64::INFINITY
    }
}

/// ln B(a, b) = ln Γ(a) + ln Γ(b) − ln Γ(a + b) for a, b > 0, by Stirling's formula with its error, so that
/// nothing large cancels. +∞ where a or b is not positive, as the integral is; NaN never.
#[must_use]
pub fn ln_beta(a: f64, b: f64) -> f64 {
    // The negation also catches NaN.
    if !(a > 0.0 && b > 0.0) {
        return f64::INFINITY;
    }
    let (a, b) = (a.min(b), a.max(b));
    if b == f64::INFINITY {
        return f64::NEG_INFINITY;
    }
    let correction = stirling_error(a) + stirling_error(b) - stirling_error(a + b);
    // (a + b)/b = 1 + a/b: no sum that could overflow.
    let ratio = (a / b).ln_1p();
    correction - b * ratio + a * (a.ln() - b.ln() - ratio) + 0.5 * (2.0 * PI).ln()
        - 0.5 * (a.ln() - ratio)
}

/// x ln(x/m) + m − x, for x, m > 0 and `difference` = x − m.
///
/// The difference is an argument because the caller can often form it with less rounding than
/// `x - m` has.
pub fn deviance(x: f64, m: f64, difference: f64) -> f64 {
    let v = difference / (x + m);
    if v.abs() >= 0.5 {
        return x * (x / m).ln() - difference;
    }
    // x ln(x/m) = 2x atanh(v), of which 2xv − (x − m) = (x − m) v is taken out by hand.
    let v_squared = v * v;
    let mut power = v * v_squared;
    let mut odd = 3.0;
    let mut sum = 0.0_f64;
    while power.abs() > sum.abs() * 1e-18 {
        sum += power / odd;
        power *= v_squared;
        odd += 2.0;
    }
    difference * v + 2.0 * x * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// n! for n = 16 … 20 still fits 64 bits, so the series can be held to the factorial itself.
    #[test]
    fn stirling_errors_give_the_factorials() {
        let mut factorial = 1.0_f64;
        for n in 1..=20_u32 {
            factorial *= f64::from(n);
            let n_f = f64::from(n);
            let stirling = (2.0 * std::f64::consts::PI * n_f).sqrt()
                * (n_f / std::f64::consts::E).powi(n as i32);
            let ours = stirling * stirling_error(n_f).exp();
            assert!(
                (ours / factorial - 1.0).abs() < 2e-14,
                "{n}: {ours} {factorial}"
            );
        }
    }

    #[test]
    fn deviance_is_smooth_where_the_formula_changes() {
        // v = 0.5 at x = 3m.
        let (m, d) = (100.0_f64, 1e-9);
        let below = deviance(300.0 - d, m, 200.0 - d);
        let above = deviance(300.0 + d, m, 200.0 + d);
        assert!((below / above - 1.0).abs() < 1e-10);
        assert!((above / (300.0 * 3.0_f64.ln() - 200.0) - 1.0).abs() < 1e-10);
        assert_eq!(deviance(5.0, 5.0, 0.0), 0.0);
    }
}
