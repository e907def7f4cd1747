//! Alchemy screen-space ambient obscurance.

use super::slices::{self, RADIUS};
use super::{Inputs, Noise, Parameter, Preset, Taps, Technique, Weighting};

/// Alchemy ambient obscurance.
pub static ALCHEMY: Technique = Technique {
    name: "alchemy",
    summary: "points on a spiral, each closing by its height above the surface over its squared distance",
    citation: "McGuire, Osman, Bukowski & Hennessy 2011",
    weighting: Weighting::Obscurance,
    inputs: Inputs::SURFACES,
    noise: Noise::Hilbert,
    parameters: &[
        Parameter::count("samples", (1.0, 256.0), 1.0, 12.0, "samples a pixel"),
        RADIUS,
        Parameter::number(
            "intensity_m",
            "m",
            (0.0, 100_000.0),
            0.15,
            "strength; of the size of the distance at which things should cease to darken",
        ),
        Parameter::number(
            "bias",
            "",
            (0.0, 1.0),
            0.0005,
            "heights below this share of the depth do not occlude",
        ),
        Parameter::number(
            "softening_m",
            "m",
            (0.0, 100_000.0),
            0.01,
            "added to distances, so that contact does not turn infinitely dark",
        ),
        Parameter::number("contrast", "", (0.1, 16.0), 1.0, "power of the result"),
    ],
    samples: Some("samples"),
    taps: Taps::Count("samples"),
    reach: Some("radius_m"),
    presets: &[Preset {
        label: "alchemy12",
        values: &[("samples", 12.0)],
    }],
    gives_cone: false,
    shader: Some(include_str!("alchemy.wgsl")),
    kernel: slices::noise_shift,
};
