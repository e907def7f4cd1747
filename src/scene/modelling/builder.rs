//! A mesh under construction: corners with texture coordinates in metres, so that
//! a brick is as large on a column as on a wall.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::math::{Frame, perpendicular};
use crate::scene::geometry::{Mesh, Vertex};

/// Collects the triangles of one material.
#[derive(Debug, Clone)]
pub struct MeshBuilder {
    positions_m: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs_m: Vec<Vec2>,
    colors: Vec<Vec3>,
    indices: Vec<u32>,
    tint: Vec3,
}

impl Default for MeshBuilder {
    fn default() -> Self {
        Self {
            positions_m: Vec::new(),
            normals: Vec::new(),
            uvs_m: Vec::new(),
            colors: Vec::new(),
            indices: Vec::new(),
            tint: Vec3::ONE,
        }
    }
}

/// Texture coordinates, metres, of a point on a surface that mostly faces one axis:
/// u to the right and v downwards for an onlooker in front of it.
#[must_use]
pub fn box_uv_m(position_m: Vec3, normal: Vec3) -> Vec2 {
    let (p, n) = (position_m, normal.abs());
    if n.y >= n.x && n.y >= n.z {
        Vec2::new(p.x, p.z * normal.y.signum())
    } else if n.x >= n.z {
        Vec2::new(-p.z * normal.x.signum(), -p.y)
    } else {
        Vec2::new(p.x * normal.z.signum(), -p.y)
    }
}

impl MeshBuilder {
    /// An empty mesh.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Linear colour of the corners pushed from now on.
    pub fn tint(&mut self, color: Vec3) {
        self.tint = color;
    }

