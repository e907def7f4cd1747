//! No light between surfaces: direct light alone.

use super::{Model, Openness};

/// Direct light alone.
pub static NONE: Model = Model {
    name: "none",
    summary: "direct light alone, as openness says it: what is blocked is lost",
    citation: "the usual ambient term",
    openness: Openness::Uniform,
    is_safe: true,
    f64: |openness, _| openness,
    f32: |openness, _| openness,
    wgsl: || "fn multi_bounce(openness: f32, albedo: f32) -> f32 { return openness; }\n".to_owned(),
};
