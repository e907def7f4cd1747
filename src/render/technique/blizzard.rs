//! Blizzard's technique, in the form the thesis used.

use super::{Inputs, Noise, Parameter, Preset, Settings, Taps, Technique, Weighting, sampling};
use crate::seed;

/// Blizzard's technique.
pub static BLIZZARD: Technique = Technique {
    name: "blizzard",
    summary: "points in the normal's hemisphere, each darkening by how far the surface there stands in front",
    citation: "Filion & McNaughton 2008; thesis 4.3.2, appendix B",
    weighting: Weighting::Empirical,
    inputs: Inputs::SURFACES,
    noise: Noise::Tile,
    parameters: &[
        Parameter::count("samples", (1.0, 256.0), 1.0, 24.0, "samples a pixel"),
        RADIUS,
        DISTANCE_SCALE,
        NEAR_THRESHOLD,
        FAR_THRESHOLD,
        POWER,
        MODE,
    ],
    samples: Some("samples"),
    taps: Taps::Count("samples"),
    reach: Some("radius_m"),
    presets: &[
        Preset {
            label: "blizzard8",
            values: &[("samples", 8.0)],
        },
        Preset {
            label: "blizzard24",
            values: &[("samples", 24.0)],
        },
    ],
    gives_cone: false,
    shader: Some(include_str!("blizzard.wgsl")),
    kernel: points,
};

fn points(settings: &Settings, seed: u64) -> Vec<[f32; 4]> {
    let mut rng = seed::generator(seed, "blizzard-kernel", 0);
    sampling::in_sphere(settings.get("samples") as usize, &mut rng)
}

/// Which falloff: the thesis' as it stands, or the one it started from. Two readings of one idea,
/// and never a blend of them.
pub(super) const MODE: Parameter = Parameter::choice(
    "mode",
    &["thesis", "filion"],
    "thesis: distance from the pixel's depth to the surface, between the thresholds, falling off by its square; \
     filion: from the sample's own depth, full up to the near threshold, none from the far one",
);

/// Radius of the sphere of samples (the thesis' d_max).
pub(super) const RADIUS: Parameter = Parameter::number(
    "radius_m",
    "m",
    (0.0, 100_000.0),
    0.5,
    "radius of the sphere that is sampled",
);

/// The factor s of 1/(1 + (s δ)²). The listing multiplies by the depth of the scene to come
/// from 0…1 to its units; here depth is in metres already, and s is what is left.
pub(super) const DISTANCE_SCALE: Parameter = Parameter::number(
    "distance_scale_per_m",
    "1/m",
    (0.0, 100_000.0),
    4.0,
    "s of the attenuation 1/(1 + (s d)^2), d the depth difference in metres",
);

/// The listing's fFullOccThreshold: a smaller difference is the surface itself.
pub(super) const NEAR_THRESHOLD: Parameter = Parameter::number(
    "near_threshold_m",
    "m",
    (0.0, 100_000.0),
    0.02,
    "a surface less than this in front of the pixel does not occlude",
);

/// The listing's fNoOccThreshold: a larger difference is something else.
pub(super) const FAR_THRESHOLD: Parameter = Parameter::number(
    "far_threshold_m",
    "m",
    (0.0, 100_000.0),
    1.0,
    "a surface more than this in front of the pixel does not occlude",
);

/// The listing's fOcclusionPow.
pub(super) const POWER: Parameter = Parameter::number(
    "power",
    "",
    (0.0, 64.0),
    1.0,
    "power the attenuation is raised to",
);
