//! The cubic of Jimenez et al., fitted to path-traced scenes.

use super::{Model, Openness, formula};

formula!(cubic, |openness, albedo, c| {
    let a = c(2.0404) * albedo - c(0.3324);
    let b = c(-4.7951) * albedo + c(0.6417);
    let d = c(2.7552) * albedo + c(0.6903);
    openness.max(((a * openness + b) * openness + d) * openness)
});

/// The cubic of 2016.
pub static JIMENEZ_2016: Model = Model {
    name: "jimenez-2016",
    summary: "a cubic in cosine-weighted openness, its coefficients linear in the albedo",
    citation: "Jimenez, Wu, Pesce & Jarabo 2016, section 5",
    openness: Openness::Cosine,
    is_safe: true,
    f64: cubic::f64,
    f32: cubic::f32,
    wgsl: "fn multi_bounce(openness: f32, albedo: f32) -> f32 {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    return max(openness, ((a * openness + b) * openness + c) * openness);
}
",
};
