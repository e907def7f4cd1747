//! How the directional light sees what the camera sees.

use glam::{Mat4, Vec2, Vec3};

use super::frame::SHADOW_SIZE_PX;
use crate::scene::Camera;

/// Tangent of the sun's angular radius, 0.266°: a penumbra is this many metres wide to each
/// side for every metre between the edge that casts it and the surface.
pub(super) const SUN_RADIUS: f32 = 0.004_65;

/// Texels beyond what is seen, for the filter's taps.
const MARGIN_PX: f32 = 8.0;

/// How a directional light sees a scene: an orthographic box as narrow as what the camera sees of
/// the scene, and as deep as the scene, so that whatever casts a shadow into the picture is in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShadowView {
    /// World to the light's clip space, depth 0 (near the light) to 1.
    pub from_world: Mat4,
    /// Unit vectors to the map's right and up.
    pub right: Vec3,
    pub up: Vec3,
    /// Texture coordinates a metre to the right and up.
    pub uv_per_m: Vec2,
    /// Depth a metre away from the light.
    pub depth_per_m: f32,
    /// The longer side of a texel, metres.
    pub texel_m: f32,
}

impl ShadowView {
    /// A view along `towards` (unit, to the light) of what `camera` sees, at `aspect` (width over
    /// height), of the box `bounds_m`.
    pub(super) fn new(towards: Vec3, bounds_m: (Vec3, Vec3), camera: &Camera, aspect: f32) -> Self {
        let corners = box_corners(bounds_m);
        let centre = (bounds_m.0 + bounds_m.1) / 2.0;
        let up = if towards.y.abs() > 0.99 {
            Vec3::X
        } else {
            Vec3::Y
        };
        let view = glam::camera::rh::view::look_to_mat4(centre, -towards, up);
        let (scene_low, scene_high) = extent(&corners.map(|corner| view.transform_point3(corner)));
        let seen = seen_corners(camera, aspect, &corners);
        let (seen_low, seen_high) = extent(&seen.map(|corner| view.transform_point3(corner)));
        let (mut low, mut high) = (scene_low.max(seen_low), scene_high.min(seen_high));
        if low.x >= high.x || low.y >= high.y {
            // The camera sees none of the scene: any view will do.
            (low, high) = (scene_low, scene_high);
        }
        (low.z, high.z) = (scene_low.z, scene_high.z);
        let depth_m = (high.z - low.z).max(1e-3);
        // A flat scene seen edge on has no width: it is given some.
        let size_m = (high - low).max(Vec3::splat(1e-3));
        let margin_m = size_m * (MARGIN_PX / SHADOW_SIZE_PX as f32) + depth_m * SUN_RADIUS;
        low -= Vec3::new(margin_m.x, margin_m.y, 0.01 * depth_m);
        high += Vec3::new(margin_m.x, margin_m.y, 0.01 * depth_m);
        let projection = glam::camera::rh::proj::directx::orthographic(
            low.x, high.x, low.y, high.y, -high.z, -low.z,
        );
        let size_m = high - low;
        let rows = view.transpose();
        Self {
            from_world: projection * view,
            right: rows.x_axis.truncate(),
            up: rows.y_axis.truncate(),
            uv_per_m: 1.0 / size_m.truncate(),
            depth_per_m: 1.0 / size_m.z,
            texel_m: size_m.x.max(size_m.y) / SHADOW_SIZE_PX as f32,
        }
    }
}

