//! A scene's triangles, ready for rays.

mod build;
mod cutout;
mod node;

use std::cell::RefCell;

use glam::{Vec2, Vec3};

use self::build::Tree;
use self::cutout::{Cutouts, vertex_alpha};
use self::node::{LEAF, Leaf, Ray};
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
}

thread_local! {
    /// Children that wait while a ray goes through a tree, for trees deeper than usual.
    static DEEP: RefCell<Vec<(u32, f32)>> = const { RefCell::new(Vec::new()) };
}

impl SceneBvh {
    /// Builds the tree. Triangles with a corner that is no number, or without an area, hide
    /// nothing and are left out.
    #[must_use]
    pub fn new(geometry: &Geometry) -> Self {
        let mut cutouts = Cutouts::of(geometry);
        let (mut corners, mut names) = (Vec::new(), Vec::new());
        for mesh in &geometry.meshes {
            let material = geometry.materials.get(mesh.material);
            let cut = material.filter(|material| material.alpha_cutoff.is_some());
            for triangle in mesh.indices.chunks_exact(3) {
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
            }
        }
        Self {
            tree: build::build(&corners, &names),
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
        self.walk::<true>(&Ray::new(origin_m, direction), reach)
            .is_some()
    }

    /// The first triangle between `origin_m` (without it) and `reach` lengths of `direction`.
    #[must_use]
    pub fn nearest(&self, origin_m: Vec3, direction: Vec3, reach: f32) -> Option<Hit> {
        let (distance, leaf, place) = self.walk::<false>(&Ray::new(origin_m, direction), reach)?;
        let corners = self.tree.leaves[leaf as usize].corners(place);
        Some(Hit { distance, corners })
    }

    /// Goes through the tree: to any hit, or to the nearest. Gives its distance, leaf, and
    /// place in the leaf.
    #[inline]
    fn walk<const ANY: bool>(&self, ray: &Ray, reach: f32) -> Option<(f32, u32, usize)> {
        const USUAL: usize = 128;
        if self.tree.nodes.is_empty() {
            return None;
        }
        if self.tree.most_waiting <= USUAL {
            return self.walk_with::<ANY>(ray, reach, &mut [(0, 0.0); USUAL]);
        }
        DEEP.with_borrow_mut(|waiting| {
            waiting.resize(waiting.len().max(self.tree.most_waiting), (0, 0.0));
            self.walk_with::<ANY>(ray, reach, waiting)
        })
    }

    #[inline(always)]
    fn walk_with<const ANY: bool>(
        &self,
        ray: &Ray,
        mut reach: f32,
        waiting: &mut [(u32, f32)],
    ) -> Option<(f32, u32, usize)> {
        let mut found = None;
        // The root is node 0.
        let mut count = 1;
        waiting[0] = (0, 0.0);
        while count > 0 {
            count -= 1;
            let (child, entered) = waiting[count];
            if !ANY && entered > reach {
                continue;
            }
            if child & LEAF != 0 {
                let leaf = &self.tree.leaves[(child & !LEAF) as usize];
                if let Some((distance, place)) = self.hit_in(leaf, ray, reach) {
                    found = Some((distance, child & !LEAF, place));
                    reach = distance;
                    if ANY {
                        return found;
                    }
                }
                continue;
            }
            let node = &self.tree.nodes[child as usize];
            let (mut mask, enter) = node.hits(ray, reach);
            let first = count;
            while mask != 0 {
                let place = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                let entry = (node.child[place], enter[place]);
                let mut at = count;
                // Nearest last, to be taken first.
                while !ANY && at > first && waiting[at - 1].1 < entry.1 {
                    waiting[at] = waiting[at - 1];
                    at -= 1;
                }
                waiting[at] = entry;
                count += 1;
            }
        }
        found
    }

    /// The nearest solid hit in a leaf, with its place.
    #[inline(always)]
    fn hit_in(&self, leaf: &Leaf, ray: &Ray, reach: f32) -> Option<(f32, usize)> {
        let hits = leaf.hits(ray, reach);
        let mut mask = hits.mask;
        let mut nearest: Option<(f32, usize)> = None;
        while mask != 0 {
            let place = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let scale = 1.0 / hits.determinant[place];
            let distance = hits.distance[place] * scale;
            let triangle = leaf.triangle[place];
            let is_nearer = nearest.is_none_or(|(known, _)| distance < known);
            let is_solid = || {
                let weights = hits.weights.map(|weight| weight[place] * scale);
                triangle & CUTOUT == 0 || self.cutouts.is_solid(triangle & !CUTOUT, weights)
            };
            if is_nearer && is_solid() {
                nearest = Some((distance, place));
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests;
