//! Eight boxes and four triangles at once: the two tests that a ray spends its time in.

use glam::Vec3;
use wide::{f32x4, f32x8};

/// Children of a node.
pub(super) const CHILDREN: usize = 8;
/// Triangles of a leaf.
pub(super) const TRIANGLES: usize = 4;
/// Marks a child that is a leaf; the rest is its index.
pub(super) const LEAF: u32 = 1 << 31;

/// A ray in the form the tests want.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
    inverse: [f32; 3],
    is_backward: [bool; 3],
}

impl Ray {
    #[inline(always)]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        // A finite inverse: infinity times a distance of 0 would be no number.
        let inverse = |component: f32| {
            if component.abs() < 1e-18 {
                1e18_f32.copysign(component)
            } else {
                1.0 / component
            }
        };
        let (x, y, z) = (direction.x, direction.y, direction.z);
        Self {
            origin: origin.to_array(),
            direction: direction.to_array(),
            inverse: [inverse(x), inverse(y), inverse(z)],
            is_backward: [
                x.is_sign_negative(),
                y.is_sign_negative(),
                z.is_sign_negative(),
            ],
        }
    }
}

/// The boxes of up to eight children. A place without a child has a box that nothing hits.
#[derive(Debug, Clone)]
pub(super) struct Node {
    /// x, y, z of each box' corners.
    low: [f32x8; 3],
    high: [f32x8; 3],
    /// Index of a node, or [`LEAF`] and the index of a leaf.
    pub child: [u32; CHILDREN],
}

impl Node {
    pub const EMPTY: Self = Self {
        low: [f32x8::new([f32::INFINITY; CHILDREN]); 3],
        high: [f32x8::new([f32::NEG_INFINITY; CHILDREN]); 3],
        child: [0; CHILDREN],
    };

    pub fn set(&mut self, place: usize, (low, high): (Vec3, Vec3), child: u32) {
        for axis in 0..3 {
            self.low[axis].as_mut_array()[place] = low[axis];
            self.high[axis].as_mut_array()[place] = high[axis];
        }
        self.child[place] = child;
    }

    /// Which children's boxes a ray meets between 0 and `reach`, a bit each, and where it
    /// enters each.
    #[inline(always)]
    pub fn hits(&self, ray: &Ray, reach: f32) -> (u32, f32x8) {
        // The farther plane's distance is rounded up: two roundings, with room (Ize 2013).
        const UP: f32 = 1.0 + 4.0 * f32::EPSILON;
        let mut enter = f32x8::ZERO;
        let mut leave = f32x8::splat(reach);
        for axis in 0..3 {
            let (low, high) = (&self.low[axis], &self.high[axis]);
            let (first, last) = if ray.is_backward[axis] {
                (high, low)
            } else {
                (low, high)
            };
            let origin = f32x8::splat(ray.origin[axis]);
            let inverse = f32x8::splat(ray.inverse[axis]);
            enter = ((*first - origin) * inverse).fast_max(enter);
            leave = ((*last - origin) * inverse).fast_min(leave);
        }
        let mask = enter.simd_le(leave * f32x8::splat(UP)).to_bitmask();
        (mask, enter)
    }
}

/// Up to four triangles: x, y, z of each one's corner 0 (v0), edges v0 − v1 and v2 − v0, and
/// their cross product. A place without a triangle is one without an area.
#[derive(Debug, Clone)]
pub(super) struct Leaf {
    corner: [f32x4; 3],
    edge_1: [f32x4; 3],
    edge_2: [f32x4; 3],
    normal: [f32x4; 3],
    /// What the geometry calls each triangle.
    pub triangle: [u32; TRIANGLES],
}

/// Where a ray meets the triangles of a leaf. All but the mask is to be divided by
/// `determinant`.
pub(super) struct LeafHits {
    /// Which triangles are hit, a bit each.
    pub mask: u32,
    pub determinant: f32x4,
    pub distance: f32x4,
    /// Weights of corners 1 and 2.
    pub weights: [f32x4; 2],
}

impl Leaf {
    pub const EMPTY: Self = Self {
        corner: [f32x4::ZERO; 3],
        edge_1: [f32x4::ZERO; 3],
        edge_2: [f32x4::ZERO; 3],
        normal: [f32x4::ZERO; 3],
        triangle: [0; TRIANGLES],
    };

    pub fn set(&mut self, place: usize, corners: [Vec3; 3], triangle: u32) {
        let (edge_1, edge_2) = (corners[0] - corners[1], corners[2] - corners[0]);
        let normal = edge_1.cross(edge_2);
        for axis in 0..3 {
            self.corner[axis].as_mut_array()[place] = corners[0][axis];
            self.edge_1[axis].as_mut_array()[place] = edge_1[axis];
            self.edge_2[axis].as_mut_array()[place] = edge_2[axis];
            self.normal[axis].as_mut_array()[place] = normal[axis];
        }
        self.triangle[place] = triangle;
    }

    /// The corners of a triangle, metres; the second and third to a rounding.
    pub fn corners(&self, place: usize) -> [Vec3; 3] {
        let [corner, edge_1, edge_2] = [&self.corner, &self.edge_1, &self.edge_2]
            .map(|xyz| Vec3::from([0, 1, 2].map(|axis| xyz[axis].as_array()[place])));
        [corner, corner - edge_1, corner + edge_2]
    }

    /// Möller & Trumbore 1997, from both sides, between 0 (without it) and `reach`.
    #[inline(always)]
    pub fn hits(&self, ray: &Ray, reach: f32) -> LeafHits {
        let ([ox, oy, oz], [dx, dy, dz]) = (splat(ray.origin), splat(ray.direction));
        let [px, py, pz] = self.corner;
        let (cx, cy, cz) = (px - ox, py - oy, pz - oz);
        let across = [dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx];
        let determinant = dot(&self.normal, &[dx, dy, dz]);
        // The determinant's sign, taken from everything: comparisons without a division.
        let sign = determinant & f32x4::splat(-0.0);
        let determinant = determinant ^ sign;
        let weights = [
            dot(&across, &self.edge_2) ^ sign,
            dot(&across, &self.edge_1) ^ sign,
        ];
        let distance = dot(&self.normal, &[cx, cy, cz]) ^ sign;
        let inside = weights[0].simd_ge(f32x4::ZERO)
            & weights[1].simd_ge(f32x4::ZERO)
            & (weights[0] + weights[1]).simd_le(determinant)
            & determinant.simd_gt(f32x4::ZERO);
        let within =
            distance.simd_gt(f32x4::ZERO) & distance.simd_le(determinant * f32x4::splat(reach));
        LeafHits {
            mask: (inside & within).to_bitmask(),
            determinant,
            distance,
            weights,
        }
    }
}

// Spelt out: the compiler does not inline an array's `map` here, and a ray takes twice as long.
#[inline(always)]
fn splat([x, y, z]: [f32; 3]) -> [f32x4; 3] {
    [f32x4::splat(x), f32x4::splat(y), f32x4::splat(z)]
}

#[inline(always)]
fn dot(a: &[f32x4; 3], b: &[f32x4; 3]) -> f32x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
