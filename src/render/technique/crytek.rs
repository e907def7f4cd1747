//! Crytek's technique, in the form the thesis used.

use glam::{Quat, Vec3};

use super::{Inputs, Noise, Parameter, Preset, Settings, Taps, Technique, Weighting, noise_tile};

/// Crytek's technique.
pub static CRYTEK: Technique = Technique {
    name: "crytek",
    summary: "cube corners round the pixel, compared in depth alone; edges glow, flat walls turn grey",
    citation: "Mittring 2007; Kajalin 2009; thesis 4.3.1, appendix A",
    weighting: Weighting::Empirical,
    inputs: Inputs {
        normals: false,
        ..Inputs::SURFACES
    },
    noise: Noise::Tile,
    parameters: &[
        Parameter::count(
            "samples",
            (8.0, 256.0),
            8.0,
            24.0,
            "samples a pixel, whole cubes of 8",
        ),
        Parameter::number(
            "radius_uv",
            "",
            (0.0, 1.0),
            0.01,
            "length of the offsets before they grow (9.8-fold in all at 24 samples), as a fraction of the picture",
        ),
    ],
    samples: Some("samples"),
    taps: Taps::Count("samples"),
    reach: None,
    presets: &[Preset {
        label: "crytek24",
        values: &[("samples", 24.0)],
    }],
    gives_cone: false,
    shader: Some(include_str!("crytek.wgsl")),
    kernel: rotations,
};

/// One rotation for each cell of the noise tile, as a unit quaternion: the one that takes +Z
/// to the cell's vector by the shortest way. The listing writes the same rotation as a matrix
/// with a factor 1/(1 + z), which is singular for the vector (0, 0, −1); the quaternion is not.
fn rotations(_: &Settings, seed: u64) -> Vec<[f32; 4]> {
    noise_tile(seed)
        .iter()
        .map(|cell| shortest_rotation(Vec3::new(cell[0], cell[1], cell[2])).to_array())
        .collect()
}

fn shortest_rotation(to: Vec3) -> Quat {
    Quat::from_rotation_arc(Vec3::Z, to.normalize_or(Vec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Appendix A's matrix, rows as listed; it is applied to a row vector.
    fn listed_rotation(r: Vec3, v: Vec3) -> Vec3 {
        let h = 1.0 / (1.0 + r.z);
        let row_0 = Vec3::new(h * r.y * r.y + r.z, -h * r.y * r.x, -r.x);
        let row_1 = Vec3::new(-h * r.y * r.x, h * r.x * r.x + r.z, -r.y);
        row_0 * v.x + row_1 * v.y + r * v.z
    }

    proptest! {
        #[test]
        fn the_quaternion_is_the_listed_matrix(
            x in -1.0_f32..1.0, y in -1.0_f32..1.0, z in -0.9_f32..1.0,
            a in -1.0_f32..1.0, b in -1.0_f32..1.0, c in -1.0_f32..1.0,
        ) {
            let to = Vec3::new(x, y, z);
            prop_assume!(to.length() > 0.1);
            let to = to.normalize();
            prop_assume!(to.z > -0.95);
            let v = Vec3::new(a, b, c);
            prop_assert!((shortest_rotation(to) * v - listed_rotation(to, v)).length() < 1e-4);
        }
    }

    #[test]
    fn the_antipode_is_a_rotation_like_any_other() {
        let rotation = shortest_rotation(Vec3::NEG_Z);
        assert!((rotation.length() - 1.0).abs() < 1e-6);
        assert!((rotation * Vec3::Z - Vec3::NEG_Z).length() < 1e-6);
        assert!((shortest_rotation(Vec3::ZERO).length() - 1.0).abs() < 1e-6);
    }
}
