//! The depth buffer's answer.

use glam::Vec3;

use super::super::ScreenSpace;
use super::shapes::{beside_wall, floor, geometry, seen, wall};
use super::*;
use crate::scene::Camera;

fn camera(position_m: Vec3, target_m: Vec3) -> Camera {
    Camera {
        position_m,
        target_m,
        vertical_fov_rad: 0.9,
        near_m: 0.1,
        far_m: 500.0,
    }
}

#[test]
fn a_plane_is_open_in_its_own_picture() {
    let bvh = SceneBvh::new(&geometry(vec![floor(100.0)]));
    let above = camera(Vec3::new(0.3, 3.0, 4.0), Vec3::new(0.0, 0.0, -1.0));
    let surfaces = seen(&bvh, above, (64, 48));
    for d_max_m in [None, Some(2.0)] {
        let settings = OcclusionSettings {
            d_max_m,
            weighting: Weighting::Uniform,
            ..OcclusionSettings::new(1)
        };
        let found = estimate(&ScreenSpace::new(&surfaces), &settings, &|_| {}).unwrap();
        // Rounding of depths to 6e-8 against a pixel's size of 0.02 of them: 1e-5 rad.
        let least = found.occlusion.iter().copied().fold(1.0, f32::min);
        assert!(least > 0.999, "{d_max_m:?}: {least}");
    }
}

/// A floor and a wall, both whole in the picture: the ray-traced answer, but for the wall's
/// edge, which the picture knows to half a sample (0.5 %, or 0.003 of the occlusion).
#[test]
fn a_wall_in_the_picture_is_the_wall() {
    let scene = geometry(vec![floor(100.0), wall(1.0, 0.7)]);
    let bvh = SceneBvh::new(&scene);
    let before = camera(Vec3::new(0.0, 2.2, 3.5), Vec3::new(0.0, 0.3, 0.2));
    let surfaces = seen(&bvh, before, (480, 400));
    let settings = OcclusionSettings {
        error: 5e-4,
        ..OcclusionSettings::new(1)
    };
    let field = ScreenSpace::new(&surfaces);
    let projection = surfaces.projection();
    let mut tested = 0;
    for pixel in (0..surfaces.len()).step_by(499) {
        let depth_m = f64::from(surfaces.depth_m[pixel]);
        let at = projection.world_point(pixel, depth_m);
        if at.y.abs() > 1e-3 || at.x.abs() > 0.02 + 0.3 || !(0.2..1.5).contains(&at.z) {
            continue;
        }
        let one = OnePoint(&field, pixel);
        let found = estimate(&one, &settings, &|_| {}).unwrap().occlusion[0];
        // Off the middle the wall is two of different halves.
        let halves = [1.0 - at.x, 1.0 + at.x].map(|half| beside_wall(at.z, half, 0.7));
        let exact = halves.iter().sum::<f64>() / 2.0;
        assert_near(found, exact, 5e-3, &format!("{at}"));
        tested += 1;
    }
    assert!(tested >= 10, "{tested}");
}

/// Distances along a ray are those of the world.
#[test]
fn what_is_met_is_as_far_as_it_is() {
    let bvh = SceneBvh::new(&geometry(vec![floor(100.0), wall(3.0, 2.0)]));
    let before = camera(Vec3::new(0.0, 2.2, 5.5), Vec3::new(0.0, 0.5, 0.0));
    let surfaces = seen(&bvh, before, (320, 240));
    let field = ScreenSpace::new(&surfaces);
    let pixel = 170 * 320 + 160;
    let (start, normal) = field.start(pixel).unwrap();
    assert!(normal.y > 0.999);
    let depth_m = f64::from(surfaces.depth_m[pixel]);
    let at = surfaces.projection().world_point(pixel, depth_m);
    for direction in [Vec3::new(0.3, 0.2, -1.0), Vec3::new(-0.2, 0.02, -0.5)] {
        let direction = direction.normalize();
        let exact = at.z / f64::from(-direction.z);
        let found = field.nearest_m(&start, direction, 100.0).unwrap();
        assert_near(found, exact, 0.01, "distance");
        assert!(field.is_blocked(&start, direction, found + 0.01));
        assert!(!field.is_blocked(&start, direction, found - 0.01));
    }
    assert!(!field.is_blocked(&start, Vec3::new(0.0, 3.0, -1.0).normalize(), f32::INFINITY));
    assert!(!field.is_blocked(&start, Vec3::new(0.0, 0.1, 1.0).normalize(), f32::INFINITY));
}

