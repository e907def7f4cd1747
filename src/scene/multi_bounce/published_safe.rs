//! The notes' model without its pole: the same numbers wherever they are sound.

use super::published::{A, B};
use super::{Model, Openness, formula};

formula!(without_pole, |openness, albedo, c| {
    // Occlusion of a pixel may be rounded to just outside of its range.
    let a = openness.clamp(c(0.0), c(1.0));
    let direct = (a * (c(1.0) + (c(1.0) - a).powf(c(0.75)) / c(2.0))).min(c(1.0));
    let bounced = c(super::A) * a * (c(1.0) - a).powf(c(1.5)) * (-c(super::B) * a.powf(c(0.25))).exp();
    let closed = c(1.0) - direct;
    let below = (c(1.0) - albedo) * closed + albedo * bounced;
    if below > c(0.0) {
        direct + albedo * bounced * closed / below
    } else {
        direct
    }
});

/// The notes' model, safe.
pub static PUBLISHED_SAFE: Model = Model {
    name: "published-safe",
    summary: "the notes' closed form with its direct term held at 1 and without its pole",
    citation: "notes on improved ambient occlusion, eq. 6-12, rearranged",
    openness: Openness::Uniform,
    is_safe: true,
    f64: without_pole::f64,
    f32: without_pole::f32,
    wgsl: "fn multi_bounce(openness: f32, albedo: f32) -> f32 {
    let a = clamp(openness, 0.0, 1.0);
    let direct = min(a * (1.0 + pow(1.0 - a, 0.75) / 2.0), 1.0);
    let bounced = 27.576937094210385 * a * pow(1.0 - a, 1.5) * exp(-3.3364392003423804 * pow(a, 0.25));
    let closed = 1.0 - direct;
    let below = (1.0 - albedo) * closed + albedo * bounced;
    if below > 0.0 {
        return direct + albedo * bounced * closed / below;
    }
    return direct;
}
",
};
