//! Ground-truth ambient occlusion: horizons, and the light between them in closed form.

use super::slices::{self, RADIUS, SLICES, STEP_POWER, STEPS, THROUGH_CONE};
use super::{Inputs, Noise, Parameter, Preset, Taps, Technique, Weighting};

/// Ground-truth ambient occlusion.
pub static GTAO: Technique = Technique {
    name: "gtao",
    summary: "the horizon to both sides of slices through the line of sight, and the cosine-weighted light between",
    citation: "Jimenez, Wu, Pesce & Jarabo 2016",
    weighting: Weighting::Cosine,
    inputs: Inputs::SURFACES,
    noise: Noise::Hilbert,
    parameters: &[
        SLICES,
        STEPS,
        RADIUS,
        Parameter::number(
            "falloff",
            "",
            (0.0, 1.0),
            0.6,
            "the outer share of the radius over which occluders fade out",
        ),
        STEP_POWER,
        THROUGH_CONE,
    ],
    samples: None,
    taps: Taps::Lines {
        count: "slices",
        sides: 2,
        steps: "steps",
    },
    reach: Some("radius_m"),
    presets: &[
        Preset {
            label: "gtao18",
            values: &[("slices", 3.0), ("steps", 3.0)],
        },
        Preset {
            label: "gtao54",
            values: &[("slices", 9.0), ("steps", 3.0)],
        },
    ],
    gives_cone: true,
    shader: Some(include_str!("gtao.wgsl")),
    kernel: slices::noise_shift,
};
