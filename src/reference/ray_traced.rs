//! Rays through the scene's triangles, from the points that a picture shows.

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::bvh::{Hit, SceneBvh};
use super::occlusion::Surroundings;
use crate::scene::VisibleSurfaces;

/// A point of a surface, as far as rays from it need to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// World-space position, metres.
    pub position_m: Vec3,
    /// Unit normal that directions are weighted by.
    pub normal: Vec3,
    /// Unit normal of the surface itself, on the side the rays start from.
    pub geometric_normal: Vec3,
    /// How far the position may lie from the surface, metres: rays start this far above it.
    pub error_m: f32,
    /// The triangle's number in the geometry, as in [`Hit::triangle`]; `None` where none was found.
    pub triangle: Option<u32>,
}

/// Rounding of a position and of a ray's meeting with the triangle it lies on: both grow with
/// the position's coordinates and with the triangle (16 units in the last place of the larger).
const ROUNDING: f32 = 16.0 * f32::EPSILON / 2.0;

/// How far corners may be drawn from where they are, in pixels: the grid of 1/16 pixel that the
/// renderer puts them on, and the adapter's own cut-off.
const DRAWN_WITHIN_PX: f64 = 1.0 / 16.0;

/// Cosine of the angle up to which a triangle's normal may be the one that was drawn, which is smooth over
/// its edges.
const SAME_TRIANGLE: f32 = 0.9;

/// Where the surface of a place is looked for: there, and all round.
const BESIDE: [(f64, f64); 9] = [
    (0.0, 0.0),
    (1.0, 0.0),
    (-1.0, 0.0),
    (0.0, 1.0),
    (0.0, -1.0),
    (1.0, 1.0),
    (1.0, -1.0),
    (-1.0, 1.0),
    (-1.0, -1.0),
];

impl SurfacePoint {
    /// The point where a ray from `eye_m` first meets a triangle between `near` and `far`
    /// lengths of `direction`, with the triangle's normal towards the eye.
    #[must_use]
    pub fn first_met(
        bvh: &SceneBvh,
        eye_m: DVec3,
        direction: DVec3,
        near: f64,
        far: f64,
    ) -> Option<Self> {
        let from = eye_m + direction * near;
        let hit = bvh.nearest(from.as_vec3(), direction.as_vec3(), (far - near) as f32)?;
        Self::met(&hit, eye_m, direction, near, far)
    }

    /// The point where a ray from `eye_m` meets the triangle of a hit, in double precision; `None` for
    /// a triangle without a direction to face.
    #[must_use]
    pub(super) fn met(
        hit: &Hit,
        eye_m: DVec3,
        direction: DVec3,
        near: f64,
        far: f64,
    ) -> Option<Self> {
        let [a, b, c] = hit.corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).try_normalize()?;
        let normal = if normal.dot(direction) > 0.0 {
            -normal
        } else {
            normal
        };
        // The ray's meeting with the triangle's plane again, in double precision.
        let distance = normal.dot(a - eye_m) / normal.dot(direction);
        let distance = if distance.is_finite() {
            distance.clamp(near, far)
        } else {
            near
        };
        let position_m = (eye_m + direction * distance).as_vec3();
        let size_m = (b - a).length().max((c - a).length()) as f32;
        Some(Self {
            position_m,
            normal: normal.as_vec3(),
            geometric_normal: normal.as_vec3(),
            error_m: ROUNDING * (position_m.abs().max_element() + size_m),
            triangle: Some(hit.triangle),
        })
    }

    /// The point that a pixel shows; `None` where there is no surface.
    ///
    /// The renderer draws corners on a grid, so that a depth belongs to a surface up to 1/16
    /// of a pixel away, and stores the triangle's normal to a few degrees. So the triangle is
    /// looked up: the one that the pixel's ray meets first round the drawn depth. At an edge that ray may
    /// meet the triangle round the corner, or none; so the triangle is the one of the drawn
    /// normal, up to 1/16 pixel beside. Where there is none, the point stays where it was drawn.
    #[must_use]
    pub fn visible(bvh: &SceneBvh, surfaces: &VisibleSurfaces, pixel: usize) -> Option<Self> {
        if !surfaces.has_surface(pixel) {
            return None;
        }
        let projection = surfaces.projection();
        let depth_m = f64::from(surfaces.depth_m[pixel]);
        let eye_m = projection.world_point(pixel, 0.0);
        let place = projection.place_of(pixel);
        // In lengths of these directions, distance is depth.
        let towards = |place| {
            let ray = projection.ray_through(place);
            projection.world_from_view.transform_vector3(ray)
        };
        let direction = towards(place);
        let drawn_m = eye_m + direction * depth_m;
        let drawn_within_m = DRAWN_WITHIN_PX * projection.metres_per_px.max_element() * depth_m;
        let rounding_m = f64::from(ROUNDING) * (drawn_m.abs().max_element() + depth_m);
        let geometric_normal = surfaces.geometric_normals[pixel];
        let grazing = geometric_normal.as_dvec3().dot(direction).abs() / direction.length();
        // The stored normal is off by up to a few degrees.
        let window_m = 2.0 * (drawn_within_m + rounding_m) / (grazing - 0.05).max(0.02);
        let (near, far) = ((depth_m - window_m).max(0.0), depth_m + window_m);
        let drawn = Self {
            position_m: drawn_m.as_vec3(),
            normal: surfaces.normals[pixel],
            geometric_normal,
            error_m: (drawn_within_m + rounding_m) as f32,
            triangle: None,
        };
        let mut met: Option<Self> = None;
        for (x, y) in BESIDE {
            let beside = place + DRAWN_WITHIN_PX * DVec2::new(x, y);
            let found = Self::first_met(bvh, eye_m, towards(beside), near, far);
            let fits = |point: &Self| point.geometric_normal.dot(geometric_normal);
            met = [met, found]
                .into_iter()
                .flatten()
                .max_by(|a, b| fits(a).total_cmp(&fits(b)));
            if met.is_some_and(|met| fits(&met) > SAME_TRIANGLE) {
                break;
            }
        }
        Some(match met {
            Some(met) => Self {
                normal: drawn.normal,
                ..met
            },
            None => drawn,
        })
    }
}

