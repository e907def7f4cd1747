//! The regularised incomplete gamma functions P(a, x) and Q(a, x) and the inverse, by their logarithms.
//!
//! In s = ln x the density is x^a e^−x / Γ(a): log-concave, its mode at x = a. It is the limit of the beta's, and
//! computed in the same way.

use std::f64::consts::PI;

use super::Probability;
use super::elementary::exp_minus;
use super::newton::{self, Tail, normal_start};
use super::saddle_point::{deviance, ln_gamma, stirling_error};
use super::tail_integral::{Exponent, tail_integral};

/// Up to this a the power series has some 200 terms at most.
const SERIES_SHAPE: f64 = 400.0;

/// Shapes are held in here; outside, the distribution is one point to all digits.
const SHAPES: (f64, f64) = (1e-150, 1e150);

/// P(a, x), the probability that a gamma variable of shape `a` and scale 1 is at most x; 1 for arguments
/// without a meaning (NaN, a not positive).
#[must_use]
pub fn gamma_lower(x: f64, a: f64) -> Probability {
    match Gamma::new(a) {
        Some(gamma) if !x.is_nan() => Probability::from_ln(gamma.ln_lower(x, gamma.a - x)),
        _ => Probability::ONE,
    }
}

/// Q(a, x) = 1 − P(a, x), the probability of at least x; 1 for arguments without a meaning.
#[must_use]
pub fn gamma_upper(x: f64, a: f64) -> Probability {
    match Gamma::new(a) {
        Some(gamma) if !x.is_nan() => Probability::from_ln(gamma.ln_upper(x, gamma.a - x)),
        _ => Probability::ONE,
    }
}

/// The shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gamma {
    a: f64,
}

impl Gamma {
    /// `None` unless the shape is positive.
    pub fn new(a: f64) -> Option<Self> {
        (a > 0.0).then(|| Self {
            a: a.clamp(SHAPES.0, SHAPES.1),
        })
    }

    /// ln P(a, x); `excess` = a − x, which the caller may know better than the subtraction.
    pub fn ln_lower(&self, x: f64, excess: f64) -> f64 {
        self.lower(x, excess).ln
    }

    /// ln Q(a, x).
    pub fn ln_upper(&self, x: f64, excess: f64) -> f64 {
        self.upper(x, excess).ln
    }

    /// ln P(a, x) and its slopes along ln x.
    fn lower(&self, x: f64, excess: f64) -> Tail {
        if x <= 0.0 || x == f64::INFINITY {
            return Tail {
                ln: if x <= 0.0 { f64::NEG_INFINITY } else { 0.0 },
                slope: 0.0,
                density_slope: excess,
            };
        }
        let ln_density = self.ln_density(x, excess);
        if excess >= 0.0 {
            Tail::short(ln_density, self.lower_per_density(x, excess), excess)
        } else {
            Tail::long(ln_density, upper_per_density(x, excess), excess)
        }
    }

    /// ln Q(a, x) and its slopes along −ln x.
    fn upper(&self, x: f64, excess: f64) -> Tail {
        if x <= 0.0 || x == f64::INFINITY {
            return Tail {
                ln: if x <= 0.0 { 0.0 } else { f64::NEG_INFINITY },
                slope: 0.0,
                density_slope: -excess,
            };
        }
        let ln_density = self.ln_density(x, excess);
        if excess < 0.0 {
            Tail::short(ln_density, upper_per_density(x, excess), -excess)
        } else {
            Tail::long(ln_density, self.lower_per_density(x, excess), -excess)
        }
    }

    /// P(a, x) over the density at x ≤ a.
    fn lower_per_density(&self, x: f64, excess: f64) -> f64 {
        if self.a <= SERIES_SHAPE {
            return self.series(x) / self.a;
        }
        let exponent = GammaExponent {
            x,
            excess,
            way: -1.0,
        };
        tail_integral(&exponent, f64::INFINITY).0
    }

    /// ln of x^a e^−x / Γ(a).
    fn ln_density(&self, x: f64, excess: f64) -> f64 {
        let a = self.a;
        if x < a * 1e-100 {
            return a * x.ln() - x - ln_gamma(a);
        }
        -deviance(a, x, excess) - stirling_error(a) + 0.5 * (a.ln() - (2.0 * PI).ln())
    }

    /// Σ xᵏ / (a + 1)ₖ = Γ(a + 1) P(a, x) / (x^a e^−x), DLMF 8.7.1: all terms are positive.
    fn series(&self, x: f64) -> f64 {
        let (mut term, mut sum, mut below) = (1.0, 1.0, self.a + 1.0);
        for _ in 0..10_000 {
            term *= x / below;
            sum += term;
            if term < sum * 1e-18 {
                break;
            }
            below += 1.0;
        }
        sum
    }

    /// The x with ln Q(a, x) = `ln_tail`, which is at most about ln ½.
    pub fn upper_quantile(&self, ln_tail: f64) -> f64 {
        let a = self.a;
        // Wilson and Hilferty's cube.
        let root = 1.0 - 1.0 / (9.0 * a) + normal_start(ln_tail) / (3.0 * a.sqrt());
        let start = (a * root.max(0.1).powi(3)).ln();
        let minus_ln_x = newton::solve(ln_tail, -start, |minus_s| {
            let x = (-minus_s).exp();
            self.upper(x, a - x)
        });
        (-minus_ln_x).exp()
    }

    /// The x with ln P(a, x) = `ln_tail`, which is at most about ln ½.
    pub fn lower_quantile(&self, ln_tail: f64) -> f64 {
        let a = self.a;
        // The normal's quantile at the mode's width, or the power that the far tail is like, x^a / Γ(a + 1).
        let bell = a.ln() - normal_start(ln_tail) / a.sqrt();
        let power = (ln_tail + ln_gamma(a + 1.0)) / a;
        newton::solve(ln_tail, bell.max(power), |s| {
            let x = s.exp();
            self.lower(x, a - x)
        })
        .exp()
    }
}

/// Q(a, x) over the density at x ≥ a.
fn upper_per_density(x: f64, excess: f64) -> f64 {
    let exponent = GammaExponent {
        x,
        excess,
        way: 1.0,
    };
    tail_integral(&exponent, f64::INFINITY).0
}

/// By how much the log density falls from x on u further out, down (way −1) or up (+1).
struct GammaExponent {
    x: f64,
    excess: f64,
    way: f64,
}

impl Exponent for GammaExponent {
    fn at(&self, u: f64) -> f64 {
        let Self { x, excess, way } = *self;
        -way * excess * u + x * exp_minus(way * u)
    }

    fn slopes(&self, u: f64) -> (f64, f64) {
        let Self { x, excess, way } = *self;
        let grown = (way * u).exp();
        (way * (x * (grown - 1.0) - excess), x * grown)
    }
}
