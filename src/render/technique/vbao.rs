//! Visibility bitmasks: slices whose occluders have a thickness.

use super::slices::{self, RADIUS, SLICES, STEP_POWER, STEPS, THROUGH_CONE};
use super::{Inputs, Noise, Parameter, Preset, Taps, Technique, Weighting};

/// Visibility-bitmask ambient occlusion.
pub static VBAO: Technique = Technique {
    name: "vbao",
    summary: "32 sectors a slice, each open or closed: light passes behind thin things",
    citation: "Therrien, Levesque & Gilet 2023",
    weighting: Weighting::Cosine,
    inputs: Inputs::SURFACES,
    noise: Noise::Hilbert,
    parameters: &[
        SLICES,
        STEPS,
        RADIUS,
        Parameter::number(
            "thickness_m",
            "m",
            (0.0, 100_000.0),
            0.2,
            "how deep whatever is seen goes on behind what is seen of it",
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
            label: "vbao18",
            values: &[("slices", 3.0), ("steps", 3.0)],
        },
        Preset {
            label: "vbao54",
            values: &[("slices", 9.0), ("steps", 3.0)],
        },
    ],
    gives_cone: true,
    shader: Some(include_str!("vbao.wgsl")),
    kernel: slices::noise_shift,
};
