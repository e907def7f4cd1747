//! Signed distances of simple bodies, metres, negative inside; and the smooth
//! unions that join them (Quilez, "Distance functions" and "Smooth minimum").

use glam::{Vec2, Vec3};

/// A body in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// An ellipsoid with these half axes. The distance is a close bound, exact on the surface.
    Ellipsoid {
        /// Half axes.
        radii_m: Vec3,
    },
    /// Two spheres and the cone round both: the first at the origin, the second up the y axis.
    RoundCone {
        /// Distance of the spheres' centres.
        length_m: f32,
        /// Radius at the origin.
        start_radius_m: f32,
        /// Radius at the far end.
        end_radius_m: f32,
    },
    /// A box with rounded edges.
    Block {
        /// Half its size, rounding included.
        half_m: Vec3,
        /// Radius of the edges.
        round_m: f32,
    },
    /// A ring round the y axis.
    Torus {
        /// From the axis to the middle of the ring.
        major_m: f32,
        /// Radius of the ring itself.
        minor_m: f32,
    },
}

impl Shape {
    /// Signed distance of `p` (metres, this body's frame).
    #[must_use]
    pub fn distance_m(&self, p: Vec3) -> f32 {
        match *self {
            Self::Ellipsoid { radii_m } => {
                let scaled = (p / radii_m).length();
                let slope = (p / (radii_m * radii_m)).length();
                if slope < 1e-9 {
                    return -radii_m.min_element();
                }
                scaled * (scaled - 1.0) / slope
            }
            Self::RoundCone {
                length_m,
                start_radius_m,
                end_radius_m,
            } => round_cone(p, length_m, start_radius_m, end_radius_m),
            Self::Block { half_m, round_m } => {
                let q = p.abs() - half_m + Vec3::splat(round_m);
                q.max(Vec3::ZERO).length() + q.max_element().min(0.0) - round_m
            }
            Self::Torus { major_m, minor_m } => {
                let ring = Vec2::new(p.x, p.z).length() - major_m;
                Vec2::new(ring, p.y).length() - minor_m
            }
        }
    }

    /// Centre (this body's frame) and radius of a sphere round the body, metres.
    #[must_use]
    pub fn bounding_sphere_m(&self) -> (Vec3, f32) {
        match *self {
            Self::Ellipsoid { radii_m } => (Vec3::ZERO, radii_m.max_element()),
            Self::RoundCone {
                length_m,
                start_radius_m,
                end_radius_m,
            } => (
                Vec3::Y * (0.5 * length_m),
                0.5 * length_m + start_radius_m.max(end_radius_m),
            ),
            Self::Block { half_m, .. } => (Vec3::ZERO, half_m.length()),
            Self::Torus { major_m, minor_m } => (Vec3::ZERO, major_m + minor_m),
        }
    }
}

fn round_cone(p: Vec3, length: f32, start: f32, end: f32) -> f32 {
    let q = Vec2::new(Vec2::new(p.x, p.z).length(), p.y);
    if length <= (start - end).abs() {
        // One sphere holds the other.
        return if start > end {
            q.length() - start
        } else {
            (q - Vec2::new(0.0, length)).length() - end
        };
    }
    let sine = (start - end) / length;
    let cosine = (1.0 - sine * sine).sqrt();
    let along = q.y * cosine - q.x * sine;
    if along < 0.0 {
        q.length() - start
    } else if along > cosine * length {
        (q - Vec2::new(0.0, length)).length() - end
    } else {
        q.x * cosine + q.y * sine - start
    }
}

/// Union of two distances that melts together where they are within `blend_m`;
/// equal to `min` where they are further apart.
#[must_use]
pub fn smooth_union(a_m: f32, b_m: f32, blend_m: f32) -> f32 {
    if blend_m <= 0.0 {
        return a_m.min(b_m);
    }
    let near = (blend_m - (a_m - b_m).abs()).max(0.0) / blend_m;
    a_m.min(b_m) - near * near * blend_m * 0.25
}

/// `a` with `b` carved out of it, the rim rounded over `blend_m`.
#[must_use]
pub fn smooth_carve(a_m: f32, b_m: f32, blend_m: f32) -> f32 {
    -smooth_union(-a_m, b_m, blend_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shapes() -> [Shape; 4] {
        [
            Shape::Ellipsoid {
                radii_m: Vec3::splat(0.5),
            },
            Shape::RoundCone {
                length_m: 1.0,
                start_radius_m: 0.4,
                end_radius_m: 0.1,
            },
            Shape::Block {
                half_m: Vec3::new(0.3, 0.4, 0.5),
                round_m: 0.1,
            },
            Shape::Torus {
                major_m: 0.6,
                minor_m: 0.2,
            },
        ]
    }

    #[test]
    fn known_points() {
        let [ball, cone, block, ring] = shapes();
        let d = |s: Shape, x, y, z| s.distance_m(Vec3::new(x, y, z));
        assert!((d(ball, 0.0, 1.5, 0.0) - 1.0).abs() < 1e-6);
        assert!((d(cone, 0.0, 1.3, 0.0) - 0.2).abs() < 1e-6);
        assert!((d(cone, 0.0, -1.0, 0.0) - 0.6).abs() < 1e-6);
        assert!((d(block, 1.3, 0.0, 0.0) - 1.0).abs() < 1e-6);
        assert!((d(ring, 0.6, 0.5, 0.0) - 0.3).abs() < 1e-6);
    }

    proptest! {
        /// A signed distance changes by at most the way walked, and is positive outside
        /// the bounding sphere.
        #[test]
        fn distances_are_distances(
            p in prop::array::uniform3(-2.0_f32..2.0),
            q in prop::array::uniform3(-2.0_f32..2.0),
        ) {
            let (p, q) = (Vec3::from(p), Vec3::from(q));
            for shape in shapes() {
                let change = (shape.distance_m(p) - shape.distance_m(q)).abs();
                prop_assert!(change <= p.distance(q) + 1e-5, "{shape:?}");
                let (centre, radius) = shape.bounding_sphere_m();
                if p.distance(centre) > radius + 1e-4 {
                    prop_assert!(shape.distance_m(p) > 0.0, "{shape:?}");
                }
            }
        }

        #[test]
        fn a_union_only_adds_and_only_near(a in -1.0_f32..1.0, b in -1.0_f32..1.0, k in 0.0_f32..0.5) {
            let union = smooth_union(a, b, k);
            prop_assert!(union <= a.min(b) + 1e-6);
            prop_assert!(union >= a.min(b) - 0.25 * k - 1e-6);
            if (a - b).abs() >= k {
                prop_assert_eq!(union, a.min(b));
            }
        }
    }
}
