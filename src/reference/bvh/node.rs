//! Eight boxes and four triangles at once: the two tests a ray spends its time in, written so
//! that the compiler makes vector instructions of them on any processor.

use glam::Vec3;

/// Children of a node.
pub(super) const CHILDREN: usize = 8;
/// Triangles of a leaf.
pub(super) const TRIANGLES: usize = 4;
/// Marks a child that is a leaf; the rest is its index.
pub(super) const LEAF: u32 = 1 << 31;

/// A ray in the form the tests want.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    inverse: [f32; 3],
    /// Which of a node's six planes a ray meets first along each axis, and which last.
    first: [usize; 3],
    last: [usize; 3],
}

impl Ray {
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        // A finite inverse: infinity times a distance of 0 would be no number.
        let inverse = direction.to_array().map(|component| {
            if component.abs() < 1e-18 {
                1e18_f32.copysign(component)
            } else {
                1.0 / component
            }
        });
        let plane = |axis: usize, far: bool| {
            if (inverse[axis] < 0.0) == far {
                axis
            } else {
                axis + 3
            }
        };
        Self {
            origin: origin.to_array(),
            direction: direction.to_array(),
            inverse,
            first: [0, 1, 2].map(|axis| plane(axis, false)),
            last: [0, 1, 2].map(|axis| plane(axis, true)),
        }
    }
}

/// The boxes of up to eight children: low x, y, z and high x, y, z of each. A place without a
/// child has a box that nothing hits.
#[repr(C, align(32))]
#[derive(Debug, Clone)]
pub(super) struct Node {
    planes: [[f32; CHILDREN]; 6],
    /// Index of a node, or [`LEAF`] and the index of a leaf.
    pub child: [u32; CHILDREN],
}

impl Node {
    pub const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; CHILDREN],
            [f32::INFINITY; CHILDREN],
            [f32::INFINITY; CHILDREN],
            [f32::NEG_INFINITY; CHILDREN],
            [f32::NEG_INFINITY; CHILDREN],
            [f32::NEG_INFINITY; CHILDREN],
        ],
        child: [0; CHILDREN],
    };

    pub fn set(&mut self, place: usize, (low, high): (Vec3, Vec3), child: u32) {
        for axis in 0..3 {
            self.planes[axis][place] = low[axis];
            self.planes[axis + 3][place] = high[axis];
        }
        self.child[place] = child;
    }

    /// Which children's boxes a ray meets between 0 and `reach`, a bit each, and where it
    /// enters each.
    #[inline(always)]
    pub fn hits(&self, ray: &Ray, reach: f32) -> (u32, [f32; CHILDREN]) {
        // The farther plane's distance is rounded up: two roundings, with room (Ize 2013).
        const UP: f32 = 1.0 + 4.0 * f32::EPSILON;
        let mut enter = [0.0_f32; CHILDREN];
        let mut leave = [reach; CHILDREN];
        for axis in 0..3 {
            let (first, last) = (&self.planes[ray.first[axis]], &self.planes[ray.last[axis]]);
            let (origin, inverse) = (ray.origin[axis], ray.inverse[axis]);
            for i in 0..CHILDREN {
                let near = (first[i] - origin) * inverse;
                let far = (last[i] - origin) * inverse;
                enter[i] = if near > enter[i] { near } else { enter[i] };
                leave[i] = if far < leave[i] { far } else { leave[i] };
            }
        }
        let mut mask = 0;
        for i in 0..CHILDREN {
            mask |= u32::from(enter[i] <= leave[i] * UP) << i;
        }
        (mask, enter)
    }
}

/// Up to four triangles: corner 0 (v0), edges v0 − v1 and v2 − v0, and their cross product, x,
/// y, z of each. A place without a triangle is one without an area.
#[repr(C, align(16))]
#[derive(Debug, Clone)]
pub(super) struct Leaf {
    numbers: [[f32; TRIANGLES]; 12],
    /// What the geometry calls each triangle.
    pub triangle: [u32; TRIANGLES],
}

/// Where a ray meets the triangles of a leaf. All but the mask is to be divided by
/// `determinant`.
pub(super) struct LeafHits {
    /// Which triangles are hit, a bit each.
    pub mask: u32,
    pub determinant: [f32; TRIANGLES],
    pub distance: [f32; TRIANGLES],
    /// Weights of corners 1 and 2.
    pub weights: [[f32; TRIANGLES]; 2],
}

impl Leaf {
    pub const EMPTY: Self = Self {
        numbers: [[0.0; TRIANGLES]; 12],
        triangle: [0; TRIANGLES],
    };

    pub fn set(&mut self, place: usize, corners: [Vec3; 3], triangle: u32) {
        let (edge_1, edge_2) = (corners[0] - corners[1], corners[2] - corners[0]);
        let normal = edge_1.cross(edge_2);
        for axis in 0..3 {
            for (kind, vector) in [corners[0], edge_1, edge_2, normal].iter().enumerate() {
                self.numbers[3 * kind + axis][place] = vector[axis];
            }
        }
        self.triangle[place] = triangle;
    }

    /// The corners of a triangle, metres; the second and third to a rounding.
    pub fn corners(&self, place: usize) -> [Vec3; 3] {
        let [corner, edge_1, edge_2] =
            [0, 3, 6].map(|at| Vec3::from([0, 1, 2].map(|axis| self.numbers[at + axis][place])));
        [corner, corner - edge_1, corner + edge_2]
    }

    /// Möller & Trumbore 1997, from both sides, between 0 (without it) and `reach`.
    #[inline(always)]
    pub fn hits(&self, ray: &Ray, reach: f32) -> LeafHits {
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin, ray.direction);
        let [px, py, pz, ax, ay, az, bx, by, bz, nx, ny, nz] = &self.numbers;
        let mut hits = LeafHits {
            mask: 0,
            determinant: [0.0; TRIANGLES],
            distance: [0.0; TRIANGLES],
            weights: [[0.0; TRIANGLES]; 2],
        };
        for i in 0..TRIANGLES {
            let (cx, cy, cz) = (px[i] - ox, py[i] - oy, pz[i] - oz);
            let (rx, ry, rz) = (dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx);
            let determinant = nx[i] * dx + ny[i] * dy + nz[i] * dz;
            // The determinant's sign, taken from everything: comparisons without a division.
            let sign = determinant.to_bits() & (1 << 31);
            let signed = |x: f32| f32::from_bits(x.to_bits() ^ sign);
            let determinant = signed(determinant);
            let weight_1 = signed(rx * bx[i] + ry * by[i] + rz * bz[i]);
            let weight_2 = signed(rx * ax[i] + ry * ay[i] + rz * az[i]);
            let distance = signed(nx[i] * cx + ny[i] * cy + nz[i] * cz);
            let inside = (weight_1 >= 0.0)
                & (weight_2 >= 0.0)
                & (weight_1 + weight_2 <= determinant)
                & (determinant > 0.0);
            let within = (distance > 0.0) & (distance <= determinant * reach);
            hits.mask |= u32::from(inside & within) << i;
            hits.determinant[i] = determinant;
            hits.distance[i] = distance;
            hits.weights[0][i] = weight_1;
            hits.weights[1][i] = weight_2;
        }
        hits
    }
}
