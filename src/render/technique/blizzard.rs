//! Blizzard's technique, in the form the thesis used.

use super::{Inputs, Noise, Parameter, Preset, Settings, Technique, Weighting, sampling};
use crate::seed;

/// Blizzard's technique.
pub static BLIZZARD: Technique = Technique {
    name: "blizzard",
    summary: "points in the normal's hemisphere, each darkening by how far the surface there stands in front",
    citation: "Filion & McNaughton 2008; thesis 4.3.2, appendix B",
    weighting: Weighting::Empirical,
    inputs: Inputs {
        depth: true,
        normals: true,
    },
    noise: Noise::Tile,
    parameters: &[
        Parameter {
            name: "samples",
            meaning: "samples a pixel",
            unit: "",
            low: 1.0,
            high: 256.0,
            default: 24.0,
            multiple_of: 1.0,
        },
        RADIUS,
        DISTANCE_SCALE,
        NEAR_THRESHOLD,
        FAR_THRESHOLD,
        POWER,
    ],
    samples: Some("samples"),
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
    shader: Some(include_str!("blizzard.wgsl")),
    kernel: points,
};

fn points(settings: &Settings, seed: u64) -> Vec<[f32; 4]> {
    let mut rng = seed::generator(seed, "blizzard-kernel", 0);
    sampling::in_sphere(settings.get("samples") as usize, &mut rng)
}

/// Radius of the sphere of samples (the thesis' d_max).
pub(super) const RADIUS: Parameter = Parameter {
    name: "radius_m",
    meaning: "radius of the sphere that is sampled",
    unit: "m",
    low: 0.0,
    high: 100_000.0,
    default: 0.5,
    multiple_of: 0.0,
};

/// The factor s of 1/(1 + (s δ)²). The listing multiplies by the depth of the scene to come
/// from 0…1 to its units; here depth is in metres already, and s is what is left.
pub(super) const DISTANCE_SCALE: Parameter = Parameter {
    name: "distance_scale_per_m",
    meaning: "s of the attenuation 1/(1 + (s d)^2), d the depth difference in metres",
    unit: "1/m",
    low: 0.0,
    high: 100_000.0,
    default: 4.0,
    multiple_of: 0.0,
};

/// The listing's fFullOccThreshold: a smaller difference is the surface itself.
pub(super) const NEAR_THRESHOLD: Parameter = Parameter {
    name: "near_threshold_m",
    meaning: "a surface less than this in front of the pixel does not occlude",
    unit: "m",
    low: 0.0,
    high: 100_000.0,
    default: 0.02,
    multiple_of: 0.0,
};

/// The listing's fNoOccThreshold: a larger difference is something else.
pub(super) const FAR_THRESHOLD: Parameter = Parameter {
    name: "far_threshold_m",
    meaning: "a surface more than this in front of the pixel does not occlude",
    unit: "m",
    low: 0.0,
    high: 100_000.0,
    default: 1.0,
    multiple_of: 0.0,
};

/// The listing's fOcclusionPow.
pub(super) const POWER: Parameter = Parameter {
    name: "power",
    meaning: "power the attenuation is raised to",
    unit: "",
    low: 0.0,
    high: 64.0,
    default: 1.0,
    multiple_of: 0.0,
};
