//! What techniques that look along slices have in common: their seed and their parameters.

use super::{BENT_CONE, Parameter, Settings};
use crate::seed::{self, unit_f32};

/// The seed's own shift of the spatial noise, in [0, 1)².
pub(super) fn noise_shift(_: &Settings, seed: u64) -> Vec<[f32; 4]> {
    let mut rng = seed::generator(seed, "occlusion-spatial-noise", 0);
    vec![[unit_f32(&mut rng), unit_f32(&mut rng), 0.0, 0.0]]
}

/// How many slices.
pub(super) const SLICES: Parameter = Parameter::count(
    "slices",
    (1.0, 64.0),
    1.0,
    3.0,
    "planes through the line of sight; each is looked along to both sides",
);

/// How many samples along each side of a slice.
pub(super) const STEPS: Parameter =
    Parameter::count("steps", (1.0, 64.0), 1.0, 3.0, "samples along each side");

/// How far occluders are looked for.
pub(super) const RADIUS: Parameter = Parameter::number(
    "radius_m",
    "m",
    (0.0, 100_000.0),
    0.5,
    "how far occluders are looked for",
);

/// How samples gather near the point.
pub(super) const STEP_POWER: Parameter = Parameter::number(
    "step_power",
    "",
    (1.0, 8.0),
    2.0,
    "samples lie at the radius times (i/steps) to this power: above 1 they gather near the point",
);

/// Whether light of an environment comes in through the bent cone.
pub(super) const THROUGH_CONE: Parameter = Parameter::choice(
    BENT_CONE,
    &["off", "on"],
    "on: an environment's light comes in through the cone of open directions; off: from all round, times k_A",
);
