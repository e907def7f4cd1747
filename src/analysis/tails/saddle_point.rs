//! The two pieces of Loader's saddle-point expansion of the binomial probability, which keeps
//! full precision where factorials and powers cancel: C. Loader (2000), "Fast and accurate
//! computation of binomial probabilities".

/// ln(n!) − ln(√(2πn) (n/e)ⁿ), the error of Stirling's formula; 0 for n = 0.
pub fn stirling_error(n: u32) -> f64 {
    /// n = 1 … 15, where the series below is not yet good to 16 digits.
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
    match n {
        0 => 0.0,
        1..=15 => SMALL[n as usize - 1],
        _ => {
            let n = f64::from(n);
            let inverse_square = 1.0 / (n * n);
            // Bernoulli numbers: B₂ₖ / (2k (2k−1) n²ᵏ⁻¹), k = 1 … 6.
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
                / n
        }
    }
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
            let ours = stirling * stirling_error(n).exp();
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
