//! A scene's triangles, ready for rays.

mod build;
mod cutout;
mod node;
mod tree;

use glam::{Vec2, Vec3};

pub(super) use self::cutout::texel;
use self::cutout::{Cutouts, vertex_alpha};
use self::node::Ray;
use self::tree::Tree;
use crate::scene::Geometry;

/// Marks the name of a triangle that may let rays through; the rest is its number there.
const CUTOUT: u32 = 1 << 31;

/// The triangles of a geometry as a tree of boxes, eight to a node. Both sides of a triangle
/// are there; cut-out materials let rays through where they are cut out.
#[derive(Debug)]
pub struct SceneBvh {
    tree: Tree,
    cutouts: Cutouts,
    triangles: usize,
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the ray, in lengths of its direction.
    pub distance: f32,
    /// The triangle's corners, metres.
    pub corners: [Vec3; 3],
    /// The triangle's number in the geometry: mesh after mesh, from 0.
    pub triangle: u32,
}

impl SceneBvh {
    /// Builds the tree. Triangles with a corner that is no number, or without an area, hide
    /// nothing and are left out.
    #[must_use]
    pub fn new(geometry: &Geometry) -> Self {
        let mut cutouts = Cutouts::of(geometry);
        let (mut corners, mut names, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        let mut number = 0_u32;
        for mesh in &geometry.meshes {
            let material = geometry.materials.get(mesh.material);
            let cut = material.filter(|material| material.alpha_cutoff.is_some());
            for triangle in mesh.indices.chunks_exact(3) {
                let here = number;
                number += 1;
                let vertices = [0, 1, 2].map(|k| &mesh.vertices[triangle[k] as usize]);
                let [a, b, c] = vertices.map(|vertex| Vec3::from(vertex.position_m));
                let area = (b - a).cross(c - a).length();
                if !area.is_finite() || area == 0.0 {
                    continue;
                }
                names.push(match cut {
                    Some(material) => {
                        let uv = vertices.map(|vertex| Vec2::from(vertex.uv));
                        let alpha = vertices.map(|vertex| vertex_alpha(vertex.color, material));
                        CUTOUT | cutouts.add(uv, alpha, mesh.material)
                    }
                    None => 0,
                });
                corners.push([a, b, c]);
                numbers.push(here);
            }
        }
        Self {
            tree: build::build(&corners, &names, &numbers),
            cutouts,
            triangles: corners.len(),
        }
    }

    /// Number of triangles in the tree.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.triangles
    }

    /// Whether anything stands between `origin_m` (without it) and `reach` lengths of
    /// `direction`.
    #[must_use]
    pub fn is_blocked(&self, origin_m: Vec3, direction: Vec3, reach: f32) -> bool {
        let ray = Ray::new(origin_m, direction);
        let is_solid = |triangle, weights| self.is_solid(triangle, weights);
        self.tree.walk::<true>(&ray, reach, &is_solid).is_some()
    }

    /// The first triangle between `origin_m` (without it) and `reach` lengths of `direction`.
    #[must_use]
    pub fn nearest(&self, origin_m: Vec3, direction: Vec3, reach: f32) -> Option<Hit> {
        let ray = Ray::new(origin_m, direction);
        let is_solid = |triangle, weights| self.is_solid(triangle, weights);
        let (distance, leaf, place) = self.tree.walk::<false>(&ray, reach, &is_solid)?;
        Some(Hit {
            distance,
            corners: self.tree.leaves[leaf as usize].corners(place),
            triangle: self.tree.numbers[leaf as usize][place],
        })
    }

    #[inline(always)]
    fn is_solid(&self, triangle: u32, weights: [f32; 2]) -> bool {
        triangle & CUTOUT == 0 || self.cutouts.is_solid(triangle & !CUTOUT, weights)
    }
}

#[cfg(test)]
mod tests;
