//! Tangents for surfaces whose file has none.

use bevy_mikktspace::{GenerateTangentSpaceError, Geometry as Faces, TangentSpace};
use glam::{Affine2, Vec2, Vec3};

use super::error::Fault;
use super::limits::Budget;
use super::split::split;
use crate::scene::Vertex;
use crate::scene::modelling::math::perpendicular;

/// A valid frame for surfaces whose tangents nobody reads: some unit vector at a right
/// angle to the normal.
pub(super) fn any(vertices: &mut [Vertex]) {
    for vertex in vertices {
        let tangent = perpendicular(Vec3::from(vertex.normal));
        vertex.tangent = tangent.extend(1.0).to_array();
    }
}

/// MikkTSpace tangents (Mikkelsen 2008), as glTF 2.0 wants them where a file has none,
/// for a normal map read at `transform`ed coordinates.
///
/// MikkTSpace has v up the texture and glTF has it down, so it is given −v: then the
/// bitangent points where the map's green does.
pub(super) fn mikktspace(
    place: &str,
    vertices: &mut Vec<Vertex>,
    indices: &mut [u32],
    transform: Affine2,
    budget: &mut Budget,
) -> Result<(), Fault> {
    any(vertices);
    let mut surface = Surface {
        tangents: indices
            .iter()
            .map(|&i| vertices[i as usize].tangent)
            .collect(),
        vertices,
        indices,
        transform,
    };
    let done: Result<(), GenerateTangentSpaceError> =
        bevy_mikktspace::generate_tangents(&mut surface);
    done.map_err(|error| Fault::new(place, format!("tangents cannot be computed: {error}")))?;
    let tangents = surface.tangents;
    split(
        place,
        vertices,
        indices,
        budget,
        |c| tangents[c],
        |v, t| {
            v.tangent = t;
        },
    )
}

struct Surface<'a> {
    vertices: &'a [Vertex],
    indices: &'a [u32],
    transform: Affine2,
    /// By corner.
    tangents: Vec<[f32; 4]>,
}

impl Surface<'_> {
    fn vertex(&self, face: usize, corner: usize) -> &Vertex {
        &self.vertices[self.indices[3 * face + corner] as usize]
    }
}

impl Faces for Surface<'_> {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.vertex(face, corner).position_m
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.vertex(face, corner).normal
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let uv = Vec2::from(self.vertex(face, corner).uv);
        let [u, v] = self.transform.transform_point2(uv).to_array();
        [u, -v]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(space) = space else { return };
        let [x, y, z, w] = space.tangent_encoded();
        let tangent = Vec3::new(x, y, z);
        // Without texture coordinates to speak of there is no direction.
        if (tangent.length() - 1.0).abs() < 1e-3 {
            self.tangents[3 * face + corner] = [x, y, z, w];
        }
    }
}
