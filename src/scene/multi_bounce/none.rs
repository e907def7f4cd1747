//! No light between surfaces: direct light alone.

use super::{Model, Openness, formula};

formula!(direct, |openness, _albedo, c| {
    let _ = c(0.0);
    openness
});

/// Direct light alone.
pub static NONE: Model = Model {
    name: "none",
    summary: "direct light alone: occluded light is lost",
    citation: "the usual ambient term",
    openness: Openness::Uniform,
    is_safe: true,
    f64: direct::f64,
    f32: direct::f32,
    wgsl: "fn multi_bounce(openness: f32, albedo: f32) -> f32 { return openness; }\n",
};
