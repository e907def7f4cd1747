//! ∫ e^−E(u) du from 0 on, for a convex E with E(0) = 0 that does not fall: a tail in units of the
//! density at its beginning.

/// How the logarithm of a density falls.
pub trait Exponent {
    /// E(u), u ≥ 0.
    fn at(&self, u: f64) -> f64;
    /// E′(u) and E″(u); a few digits are enough.
    fn slopes(&self, u: f64) -> (f64, f64);
}

/// E grows by about this much over a panel: 16 nodes then give 17 digits of an exponential and of a
/// half bell.
const FALL: f64 = 8.0;

/// No panel is longer: the densities here have their nearest singularities π from the real line.
const LONGEST: f64 = 2.0;

/// Positive nodes of the 16-point Gauss–Legendre rule on [−1, 1], and their weights.
#[allow(clippy::excessive_precision)] // as tabulated, to more digits than a double has
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_440_185, 0.189_450_610_455_068_496_29),
    (0.281_603_550_779_258_913_23, 0.182_603_415_044_923_588_87),
    (0.458_016_777_657_227_386_34, 0.169_156_519_395_002_538_19),
    (0.617_876_244_402_643_748_45, 0.149_595_988_816_576_732_08),
    (0.755_404_408_355_003_033_9, 0.124_628_971_255_533_872_05),
    (0.865_631_202_387_831_743_88, 0.095_158_511_682_492_784_81),
    (0.944_575_023_073_232_576_08, 0.062_253_523_938_647_892_863),
    (0.989_400_934_991_649_932_6, 0.027_152_459_411_754_094_852),
];

/// The integral up to `end` at most, and e^−E(end), which is 0 if the integral stopped before because nothing
/// more counts. All terms are positive.
pub fn tail_integral(exponent: &impl Exponent, end: f64) -> (f64, f64) {
    let (mut from, mut sum) = (0.0_f64, 0.0_f64);
    // Five or six panels; 500 would cover every double.
    for _ in 0..500 {
        let (slope, curvature) = exponent.slopes(from);
        let slope = slope.max(0.0);
        // slope h + curvature h²/2 = FALL.
        let width = 2.0 * FALL / (slope + slope.hypot((2.0 * FALL * curvature).sqrt()));
        let width = width.min(LONGEST).min(end - from);
        let half = 0.5 * width;
        let middle = from + half;
        let panel: f64 = NODES
            .iter()
            .map(|&(node, weight)| {
                let left = (-exponent.at(middle - half * node)).exp();
                let right = (-exponent.at(middle + half * node)).exp();
                weight * (left + right)
            })
            .sum();
        sum += half * panel;
        from += width;
        if from >= end {
            return (sum, (-exponent.at(end)).exp());
        }
        if half * panel < sum * 1e-17 {
            break;
        }
    }
    (sum, 0.0)
}
