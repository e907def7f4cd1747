//! The thesis' own technique: blizzard's offsets, walked in steps.

use super::blizzard::{DISTANCE_SCALE, FAR_THRESHOLD, MODE, NEAR_THRESHOLD, POWER, RADIUS};
use super::{Inputs, Noise, Parameter, Preset, Settings, Taps, Technique, Weighting, sampling};
use crate::seed;

/// The ray-marching technique.
pub static RAY_MARCH: Technique = Technique {
    name: "ray-march",
    summary: "as blizzard, but walks along each offset and stops at the first surface in front",
    citation: "Bavoil & Sainz 2009 (the idea); thesis 4.3.3, appendix C",
    weighting: Weighting::Empirical,
    inputs: Inputs::SURFACES,
    noise: Noise::Tile,
    parameters: &[
        Parameter::count("directions", (1.0, 256.0), 1.0, 30.0, "directions a pixel"),
        Parameter::count("steps", (1.0, 64.0), 1.0, 4.0, "steps along a direction"),
        RADIUS,
        DISTANCE_SCALE,
        NEAR_THRESHOLD,
        FAR_THRESHOLD,
        POWER,
        MODE,
    ],
    samples: Some("directions"),
    taps: Taps::Lines {
        count: "directions",
        sides: 1,
        steps: "steps",
    },
    reach: Some("radius_m"),
    presets: &[Preset {
        label: "ray-march30",
        values: &[("directions", 30.0), ("steps", 4.0)],
    }],
    gives_cone: false,
    shader: Some(include_str!("ray_march.wgsl")),
    kernel: points,
};

fn points(settings: &Settings, seed: u64) -> Vec<[f32; 4]> {
    let mut rng = seed::generator(seed, "ray-march-kernel", 0);
    sampling::in_sphere(settings.get("directions") as usize, &mut rng)
}