/// A post stands before a wall: with no thickness at all light passes behind it, so that the wall
/// beside it is nearly as open as without the post; as a solid to infinity it closes half the sky.
#[test]
fn rays_pass_behind_what_is_thin() {
    let post = crate::scene::primitives::cuboid(
        "post",
        Vec3::new(-0.1, 0.0, 2.0),
        Vec3::new(0.1, 3.0, 2.02),
    );
    let bvh = SceneBvh::new(&geometry(vec![wall(8.0, 6.0), post]));
    let before = camera(Vec3::new(0.0, 1.5, 6.0), Vec3::new(0.0, 1.5, 0.0));
    let surfaces = seen(&bvh, before, (240, 180));
    let pixel = 90 * 240 + 132;
    assert!(
        (surfaces.depth_m[pixel] - 6.0).abs() < 0.01,
        "beside the post"
    );
    let settings = OcclusionSettings::new(1);
    let [solid, thick, thin] = [f32::INFINITY, 0.5, 0.02].map(|thickness_m| {
        let field = ScreenSpace::new(&surfaces).with_thickness_m(thickness_m);
        estimate(&OnePoint(&field, pixel), &settings, &|_| {})
            .unwrap()
            .occlusion[0]
    });
    // The post's own solid angle from there: 0.2 × 3 m at 2 m.
    assert!(thin > 0.85, "{thin}");
    assert!(solid < 0.6, "{solid}");
    assert!(
        solid < thick && thick < thin + 0.01,
        "{solid} {thick} {thin}"
    );
}

/// Whatever lies in front of a plane is met from the front, at any thickness.
#[test]
fn thickness_changes_nothing_that_is_met_from_the_front() {
    let scene = geometry(vec![floor(100.0), wall(3.0, 2.0)]);
    let bvh = SceneBvh::new(&scene);
    let before = camera(Vec3::new(0.0, 2.2, 5.5), Vec3::new(0.0, 0.5, 0.0));
    let surfaces = seen(&bvh, before, (320, 240));
    let direction = Vec3::new(0.3, 0.2, -1.0).normalize();
    let nearest = |field: ScreenSpace<'_>| {
        let (start, _) = field.start(170 * 320 + 160).unwrap();
        field.nearest_m(&start, direction, 100.0)
    };
    let solid = nearest(ScreenSpace::new(&surfaces));
    assert!(solid.is_some());
    assert_eq!(
        solid,
        nearest(ScreenSpace::new(&surfaces).with_thickness_m(0.3))
    );
}

/// One pixel of a field.
struct OnePoint<'a>(&'a ScreenSpace<'a>, usize);

use super::super::{Surroundings, screen_space::PixelStart};

impl Surroundings for OnePoint<'_> {
    type Start = PixelStart;

    fn len(&self) -> usize {
        1
    }

    fn start(&self, _: usize) -> Option<(PixelStart, Vec3)> {
        self.0.start(self.1)
    }

    fn is_blocked(&self, start: &PixelStart, direction: Vec3, reach_m: f32) -> bool {
        self.0.is_blocked(start, direction, reach_m)
    }

    fn nearest_m(&self, start: &PixelStart, direction: Vec3, reach_m: f32) -> Option<f32> {
        self.0.nearest_m(start, direction, reach_m)
    }
}
