//! Plain shapes: what tests of exact cases are built from.

use glam::Vec3;

use super::{Geometry, Material, Mesh, ModelLights, Vertex};

/// A parallelogram with corner `origin_m` and edges `u_m`, `v_m`; it faces
/// `u_m × v_m`. Texture coordinates are 0 to 1 along the edges.
#[must_use]
pub fn quad(name: &str, origin_m: Vec3, u_m: Vec3, v_m: Vec3) -> Mesh {
    let normal = u_m.cross(v_m).normalize_or(Vec3::Y);
    let tangent = u_m.normalize_or(Vec3::X);
    let corner = |u: f32, v: f32| Vertex {
        position_m: (origin_m + u_m * u + v_m * v).to_array(),
        normal: normal.to_array(),
        tangent: tangent.extend(1.0).to_array(),
        uv: [u, v],
        color: [1.0; 4],
    };
    Mesh {
        name: name.to_owned(),
        vertices: vec![
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ],
        indices: vec![0, 1, 2, 0, 2, 3],
        material: 0,
    }
}

/// An axis-aligned box, faces outward.
#[must_use]
pub fn cuboid(name: &str, low_m: Vec3, high_m: Vec3) -> Mesh {
    let size = high_m - low_m;
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    let faces = [
        quad(name, low_m + z, x, y),
        quad(name, low_m + x, -x, y),
        quad(name, low_m + x + z, -z, y),
        quad(name, low_m, z, y),
        quad(name, low_m + y + z, x, -z),
        quad(name, low_m, x, z),
    ];
    let mut mesh = Mesh {
        name: name.to_owned(),
        ..Mesh::default()
    };
    for face in faces {
        let base = u32::try_from(mesh.vertices.len()).unwrap_or(0);
        mesh.vertices.extend(face.vertices);
        mesh.indices
            .extend(face.indices.iter().map(|index| base + index));
    }
    mesh
}

/// Geometry of meshes that all share one material.
#[must_use]
pub fn of_one_material(material: Material, meshes: Vec<Mesh>) -> Geometry {
    Geometry {
        meshes,
        materials: vec![material],
        textures: Vec::new(),
        lights: ModelLights::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cuboid_faces_outward() {
        let (low, high) = (Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 4.0));
        let mesh = cuboid("box", low, high);
        let centre = (low + high) / 2.0;
        assert_eq!(mesh.indices.len(), 36);
        for triangle in mesh.indices.chunks(3) {
            let p: Vec<Vec3> = triangle
                .iter()
                .map(|&i| Vec3::from(mesh.vertices[i as usize].position_m))
                .collect();
            let facing = (p[1] - p[0]).cross(p[2] - p[0]);
            assert!(facing.dot(p[0] - centre) > 0.0);
            let normal = Vec3::from(mesh.vertices[triangle[0] as usize].normal);
            assert!(facing.normalize().dot(normal) > 0.999);
        }
    }
}
