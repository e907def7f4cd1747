//! The same surface of more triangles.

use glam::Vec3;

use super::geometry::{Geometry, Mesh, Vertex};

impl Geometry {
    /// The same surface of twice as many triangles: each is cut in two across its longest edge.
    #[must_use]
    pub fn of_twice_the_triangles(&self) -> Self {
        Self {
            meshes: self.meshes.iter().map(halved).collect(),
            ..self.clone()
        }
    }
}

fn halved(mesh: &Mesh) -> Mesh {
    let mut halves = Mesh {
        indices: Vec::with_capacity(2 * mesh.indices.len()),
        ..mesh.clone()
    };
    for corners in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = longest_edge_first(mesh, *corners);
        let Ok(middle) = u32::try_from(halves.vertices.len()) else {
            // As many vertices as indices can count: the rest stays whole.
            halves.indices.extend([a, b, c]);
            continue;
        };
        let of = |index: u32| mesh.vertices[index as usize];
        halves.vertices.push(between(&of(a), &of(b)));
        halves.indices.extend([a, middle, c, middle, b, c]);
    }
    halves
}

/// The corners, turned so that the longest edge lies between the first two.
fn longest_edge_first(mesh: &Mesh, [a, b, c]: [u32; 3]) -> [u32; 3] {
    let at = |index: u32| Vec3::from(mesh.vertices[index as usize].position_m);
    let length = |from: u32, to: u32| at(from).distance_squared(at(to));
    let (ab, bc, ca) = (length(a, b), length(b, c), length(c, a));
    if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

fn between(a: &Vertex, b: &Vertex) -> Vertex {
    fn mean<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
    }
    let unit =
        |v: [f32; 3], other: [f32; 3]| Vec3::from(v).normalize_or(Vec3::from(other)).to_array();
    let tangent = mean(a.tangent, b.tangent);
    let along = unit(
        [tangent[0], tangent[1], tangent[2]],
        [a.tangent[0], a.tangent[1], a.tangent[2]],
    );
    Vertex {
        position_m: mean(a.position_m, b.position_m),
        normal: unit(mean(a.normal, b.normal), a.normal),
        tangent: [along[0], along[1], along[2], a.tangent[3]],
        uv: mean(a.uv, b.uv),
        color: mean(a.color, b.color),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::procedural;

    fn area_m2(geometry: &Geometry) -> f64 {
        let of = |mesh: &Mesh| -> f64 {
            let corner =
                |index: u32| Vec3::from(mesh.vertices[index as usize].position_m).as_dvec3();
            let triangles = mesh.indices.as_chunks::<3>().0.iter();
            triangles
                .map(|&[a, b, c]| {
                    let [a, b, c] = [a, b, c].map(corner);
                    0.5 * (b - a).cross(c - a).length()
                })
                .sum()
        };
        geometry.meshes.iter().map(of).sum()
    }

    #[test]
    fn twice_the_triangles_are_the_same_surface() {
        let shapes = procedural::GENERATORS
            .iter()
            .find(|generator| generator.name == "shapes");
        let once = (shapes.unwrap().generate)(1);
        let twice = once.of_twice_the_triangles();
        assert_eq!(twice.triangles(), 2 * once.triangles());
        assert_eq!(twice.bounds_m(), once.bounds_m());
        assert!((area_m2(&twice) / area_m2(&once) - 1.0).abs() < 1e-5);
        let normals = twice.meshes.iter().flat_map(|mesh| &mesh.vertices);
        assert!(
            normals
                .into_iter()
                .all(|v| (Vec3::from(v.normal).length() - 1.0).abs() < 1e-4)
        );
    }
}