fn box_corners((low, high): (Vec3, Vec3)) -> [Vec3; 8] {
    std::array::from_fn(|corner| {
        let pick = |axis: usize| {
            if corner & (1 << axis) == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        Vec3::new(pick(0), pick(1), pick(2))
    })
}

/// Corners of the camera's view, cut off where the farthest of `corners` lies.
fn seen_corners(camera: &Camera, aspect: f32, corners: &[Vec3; 8]) -> [Vec3; 8] {
    let view = camera.view();
    let deepest = corners
        .iter()
        .map(|corner| -view.transform_point3(*corner).z)
        .fold(camera.near_m, f32::max);
    let to_world = view.inverse();
    let half_extent = Vec2::from(camera.half_extent_at_1m(aspect));
    std::array::from_fn(|corner| {
        let side = |bit: usize| if corner & bit == 0 { -1.0 } else { 1.0 };
        let depth_m = if corner & 4 == 0 {
            camera.near_m
        } else {
            deepest.min(camera.far_m)
        };
        let across = half_extent * Vec2::new(side(1), side(2)) * depth_m;
        to_world.transform_point3(across.extend(-depth_m))
    })
}

fn extent(points: &[Vec3; 8]) -> (Vec3, Vec3) {
    points
        .iter()
        .fold((Vec3::MAX, Vec3::MIN), |(low, high), point| {
            (low.min(*point), high.max(*point))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const BOUNDS: (Vec3, Vec3) = (Vec3::new(-30.0, 0.0, -40.0), Vec3::new(50.0, 12.0, 37.0));

    fn camera() -> Camera {
        Camera {
            position_m: Vec3::new(0.0, 1.5, 4.0),
            target_m: Vec3::new(0.0, 0.8, 0.0),
            vertical_fov_rad: 0.5,
            near_m: 0.1,
            far_m: 20.0,
        }
    }

    fn of(towards: Vec3) -> ShadowView {
        ShadowView::new(towards, BOUNDS, &camera(), 1.5)
    }

    #[test]
    fn nearer_the_light_is_a_smaller_depth() {
        let view = of(Vec3::Y);
        let depth = |y: f32| view.from_world.project_point3(Vec3::new(0.0, y, 0.0)).z;
        assert!(depth(1.5) < depth(0.5));
        assert!(((depth(0.5) - depth(1.5)) - view.depth_per_m).abs() < 1e-5);
    }

    /// A camera that sees a small part of a large scene gets the map's texels for that part.
    #[test]
    fn the_map_is_spent_on_what_is_seen() {
        let whole_m = 80.0_f32.hypot(77.0);
        assert!(of(Vec3::Y).texel_m < 0.5 * whole_m / SHADOW_SIZE_PX as f32);
    }

    proptest! {
        /// Every point of the scene that the camera sees lies on the map, and so does whatever lies
        /// between it and the light.
        #[test]
        fn what_is_seen_and_what_shades_it_are_on_the_map(
            x in -1.0_f32..1.0, y in -1.0_f32..1.0, depth in 0.0_f32..1.0,
            sun_x in -1.0_f32..1.0, sun_z in -1.0_f32..1.0, sun_y in 0.05_f32..1.0,
            along in 0.0_f32..1.0,
        ) {
            let camera = camera();
            let towards = Vec3::new(sun_x, sun_y, sun_z).normalize();
            let view = of(towards);
            let depth_m = camera.near_m + depth * (camera.far_m - camera.near_m);
            let across = Vec2::from(camera.half_extent_at_1m(1.5)) * Vec2::new(x, y) * depth_m;
            let point = camera.view().inverse().transform_point3(across.extend(-depth_m));
            let is_inside = |p: Vec3| p.cmpge(BOUNDS.0).all() && p.cmple(BOUNDS.1).all();
            prop_assume!(is_inside(point));
            let caster = point + towards * along * 60.0;
            for point in [point, caster].into_iter().filter(|p| is_inside(*p)) {
                let clip = view.from_world.project_point3(point);
                prop_assert!(clip.x.abs() < 1.0 && clip.y.abs() < 1.0, "{}", clip);
                prop_assert!((0.0..=1.0).contains(&clip.z), "{}", clip);
            }
        }

        /// The numbers given beside the matrix are the matrix's.
        #[test]
        fn scales_and_axes_belong_to_the_matrix(
            sun_x in -1.0_f32..1.0, sun_z in -1.0_f32..1.0, sun_y in 0.05_f32..1.0,
        ) {
            let towards = Vec3::new(sun_x, sun_y, sun_z).normalize();
            let view = of(towards);
            for (step, expected) in [
                (view.right, Vec3::new(2.0 * view.uv_per_m.x, 0.0, 0.0)),
                (view.up, Vec3::new(0.0, 2.0 * view.uv_per_m.y, 0.0)),
                (-towards, Vec3::new(0.0, 0.0, view.depth_per_m)),
            ] {
                let found = view.from_world.transform_vector3(step);
                prop_assert!((found - expected).length() < 1e-4 * expected.length() + 1e-6);
            }
        }
    }
}
