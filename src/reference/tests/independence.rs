//! What an estimate says of its own error; and what it must not depend on.

use glam::{Quat, Vec3};

use super::shapes::{beside_wall, floor, geometry, point, seen, wall};
use super::*;
use crate::scene::Camera;

/// A floor before a wall, and points on it.
fn corner() -> (Geometry, Vec<SurfacePoint>) {
    let scene = geometry(vec![floor(50.0), wall(8.0, 1.7)]);
    let at = |x: f32, z: f32| point(&scene, Vec3::new(x, 4.0, z), Vec3::NEG_Y);
    let points = (0..40)
        .map(|k| at((k % 8) as f32 - 4.0, 0.2 + (k / 8) as f32))
        .collect();
    (scene, points)
}

/// Over many independent estimates of one number, (found − exact) / standard error has a mean
/// of 0 and, with 16 replicates, a mean square of 15/13. Of 600 the mean square strays by less
/// than 0.075 (one standard deviation), the mean by less than 0.044.
#[test]
fn the_standard_error_is_what_it_says() {
    let (scene, _) = corner();
    let before = point(&scene, Vec3::new(0.0, 4.0, 1.0), Vec3::NEG_Y);
    let exact = beside_wall(1.0, 8.0, 1.7);
    for error in [0.01, 0.003] {
        let settings = OcclusionSettings {
            error,
            ..OcclusionSettings::new(3)
        };
        let found = at_points(&scene, vec![before; 600], &settings);
        let z: Vec<f64> = (found.occlusion.iter().zip(&found.standard_error))
            .map(|(&k, &error)| (f64::from(k) - exact) / f64::from(error))
            .collect();
        let mean = z.iter().sum::<f64>() / 600.0;
        let square = z.iter().map(|z| z * z).sum::<f64>() / 600.0;
        assert!(mean.abs() < 0.2, "{error}: mean {mean}");
        assert!(
            (0.75..1.6).contains(&square),
            "{error}: mean square {square}"
        );
        assert!(found.standard_error.iter().all(|&e| f64::from(e) <= error));
    }
}

/// Agreement of all rays is no proof: the error never falls below one ray's weight.
#[test]
fn an_open_point_gets_the_rays_its_error_asks_for() {
    let plane = geometry(vec![floor(10.0)]);
    let at = point(&plane, Vec3::Y, Vec3::NEG_Y);
    let found = at_points(&plane, vec![at], &OcclusionSettings::new(3));
    assert_eq!((found.rays, found.standard_error[0]), (512, 1.0 / 512.0));
}

#[test]
fn the_largest_number_of_rays_ends_it() {
    let (scene, points) = corner();
    let settings = OcclusionSettings {
        error: 1e-5,
        max_rays: 1000,
        ..OcclusionSettings::new(3)
    };
    let found = at_points(&scene, points, &settings);
    assert_eq!(found.rays, 40 * 1024);
    assert!(found.standard_error.iter().any(|&error| error > 1e-5));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let (scene, points) = corner();
    let points: Vec<SurfacePoint> = points.repeat(20);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| at_points(&scene, points.clone(), &OcclusionSettings::new(3)))
    };
    assert_eq!(with(1), with(2));
    assert_ne!(with(1), {
        let other = OcclusionSettings::new(4);
        at_points(&scene, points.clone(), &other)
    });
}

#[test]
fn settings_out_of_range_are_refused() {
    let (scene, points) = corner();
    let bvh = SceneBvh::new(&scene);
    let surroundings = RayTraced::new(&bvh, points.into_iter().map(Some).collect());
    let good = OcclusionSettings::new(1);
    for (bad, setting) in [
        (OcclusionSettings { error: 0.0, ..good }, "error"),
        (
            OcclusionSettings {
                error: f64::NAN,
                ..good
            },
            "error",
        ),
        (
            OcclusionSettings {
                max_rays: 63,
                ..good
            },
            "max-rays",
        ),
        (
            OcclusionSettings {
                min_rays: 1 << 20,
                ..good
            },
            "min-rays",
        ),
        (
            OcclusionSettings {
                d_max_m: Some(-1.0),
                ..good
            },
            "distance-m",
        ),
    ] {
        let error = estimate(&surroundings, &bad, &|_| {}).unwrap_err();
        assert_eq!(error.setting, setting, "{error}");
    }
}

/// Ten kilometres from the origin a position is rounded to a millimetre, and so are the
/// corners: no ray may meet the plane it starts from.
#[test]
fn a_far_tilted_plane_does_not_hide_itself() {
    for far_m in [0.0, 10_000.0] {
        let tilt = Quat::from_euler(glam::EulerRot::XYZ, 0.4, 0.3, -0.5);
        let away = Vec3::new(0.7, -0.5, 0.6) * far_m;
        let mut plane = floor(300.0);
        for vertex in &mut plane.vertices {
            vertex.position_m = (tilt * Vec3::from(vertex.position_m) + away).to_array();
        }
        let camera = Camera {
            position_m: away + tilt * Vec3::new(0.0, 4.0, 5.0),
            target_m: away,
            vertical_fov_rad: 0.8,
            near_m: 0.1,
            far_m: 1000.0,
        };
        let bvh = SceneBvh::new(&geometry(vec![plane]));
        let surfaces = seen(&bvh, camera, (48, 32));
        assert!((0..surfaces.len()).all(|pixel| surfaces.has_surface(pixel)));
        let settings = OcclusionSettings {
            weighting: Weighting::Uniform,
            ..OcclusionSettings::new(1)
        };
        let traced = RayTraced::of_visible(&bvh, &surfaces);
        let found = estimate(&traced, &settings, &|_| {}).unwrap();
        let least = found.occlusion.iter().copied().fold(1.0, f32::min);
        // The stored normal of a plane with rounded corners leans by less than 1e-5.
        assert!(least > 0.9999, "{far_m}: {least}");
    }
}
