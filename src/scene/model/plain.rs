//! Triangles of formats that know no tangents and often no normals.

use std::f32::consts::PI;

use super::error::Fault;
use super::{Loading, normals, tangents};
use crate::scene::{Mesh, Vertex};

/// A corner before anything but its position is known.
pub(super) const BLANK: Vertex = Vertex {
    position_m: [0.0; 3],
    normal: [0.0; 3],
    tangent: [0.0; 4],
    uv: [0.0; 2],
    color: [1.0; 4],
};

/// Adds a mesh whose indices are known to be in range; `normals_known` says whether its
/// vertices have theirs.
pub(super) fn add(
    mut mesh: Mesh,
    normals_known: bool,
    place: &str,
    loading: &mut Loading,
) -> Result<(), Fault> {
    if mesh.indices.is_empty() {
        return Ok(());
    }
    if normals_known {
        for vertex in &mut mesh.vertices {
            let normal = glam::Vec3::from(vertex.normal);
            vertex.normal = normal.normalize_or(glam::Vec3::Y).to_array();
        }
    } else {
        let crease_rad = loading.options.crease_rad.unwrap_or(PI);
        loading
            .warnings
            .say("there are meshes without normals; they were computed from the triangles");
        let budget = &mut loading.budget;
        normals::compute(
            place,
            &mut mesh.vertices,
            &mut mesh.indices,
            crease_rad,
            budget,
        )?;
    }
    tangents::any(&mut mesh.vertices);
    loading.geometry.meshes.push(mesh);
    Ok(())
}
