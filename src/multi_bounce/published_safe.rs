//! The notes' model without its pole: the same numbers wherever they are sound.

use num_traits::Float;

use super::published::{direct, first_bounce, terms_wgsl};
use super::{Model, Openness, unit};

/// With u = 1 − F₀, ρF₁ / (1 − ρτ) = ρF₁u / ((1−ρ)u + ρF₁): no quotient of two small numbers is taken, and
/// where the denominator is 0 nothing is left that could bounce.
fn without_pole<F: Float>(openness: F, albedo: F) -> F {
    let (openness, albedo) = (unit(openness), unit(albedo));
    let direct = direct(openness).min(F::one());
    let bounced = first_bounce(openness);
    let closed = F::one() - direct;
    let below = (F::one() - albedo) * closed + albedo * bounced;
    if below > F::zero() {
        direct + closed * (albedo * bounced / below)
    } else {
        direct
    }
}

/// The notes' model, safe.
pub static PUBLISHED_SAFE: Model = Model {
    name: "published-safe",
    summary: "the notes' closed form with its direct term held at 1 and without its pole",
    citation: "notes on improved ambient occlusion, eq. 6-12, rearranged",
    openness: Openness::Uniform,
    is_safe: true,
    f64: without_pole,
    f32: without_pole,
    wgsl: || {
        terms_wgsl()
            + "fn multi_bounce(openness: f32, albedo: f32) -> f32 {
    let a = clamp(openness, 0.0, 1.0);
    let rho = clamp(albedo, 0.0, 1.0);
    let direct = min(published_direct(a), 1.0);
    let bounced = published_bounced(a);
    let closed = 1.0 - direct;
    let below = (1.0 - rho) * closed + rho * bounced;
    if below > 0.0 {
        return direct + closed * (rho * bounced / below);
    }
    return direct;
}
"
    },
};
