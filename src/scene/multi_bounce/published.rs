//! The notes' model as it is printed. It is here to be compared with: it is not finite
//! everywhere, and its direct term exceeds 1 between α = 0.949253 and 1.

use super::{Model, Openness, formula};

/// The fit's coefficients (the notes' eq. 10).
pub(super) const A: f64 = 27.576_937_094_210_385;
/// Of the exponent.
pub(super) const B: f64 = 3.336_439_200_342_380_4;

formula!(as_printed, |openness, albedo, c| {
    let direct = openness * (c(1.0) + (c(1.0) - openness).powf(c(0.75)) / c(2.0));
    let bounced = c(super::A)
        * openness
        * (c(1.0) - openness).powf(c(1.5))
        * (-c(super::B) * openness.powf(c(0.25))).exp();
    let kept = c(1.0) - bounced / (c(1.0) - direct);
    direct + albedo * bounced / (c(1.0) - albedo * kept)
});

/// As printed.
pub static PUBLISHED: Model = Model {
    name: "published",
    summary: "the notes' closed form as printed: diverges where bright surfaces lie open; for comparison alone",
    citation: "notes on improved ambient occlusion, eq. 6-12",
    openness: Openness::Uniform,
    is_safe: false,
    f64: as_printed::f64,
    f32: as_printed::f32,
    wgsl: "fn multi_bounce(openness: f32, albedo: f32) -> f32 {
    let direct = openness * (1.0 + pow(1.0 - openness, 0.75) / 2.0);
    let bounced = 27.576937094210385 * openness * pow(1.0 - openness, 1.5) * exp(-3.3364392003423804 * pow(openness, 0.25));
    let kept = 1.0 - bounced / (1.0 - direct);
    return direct + albedo * bounced / (1.0 - albedo * kept);
}
",
};
