//! The notes' model as it is printed. It is here to be compared with: its direct term exceeds
//! 1 between α = 0.949253 and 1, and there a pole crosses the unit square of α and ρ.

use num_traits::Float;

use super::{Model, Openness, number as n};

/// The fit's factor (the notes' eq. 11).
pub(super) const A: f64 = 27.576_937_094_210_385;
/// The fit's exponent.
pub(super) const B: f64 = 3.336_439_200_342_380_4;

/// F₀, the notes' eq. 7, at an openness of 0 to 1: 0 to 1.00614.
pub fn direct<F: Float>(openness: F) -> F {
    openness * (F::one() + (F::one() - openness).powf(n(0.75)) / n(2.0))
}

/// F₁, the notes' eq. 11, at an openness of 0 to 1.
pub fn first_bounce<F: Float>(openness: F) -> F {
    let closed = (F::one() - openness).powf(n(1.5));
    n::<F>(A) * openness * closed * (-n::<F>(B) * openness.powf(n(0.25))).exp()
}

/// The notes' eq. 9 and 12.
fn as_printed<F: Float>(openness: F, albedo: F) -> F {
    let (direct, bounced) = (direct(openness), first_bounce(openness));
    let tau = F::one() - bounced / (F::one() - direct);
    direct + albedo * bounced / (F::one() - albedo * tau)
}

/// F₀ and F₁ in WGSL.
pub(super) fn terms_wgsl() -> String {
    format!(
        "fn published_direct(a: f32) -> f32 {{ return a * (1.0 + pow(1.0 - a, 0.75) / 2.0); }}
fn published_bounced(a: f32) -> f32 {{ return {A:?} * a * pow(1.0 - a, 1.5) * exp(-{B:?} * pow(a, 0.25)); }}
"
    )
}

/// As printed.
pub static PUBLISHED: Model = Model {
    name: "published",
    summary: "the notes' closed form as printed: diverges where bright surfaces lie open; for comparison alone",
    citation: "notes on improved ambient occlusion, eq. 6-12",
    openness: Openness::Uniform,
    is_safe: false,
    f64: as_printed,
    f32: as_printed,
    wgsl: || {
        terms_wgsl()
            + "fn multi_bounce(openness: f32, albedo: f32) -> f32 {
    let direct = published_direct(openness);
    let bounced = published_bounced(openness);
    let tau = 1.0 - bounced / (1.0 - direct);
    return direct + albedo * bounced / (1.0 - albedo * tau);
}
"
    },
};
