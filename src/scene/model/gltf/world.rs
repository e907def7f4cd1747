//! A vertex from its mesh's space to the world.

use glam::{Affine3A, Mat3A, Vec3, Vec3A};

use crate::scene::Vertex;

/// What a transform does to directions.
pub(super) struct Directions {
    /// Normals stay at right angles to the surface: the inverse transposed, up to a
    /// positive factor.
    normal: Mat3A,
    mirrors: bool,
}

impl Directions {
    pub fn new(matrix: &Affine3A) -> Self {
        let [x, y, z] = [
            matrix.matrix3.x_axis,
            matrix.matrix3.y_axis,
            matrix.matrix3.z_axis,
        ];
        // The cofactors are there even where the transform flattens everything and
        // has no inverse.
        let cofactors = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrors = x.dot(y.cross(z)) < 0.0;
        Self {
            normal: if mirrors { -cofactors } else { cofactors },
            mirrors,
        }
    }
}

/// Transforms a vertex; says whether that mirrored it.
pub(super) fn place(vertex: &mut Vertex, matrix: &Affine3A, directions: &Directions) -> bool {
    let position = matrix.transform_point3a(Vec3A::from(vertex.position_m));
    vertex.position_m = position.to_array();
    let normal = directions.normal * Vec3A::from(vertex.normal);
    vertex.normal = normal.normalize_or(Vec3A::Y).to_array();
    let [x, y, z, w] = vertex.tangent;
    let tangent = (matrix.matrix3 * Vec3A::new(x, y, z)).normalize_or(Vec3A::X);
    // A mirror turns the cross product round, and with it the bitangent.
    let handedness = if (w < 0.0) == directions.mirrors {
        1.0
    } else {
        -1.0
    };
    vertex.tangent = Vec3::from(tangent).extend(handedness).to_array();
    directions.mirrors
}

/// Whether the transform has not thrown it to infinity.
pub(super) fn is_finite(vertex: &Vertex) -> bool {
    let all = vertex.position_m.iter().chain(&vertex.normal);
    all.chain(&vertex.tangent).all(|x| x.is_finite())
}
