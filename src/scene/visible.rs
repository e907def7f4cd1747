//! What a camera sees, as plain data: the first surface at each pixel.

use glam::{DMat4, DVec2, DVec3, Vec3};

use super::Camera;

/// The first surface at each pixel, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleSurfaces {
    /// Where from.
    pub camera: Camera,
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// Where in its pixel each surface was sampled, from the upper left corner, 0 to 1 on
    /// both axes.
    pub sample: f32,
    /// Linear depth, metres; the camera's `far_m` where there is no surface.
    pub depth_m: Vec<f32>,
    /// Unit world-space normals for shading.
    pub normals: Vec<Vec3>,
    /// Unit world-space normals of the triangles, as finely as they are stored.
    pub geometric_normals: Vec<Vec3>,
}

impl VisibleSurfaces {
    /// Number of pixels.
    #[must_use]
    pub fn len(&self) -> usize {
        self.depth_m.len()
    }

    /// Whether there is no pixel.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.depth_m.is_empty()
    }

    /// Whether a pixel shows a surface.
    #[must_use]
    pub fn has_surface(&self, pixel: usize) -> bool {
        self.depth_m[pixel] < self.camera.far_m
    }

    /// How the picture maps to the world.
    #[must_use]
    pub fn projection(&self) -> PixelProjection {
        let aspect = self.width_px as f32 / self.height_px as f32;
        let (half_x, half_y) = self.camera.half_extent_at_1m(aspect);
        let size_px = DVec2::new(f64::from(self.width_px), f64::from(self.height_px));
        let half = DVec2::new(f64::from(half_x), f64::from(half_y));
        let view = self.camera.view().as_dmat4();
        PixelProjection {
            world_from_view: view.inverse(),
            view_from_world: view,
            metres_per_px: 2.0 * half / size_px,
            centre_px: size_px / 2.0 - f64::from(self.sample),
            width_px: self.width_px as usize,
        }
    }
}

/// From pixels to the world and back. Places on the picture are counted in pixels from the
/// sample of the upper left pixel, +x right, +y down: the samples lie at whole numbers.
#[derive(Debug, Clone, Copy)]
pub struct PixelProjection {
    /// From view space to the world.
    pub world_from_view: DMat4,
    /// From the world to view space.
    pub view_from_world: DMat4,
    /// Size of a pixel at depth 1 m, metres.
    pub metres_per_px: DVec2,
    centre_px: DVec2,
    width_px: usize,
}

impl PixelProjection {
    /// Where the sample of a pixel lies on the picture.
    #[must_use]
    pub fn place_of(&self, pixel: usize) -> DVec2 {
        let (x, y) = (pixel % self.width_px, pixel / self.width_px);
        DVec2::new(x as f64, y as f64)
    }

    /// The view-space point at depth 1 m that is seen at a place.
    #[must_use]
    pub fn ray_through(&self, place: DVec2) -> DVec3 {
        let offset = (place - self.centre_px) * self.metres_per_px;
        DVec3::new(offset.x, -offset.y, -1.0)
    }

    /// The world-space point that a pixel shows at a linear depth, metres.
    #[must_use]
    pub fn world_point(&self, pixel: usize, depth_m: f64) -> DVec3 {
        let seen = self.ray_through(self.place_of(pixel)) * depth_m;
        self.world_from_view.transform_point3(seen)
    }

    /// The picture's place, in pixels, of an offset in view space at depth 1 m.
    #[must_use]
    pub fn to_px(&self, offset: DVec2) -> DVec2 {
        DVec2::new(offset.x, -offset.y) / self.metres_per_px
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_goes_to_the_world_and_back() {
        let camera = Camera {
            position_m: Vec3::new(1.0, 2.0, 3.0),
            target_m: Vec3::new(0.0, 0.5, -1.0),
            vertical_fov_rad: 0.9,
            near_m: 0.1,
            far_m: 50.0,
        };
        let surfaces = VisibleSurfaces {
            camera,
            width_px: 40,
            height_px: 30,
            sample: 0.75,
            depth_m: vec![5.0; 1200],
            normals: Vec::new(),
            geometric_normals: Vec::new(),
        };
        let point = surfaces.projection().world_point(7 * 40 + 11, 5.0);
        let clip = camera.projection(4.0 / 3.0) * camera.view();
        let seen = clip.project_point3(point.as_vec3());
        assert!(((seen.x + 1.0) * 20.0 - 11.75).abs() < 1e-3, "{seen}");
        assert!(((1.0 - seen.y) * 15.0 - 7.75).abs() < 1e-3, "{seen}");
        let depth_m = -camera.view().transform_point3(point.as_vec3()).z;
        assert!((depth_m - 5.0).abs() < 1e-5);
    }
}
