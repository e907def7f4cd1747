//! Horizon-based ambient occlusion.

use super::slices::{self, RADIUS, STEP_POWER, STEPS};
use super::{Inputs, Noise, Parameter, Preset, Taps, Technique, Weighting};

/// Horizon-based ambient occlusion.
pub static HBAO: Technique = Technique {
    name: "hbao",
    summary: "the rise of the horizon along directions, each rise counted by how near it is",
    citation: "Bavoil, Sainz & Dimitrov 2008; Bavoil & Sainz 2009",
    weighting: Weighting::Uniform,
    inputs: Inputs::SURFACES,
    noise: Noise::Hilbert,
    parameters: &[
        Parameter::count(
            "directions",
            (1.0, 64.0),
            1.0,
            6.0,
            "directions from the pixel",
        ),
        STEPS,
        RADIUS,
        Parameter::number(
            "bias_deg",
            "degrees",
            (0.0, 90.0),
            4.0,
            "what rises less than this above the surface does not occlude",
        ),
        STEP_POWER,
    ],
    samples: None,
    taps: Taps::Lines {
        count: "directions",
        sides: 1,
        steps: "steps",
    },
    reach: Some("radius_m"),
    presets: &[Preset {
        label: "hbao24",
        values: &[("directions", 6.0), ("steps", 4.0)],
    }],
    gives_cone: false,
    shader: Some(include_str!("hbao.wgsl")),
    kernel: slices::noise_shift,
};
