//! Two bands of occlusion: near surfaces as the picture shows them, the far scene as spheres.

use super::slices::{self, RADIUS};
use super::{Inputs, Noise, PROXIES, Parameter, Preset, Taps, Technique, Weighting};

/// Occlusion in two bands.
pub static TWO_BAND: Technique = Technique {
    name: "two-band",
    summary: "near surfaces as spheres of a pixel's size, and spheres fitted to the whole scene, seen or not, beyond",
    citation: "Shanmugam & Arikan 2007",
    weighting: Weighting::Cosine,
    inputs: Inputs {
        proxies: true,
        ..Inputs::SURFACES
    },
    noise: Noise::Hilbert,
    parameters: &[
        Parameter::count(
            "samples",
            (1.0, 256.0),
            1.0,
            24.0,
            "samples a pixel of the near band",
        ),
        RADIUS,
        Parameter::number(
            "reach_m",
            "m",
            (0.0, 100_000.0),
            5.0,
            "distance at which the spheres of the far band cease to count",
        ),
        Parameter::number(
            "bias",
            "",
            (0.0, 1.0),
            0.05,
            "what stands above the surface by less than this share of its distance does not occlude",
        ),
        Parameter::count(
            PROXIES,
            (0.0, 512.0),
            1.0,
            256.0,
            "spheres fitted to the scene; 0 leaves the near band alone",
        ),
        Parameter::choice(
            "overlap",
            &["product", "sum"],
            "how occluders add up: product takes them to lie at random; sum, the paper's way, counts what overlaps twice",
        ),
    ],
    samples: Some("samples"),
    taps: Taps::Count("samples"),
    reach: Some("reach_m"),
    presets: &[Preset {
        label: "two-band24",
        values: &[("samples", 24.0)],
    }],
    gives_cone: false,
    shader: Some(include_str!("two_band.wgsl")),
    kernel: slices::noise_shift,
};
