//! No occlusion: k_A = 1 everywhere, and no pass runs.

use super::{Inputs, Noise, Taps, Technique, Weighting};

/// No occlusion.
pub static NONE: Technique = Technique {
    name: "none",
    summary: "no occlusion: the ambient light reaches everything, and no occlusion pass runs",
    citation: "thesis 5.3 (the control image)",
    weighting: Weighting::None,
    inputs: Inputs::NONE,
    noise: Noise::None,
    parameters: &[],
    samples: None,
    taps: Taps::None,
    reach: None,
    presets: &[],
    gives_cone: false,
    shader: None,
    kernel: |_, _| Vec::new(),
};