    /// Number of triangles so far.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.indices.len() / 3
    }

    /// Adds a corner and gives its index. The normal need not be unit length.
    pub fn corner(&mut self, position_m: Vec3, normal: Vec3, uv_m: Vec2) -> u32 {
        let index = self.next_corner();
        self.positions_m.push(position_m);
        self.normals.push(normal.normalize_or(Vec3::Y));
        self.uvs_m.push(uv_m);
        self.colors.push(self.tint);
        index
    }

    /// Adds a triangle, counter-clockwise from outside.
    pub fn triangle(&mut self, corners: [u32; 3]) {
        self.indices.extend(corners);
    }

    /// Adds a flat quadrilateral, counter-clockwise from outside, with box-projected
    /// texture coordinates.
    pub fn quad(&mut self, corners_m: [Vec3; 4]) {
        let [a, b, c, d] = corners_m;
        let normal = (c - a).cross(d - b).normalize_or(Vec3::Y);
        let [a, b, c, d] = corners_m.map(|p| self.corner(p, normal, box_uv_m(p, normal)));
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }

    /// Adds a flat quadrilateral like [`MeshBuilder::quad`], cut into pieces no larger
    /// than `step_m`, so that corner colours can vary over it.
    pub fn panel(&mut self, corners_m: [Vec3; 4], step_m: f32) {
        let [a, b, c, d] = corners_m;
        let normal = (c - a).cross(d - b).normalize_or(Vec3::Y);
        let pieces = |p: Vec3, q: Vec3| (p.distance(q) / step_m).ceil().max(1.0) as u32;
        let columns = pieces(a, b).max(pieces(d, c));
        let rows = pieces(b, c).max(pieces(a, d));
        self.sheet_with_normals(columns, rows, |s, t| {
            let p = a.lerp(b, s).lerp(d.lerp(c, s), t);
            (p, normal, box_uv_m(p, normal))
        });
    }

    /// Multiplies the colour of every corner by `color` of its position and normal.
    pub fn stain(&mut self, color: impl Fn(Vec3, Vec3) -> Vec3 + Sync) {
        let places = self.positions_m.par_iter().zip(&self.normals);
        self.colors
            .par_iter_mut()
            .zip(places)
            .for_each(|(corner, (&p, &n))| *corner *= color(p, n));
    }

    /// Adds a curved sheet of `columns` × `rows` quadrilaterals. `at(s, t)` gives
    /// the point and its texture coordinates (metres) for s, t in [0, 1]; the outside
    /// is where d/ds × d/dt points. Normals are differences of `at`, so it must be
    /// defined a little beyond [0, 1].
    pub fn sheet(&mut self, columns: u32, rows: u32, at: impl Fn(f32, f32) -> (Vec3, Vec2)) {
        const STEP: f32 = 1e-3;
        self.sheet_with_normals(columns, rows, |s, t| {
            let (position, uv) = at(s, t);
            let along_s = at(s + STEP, t).0 - at(s - STEP, t).0;
            let along_t = at(s, t + STEP).0 - at(s, t - STEP).0;
            (position, along_s.cross(along_t).normalize_or(Vec3::Y), uv)
        });
    }

    /// [`MeshBuilder::sheet`] where `at` also knows the normal.
    pub fn sheet_with_normals(
        &mut self,
        columns: u32,
        rows: u32,
        at: impl Fn(f32, f32) -> (Vec3, Vec3, Vec2),
    ) {
        let first = self.next_corner();
        for row in 0..=rows {
            for column in 0..=columns {
                let (s, t) = (column as f32 / columns as f32, row as f32 / rows as f32);
                let (position, normal, uv) = at(s, t);
                self.corner(position, normal, uv);
            }
        }
        let width = columns + 1;
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * width + column;
                self.triangle([a, a + 1, a + width + 1]);
                self.triangle([a, a + width + 1, a + width]);
            }
        }
    }

    fn next_corner(&self) -> u32 {
        u32::try_from(self.positions_m.len()).unwrap_or(u32::MAX)
    }

    /// Adds everything of `other`, placed in `frame`. Its colours are multiplied by
    /// the current tint.
    pub fn place(&mut self, other: &Self, frame: &Frame) {
        let first = self.next_corner();
        self.positions_m
            .extend(other.positions_m.iter().map(|&p| frame.point(p)));
        self.normals.extend(
            other
                .normals
                .iter()
                .map(|&n| frame.direction(n).normalize_or(Vec3::Y)),
        );
        self.uvs_m.extend(&other.uvs_m);
        let tint = self.tint;
        self.colors.extend(other.colors.iter().map(|&c| c * tint));
        self.indices.extend(other.indices.iter().map(|i| first + i));
    }

    /// Moves the texture coordinates of every corner, so that two placed copies do
    /// not show the same stain.
    pub fn shift_uv(&mut self, by_m: Vec2) {
        for uv in &mut self.uvs_m {
            *uv += by_m;
        }
    }

    /// The finished mesh. `tile_m` is how many metres one repeat of the material's
    /// textures covers.
    #[must_use]
    pub fn finish(self, name: &str, material: usize, tile_m: f32) -> Mesh {
        let tangents = self.tangents();
        let vertices = (0..self.positions_m.len())
            .map(|i| Vertex {
                position_m: self.positions_m[i].to_array(),
                normal: self.normals[i].to_array(),
                tangent: tangents[i],
                uv: (self.uvs_m[i] / tile_m).to_array(),
                color: self.colors[i].extend(1.0).to_array(),
            })
            .collect();
        Mesh {
            name: name.to_owned(),
            vertices,
            indices: self.indices,
            material,
        }
    }

    /// Tangents as glTF 2.0 wants them: along increasing u, with the handedness that
    /// lets the bitangent point up the texture (towards decreasing v, since v runs
    /// down the image), which is where a normal map's green points.
    fn tangents(&self) -> Vec<[f32; 4]> {
        let mut along_u = vec![Vec3::ZERO; self.positions_m.len()];
        let mut along_v = vec![Vec3::ZERO; self.positions_m.len()];
        for triangle in self.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| triangle[k] as usize);
            let (e1, e2) = (
                self.positions_m[b] - self.positions_m[a],
                self.positions_m[c] - self.positions_m[a],
            );
            let (d1, d2) = (self.uvs_m[b] - self.uvs_m[a], self.uvs_m[c] - self.uvs_m[a]);
            let determinant = d1.x * d2.y - d2.x * d1.y;
            if determinant.abs() < 1e-14 {
                continue;
            }
            // The sign alone: each triangle then counts by its area, not by 1/area.
            let sign = determinant.signum();
            for i in [a, b, c] {
                along_u[i] += (e1 * d2.y - e2 * d1.y) * sign;
                along_v[i] += (e2 * d1.x - e1 * d2.x) * sign;
            }
        }
        (0..self.positions_m.len())
            .map(|i| {
                let n = self.normals[i];
                let tangent = (along_u[i] - n * n.dot(along_u[i])).normalize_or_zero();
                if tangent == Vec3::ZERO {
                    return perpendicular(n).extend(1.0).to_array();
                }
                let up_the_texture = -along_v[i];
                let handedness = if n.cross(tangent).dot(up_the_texture) < 0.0 {
                    -1.0
                } else {
                    1.0
                };
                tangent.extend(handedness).to_array()
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall seen from +Z: u runs right, v runs down, so the tangent is +X and the
    /// bitangent w · (n × t) is +Y, up.
    #[test]
    fn tangents_follow_gltf() {
        let mut builder = MeshBuilder::new();
        builder.quad([
            Vec3::ZERO,
            Vec3::X,
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
        ]);
        let mesh = builder.finish("wall", 0, 2.0);
        for vertex in &mesh.vertices {
            assert_eq!(vertex.normal, [0.0, 0.0, 1.0]);
            assert_eq!(vertex.tangent, [1.0, 0.0, 0.0, 1.0]);
        }
        assert_eq!(mesh.vertices[2].uv, [0.5, -0.5]);
    }

    /// However a flat face is turned, the box projection gives a right-handed frame
    /// on it: no face shows its texture mirrored.
    #[test]
    fn box_projection_never_mirrors() {
        for n in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
            let a = perpendicular(n);
            let b = n.cross(a);
            let mut builder = MeshBuilder::new();
            builder.quad([Vec3::ZERO, a, a + b, b]);
            let mesh = builder.finish("face", 0, 1.0);
            assert_eq!(mesh.vertices[0].tangent[3], 1.0, "{n}");
        }
    }

    #[test]
    fn a_sheet_faces_where_its_derivatives_say() {
        let mut builder = MeshBuilder::new();
        builder.sheet(4, 3, |s, t| (Vec3::new(s, t, 0.0), Vec2::new(s, -t)));
        let mesh = builder.finish("sheet", 0, 1.0);
        assert_eq!(mesh.indices.len(), 4 * 3 * 6);
        for c in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.vertices[c[k] as usize].position_m));
            assert!((b - a).cross(c - a).z > 0.0);
        }
    }
}
