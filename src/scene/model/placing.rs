//! From a file's units and axes to the scene's: metres, +Y up.

use glam::{Affine3A, Mat3, Vec3, Vec3A};

use super::error::Fault;
use super::{ModelOptions, Up};
use crate::scene::Geometry;

/// Farthest a vertex may be from the origin, metres: beyond it depth in 32 bits has
/// no millimetres left, and a config's camera cannot go there.
const FARTHEST_M: f32 = 100_000.0;

/// Scales and turns the model, and puts it on the ground if asked to.
pub(super) fn place(geometry: &mut Geometry, options: &ModelOptions) -> Result<(), Fault> {
    transform(geometry, turn(options.up), options.scale, Vec3::ZERO);
    let bounds = geometry.bounds_m();
    if let Some((low, high)) = bounds
        && options.ground
    {
        let middle = (low + high) / 2.0;
        let shift = Vec3::new(-middle.x, -low.y, -middle.z);
        transform(geometry, Mat3::IDENTITY, 1.0, shift);
    }
    match geometry.bounds_m() {
        Some((low, high)) if low.abs().max(high.abs()).max_element() <= FARTHEST_M => Ok(()),
        None => Err(Fault::whole(
            "there are no triangles in the file; a scene needs a surface",
        )),
        Some((low, high)) => Err(Fault::whole(format!(
            "the model reaches from {low} to {high} m; allowed is up to {FARTHEST_M} m from the \
             origin: give a smaller scale, or move it in the program it was made with"
        ))),
    }
}

/// The rotation that brings the file's up to +Y.
fn turn(up: Up) -> Mat3 {
    match up {
        Up::Y => Mat3::IDENTITY,
        Up::Z => Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y),
        Up::X => Mat3::from_cols(Vec3::Y, Vec3::NEG_X, Vec3::Z),
    }
}

fn transform(geometry: &mut Geometry, turn: Mat3, scale: f32, shift_m: Vec3) {
    let whole = Affine3A::from_mat3_translation(turn * scale, shift_m);
    for vertex in geometry.meshes.iter_mut().flat_map(|m| &mut m.vertices) {
        let position = whole.transform_point3a(Vec3A::from(vertex.position_m));
        vertex.position_m = position.to_array();
        vertex.normal = (turn * Vec3::from(vertex.normal)).to_array();
        let [x, y, z, w] = vertex.tangent;
        vertex.tangent = (turn * Vec3::new(x, y, z)).extend(w).to_array();
    }
    for sun in &mut geometry.lights.suns {
        sun.towards = turn * sun.towards;
    }
    for light in &mut geometry.lights.points {
        light.position_m = whole.transform_point3(light.position_m);
        if let Some(cone) = &mut light.cone {
            cone.along = turn * cone.along;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_goes_up_and_nothing_is_mirrored() {
        for (up, axis) in [(Up::X, Vec3::X), (Up::Y, Vec3::Y), (Up::Z, Vec3::Z)] {
            assert_eq!(turn(up) * axis, Vec3::Y);
            assert!((turn(up).determinant() - 1.0).abs() < 1e-6);
        }
    }
}
