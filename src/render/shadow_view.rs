//! How the directional light sees a scene.

use glam::{Mat4, Vec3};

use super::frame::SHADOW_SIZE_PX;

/// How a directional light sees the scene: an orthographic box round all of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShadowView {
    /// World to the light's clip space, depth 0 (near the light) to 1.
    pub from_world: Mat4,
    /// Side of a texel, metres.
    pub texel_m: f32,
    /// A hundredth of a texel's depth: what rounding may move a depth by.
    pub bias: f32,
}

impl ShadowView {
    /// A view along `towards` (unit, to the light) that holds the box `bounds_m`.
    pub(super) fn new(towards: Vec3, bounds_m: (Vec3, Vec3)) -> Self {
        let (low, high) = bounds_m;
        let centre = (low + high) / 2.0;
        let up = if towards.y.abs() > 0.99 {
            Vec3::X
        } else {
            Vec3::Y
        };
        let view = glam::camera::rh::view::look_to_mat4(centre, -towards, up);
        let (mut view_low, mut view_high) = (Vec3::MAX, Vec3::MIN);
        for corner in 0..8_u8 {
            let pick = |bit: u8, axis: usize| {
                if corner & bit == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            let seen = view.transform_point3(Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2)));
            view_low = view_low.min(seen);
            view_high = view_high.max(seen);
        }
        // A margin keeps the filter's taps on the map.
        let margin = (view_high - view_low).max_element().max(1e-3) * 0.005;
        view_low -= margin;
        view_high += margin;
        let projection = glam::camera::rh::proj::directx::orthographic(
            view_low.x,
            view_high.x,
            view_low.y,
            view_high.y,
            -view_high.z,
            -view_low.z,
        );
        let extent = view_high - view_low;
        let texel_m = extent.x.max(extent.y) / SHADOW_SIZE_PX as f32;
        Self {
            from_world: projection * view,
            texel_m,
            bias: 0.1 * texel_m / extent.z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shadow_view_holds_the_whole_box() {
        let bounds = (Vec3::new(-3.0, 0.0, -10.0), Vec3::new(5.0, 12.0, 7.0));
        for towards in [Vec3::Y, Vec3::new(0.5, 0.7, -0.3).normalize(), Vec3::X] {
            let view = ShadowView::new(towards, bounds);
            for corner in 0..8_u8 {
                let pick = |bit: u8, axis: usize| {
                    if corner & bit == 0 {
                        bounds.0[axis]
                    } else {
                        bounds.1[axis]
                    }
                };
                let clip =
                    view.from_world
                        .project_point3(Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2)));
                assert!(clip.x.abs() < 1.0 && clip.y.abs() < 1.0, "{clip}");
                assert!((0.0..=1.0).contains(&clip.z), "{clip}");
            }
        }
    }

    #[test]
    fn nearer_the_light_is_a_smaller_depth() {
        let view = ShadowView::new(Vec3::Y, (Vec3::ZERO, Vec3::splat(2.0)));
        let depth = |y: f32| view.from_world.project_point3(Vec3::new(1.0, y, 1.0)).z;
        assert!(depth(1.5) < depth(0.5));
    }
}
