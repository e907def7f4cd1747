//! The cubic of Jimenez et al., fitted to path-traced scenes.

use num_traits::Float;

use super::{Model, Openness, number as n, unit};

/// The coefficients of v³, v² and v: each a slope over the albedo and a constant.
const CUBIC: [[f64; 2]; 3] = [[2.0404, -0.3324], [-4.7951, 0.6417], [2.7552, 0.6903]];

/// The coefficients add up to 1.0001 at ρ = 1 and to 0.9996 at ρ = 0: what exceeds 1 is their rounding.
fn cubic<F: Float>(openness: F, albedo: F) -> F {
    let v = unit(openness);
    let [a, b, c] = CUBIC.map(|[slope, constant]| n::<F>(slope) * albedo + n(constant));
    v.max(((a * v + b) * v + c) * v).min(F::one())
}

/// The cubic of 2016.
pub static JIMENEZ_2016: Model = Model {
    name: "jimenez-2016",
    summary: "a cubic in cosine-weighted openness, its coefficients linear in the albedo",
    citation: "Jimenez, Wu, Pesce & Jarabo 2016, section 5",
    openness: Openness::Cosine,
    is_safe: true,
    f64: cubic,
    f32: cubic,
    wgsl: || {
        let [a, b, c] =
            CUBIC.map(|[slope, constant]| format!("({slope:?} * albedo + {constant:?})"));
        format!(
            "fn multi_bounce(openness: f32, albedo: f32) -> f32 {{
    let v = clamp(openness, 0.0, 1.0);
    return min(max(v, (({a} * v + {b}) * v + {c}) * v), 1.0);
}}
"
        )
    },
};
