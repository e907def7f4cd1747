//! Screen-space directional occlusion, with one bounce of light.

use super::slices::{self, RADIUS};
use super::{Inputs, Noise, Parameter, Preset, Taps, Technique, Weighting};

/// Screen-space directional occlusion.
pub static SSDO: Technique = Technique {
    name: "ssdo",
    summary: "points over the normal's hemisphere: open directions carry their own light, closed ones a bounce's colour",
    citation: "Ritschel, Grosch & Seidel 2009",
    weighting: Weighting::Cosine,
    inputs: Inputs {
        light: true,
        ..Inputs::SURFACES
    },
    noise: Noise::Hilbert,
    parameters: &[
        Parameter::count("samples", (1.0, 256.0), 1.0, 16.0, "samples a pixel"),
        RADIUS,
        Parameter::number(
            "bounce",
            "",
            (0.0, 1.0),
            1.0,
            "how much of the light counts that occluders send back; 0 is directional occlusion alone",
        ),
    ],
    samples: Some("samples"),
    taps: Taps::Count("samples"),
    reach: Some("radius_m"),
    presets: &[Preset {
        label: "ssdo16",
        values: &[("samples", 16.0)],
    }],
    gives_cone: true,
    shader: Some(include_str!("ssdo.wgsl")),
    kernel: slices::noise_shift,
};
