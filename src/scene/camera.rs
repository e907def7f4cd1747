//! A pinhole camera.

use glam::{Mat4, Vec3};

/// Where the picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Eye, metres.
    pub position_m: Vec3,
    /// The point in the middle of the picture, metres.
    pub target_m: Vec3,
    /// Vertical field of view, radians.
    pub vertical_fov_rad: f32,
    /// Nearest visible depth, metres.
    pub near_m: f32,
    /// Farthest visible depth, metres; a pixel without a surface has this depth.
    pub far_m: f32,
}

impl Camera {
    /// World to view space. The up direction is +Y, or +Z for a camera that looks
    /// straight up or down.
    #[must_use]
    pub fn view(&self) -> Mat4 {
        let forward = (self.target_m - self.position_m).normalize_or(Vec3::NEG_Z);
        let up = if forward.y.abs() > 0.9999 {
            Vec3::Z
        } else {
            Vec3::Y
        };
        glam::camera::rh::view::look_to_mat4(self.position_m, forward, up)
    }

    /// View to clip space with reversed depth (1 at `near_m`, 0 at `far_m`), which
    /// spreads the precision of a float depth buffer evenly.
    #[must_use]
    pub fn projection(&self, aspect: f32) -> Mat4 {
        glam::camera::rh::proj::directx::perspective(
            self.vertical_fov_rad,
            aspect,
            self.far_m,
            self.near_m,
        )
    }

    /// Half the width and height of the picture at depth 1 m, metres.
    #[must_use]
    pub fn half_extent_at_1m(&self, aspect: f32) -> (f32, f32) {
        let half_height = (self.vertical_fov_rad * 0.5).tan();
        (half_height * aspect, half_height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            position_m: Vec3::new(1.0, 2.0, 3.0),
            target_m: Vec3::new(1.0, 2.0, -7.0),
            vertical_fov_rad: 1.0,
            near_m: 0.1,
            far_m: 50.0,
        }
    }

    #[test]
    fn the_target_lies_ahead() {
        let seen = camera().view().transform_point3(camera().target_m);
        assert!(
            (seen - Vec3::new(0.0, 0.0, -10.0)).length() < 1e-5,
            "{seen}"
        );
    }

    #[test]
    fn depth_is_one_at_near_and_zero_at_far() {
        let projection = camera().projection(1.5);
        let depth = |z_m: f32| projection.project_point3(Vec3::new(0.0, 0.0, -z_m)).z;
        assert!((depth(0.1) - 1.0).abs() < 1e-5);
        assert!(depth(50.0).abs() < 1e-5);
    }

    #[test]
    fn the_half_extent_meets_the_picture_edge() {
        let camera = camera();
        let (x, y) = camera.half_extent_at_1m(1.5);
        let corner = camera.projection(1.5).project_point3(Vec3::new(x, y, -1.0));
        assert!((corner.truncate() - glam::Vec2::ONE).length() < 1e-5);
    }

    #[test]
    fn looking_straight_down_is_finite() {
        let mut camera = camera();
        camera.target_m = camera.position_m - Vec3::Y;
        assert!(camera.view().is_finite());
    }
}