/// The scene's triangles round a list of points.
#[derive(Debug)]
pub struct RayTraced<'a> {
    bvh: &'a SceneBvh,
    points: Vec<Option<SurfacePoint>>,
}

impl<'a> RayTraced<'a> {
    /// The surroundings of given points.
    #[must_use]
    pub fn new(bvh: &'a SceneBvh, points: Vec<Option<SurfacePoint>>) -> Self {
        Self { bvh, points }
    }

    /// The surroundings of the points that a picture shows.
    #[must_use]
    pub fn of_visible(bvh: &'a SceneBvh, surfaces: &VisibleSurfaces) -> Self {
        let points = (0..surfaces.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|pixel| SurfacePoint::visible(bvh, surfaces, pixel))
            .collect();
        Self::new(bvh, points)
    }

    /// The points; `None` where there is no surface.
    #[must_use]
    pub fn points(&self) -> &[Option<SurfacePoint>] {
        &self.points
    }

    /// What surrounds them.
    pub(super) fn bvh(&self) -> &SceneBvh {
        self.bvh
    }
}

/// The start of a point's rays.
#[derive(Debug, Clone, Copy)]
pub struct RayStart {
    origin_m: Vec3,
    geometric_normal: Vec3,
}

impl RayStart {
    /// A direction of the shading normal's hemisphere may point below the surface itself,
    /// which blocks it at once.
    fn is_under_surface(&self, direction: Vec3) -> bool {
        direction.dot(self.geometric_normal) <= 0.0
    }
}

impl Surroundings for RayTraced<'_> {
    type Start = RayStart;

    fn len(&self) -> usize {
        self.points.len()
    }

    fn start(&self, point: usize) -> Option<(RayStart, Vec3)> {
        let point = self.points[point].as_ref()?;
        let start = RayStart {
            origin_m: point.position_m + point.geometric_normal * point.error_m,
            geometric_normal: point.geometric_normal,
        };
        Some((start, point.normal))
    }

    #[inline]
    fn is_blocked(&self, start: &RayStart, direction: Vec3, reach_m: f32) -> bool {
        start.is_under_surface(direction) || self.bvh.is_blocked(start.origin_m, direction, reach_m)
    }

    fn nearest_m(&self, start: &RayStart, direction: Vec3, reach_m: f32) -> Option<f32> {
        if start.is_under_surface(direction) {
            return Some(0.0);
        }
        let hit = self.bvh.nearest(start.origin_m, direction, reach_m)?;
        Some(hit.distance)
    }
}
