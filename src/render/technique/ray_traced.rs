//! The truth as a technique: what rays through the scene find, computed outside of the renderer
//! and handed in.

use super::{Inputs, Noise, Parameter, Technique, Weighting};

/// Ray-traced occlusion.
pub static RAY_TRACED: Technique = Technique {
    name: "ray-traced",
    summary: "the truth: rays through the scene's triangles until the error is small enough; on the processor, slow",
    citation: "thesis 3.2-3.4; obscurance: Zhukov & Iones 1998",
    weighting: Weighting::Cosine,
    inputs: Inputs {
        depth: true,
        normals: true,
    },
    noise: Noise::None,
    parameters: &[
        Parameter {
            name: "error",
            meaning: "standard error at which a pixel has had rays enough",
            unit: "",
            low: 0.0001,
            high: 0.5,
            default: 0.002,
            multiple_of: 0.0,
        },
        Parameter {
            name: "max_rays",
            meaning: "rays a pixel has at most, rounded up to a power of two",
            unit: "",
            low: 64.0,
            high: 1_048_576.0,
            default: 16_384.0,
            multiple_of: 1.0,
        },
        Parameter {
            name: "d_max_m",
            meaning: "distance at which a surface no longer hides anything; 0 for none, at any distance it hides all",
            unit: "m",
            low: 0.0,
            high: 100_000.0,
            default: 0.0,
            multiple_of: 0.0,
        },
    ],
    samples: None,
    presets: &[],
    shader: None,
    kernel: |_, _| Vec::new(),
};
