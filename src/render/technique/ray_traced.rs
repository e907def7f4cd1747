//! The truth as a technique: what rays through the scene find, computed outside of the renderer
//! and handed in.

use super::{Inputs, Noise, Parameter, Taps, Technique, Weighting};

/// Ray-traced occlusion.
pub static RAY_TRACED: Technique = Technique {
    name: "ray-traced",
    summary: "the truth: rays through the scene's triangles until the error is small enough; on the processor, slow",
    citation: "thesis 3.2-3.4; obscurance: Zhukov & Iones 1998",
    weighting: Weighting::Cosine,
    inputs: Inputs::SURFACES,
    noise: Noise::None,
    parameters: &[
        Parameter::number(
            "error",
            "",
            (0.0001, 0.5),
            0.002,
            "standard error at which a pixel has had rays enough",
        ),
        Parameter::count(
            "max_rays",
            (64.0, 1_048_576.0),
            1.0,
            16_384.0,
            "rays a pixel has at most, rounded up to a power of two",
        ),
        Parameter::number(
            "d_max_m",
            "m",
            (0.0, 100_000.0),
            0.0,
            "distance at which a surface no longer hides anything; 0 for none, at any distance it hides all",
        ),
    ],
    samples: None,
    taps: Taps::None,
    reach: Some("d_max_m"),
    presets: &[],
    gives_cone: false,
    shader: None,
    kernel: |_, _| Vec::new(),
};
