//! Occlusion in two bands: the sphere's closed form, and what only spheres of the scene can know.

use glam::Vec3;

use super::*;
use crate::render::plan::{FramePlan, GeometryFacts};
use crate::scene::{SurfacePoint, SurfacePoints};

/// A ball of triangles.
fn ball(centre_m: Vec3, radius_m: f32) -> Mesh {
    const ROWS: u32 = 24;
    let mut mesh = Mesh {
        name: String::from("ball"),
        ..Mesh::default()
    };
    let corner = floor().vertices[0];
    for (row, column) in (0..=ROWS).flat_map(|row| (0..=2 * ROWS).map(move |c| (row, c))) {
        let [down, round] = [row, column].map(|i| std::f32::consts::PI * i as f32 / ROWS as f32);
        let normal = Vec3::new(
            down.sin() * round.cos(),
            down.cos(),
            down.sin() * round.sin(),
        );
        mesh.vertices.push(crate::scene::Vertex {
            position_m: (centre_m + normal * radius_m).to_array(),
            normal: normal.to_array(),
            ..corner
        });
        if row < ROWS && column < 2 * ROWS {
            let a = row * (2 * ROWS + 1) + column;
            let below = a + 2 * ROWS + 1;
            mesh.indices
                .extend([a, a + 1, below, a + 1, below + 1, below]);
        }
    }
    mesh
}

/// The far band alone, unblurred, over the whole scene.
fn far_band() -> FrameRequest {
    let mut request = request("two-band");
    for (name, value) in [("radius_m", 0.0), ("reach_m", 100_000.0), ("bias", 0.0)] {
        request.occlusion.set(name, value).unwrap();
    }
    request.blur_radius_px = 0;
    request
}

/// A floor whose only proxy is one sphere.
fn floor_under_a_sphere(centre_m: Vec3, radius_m: f32) -> GpuScene {
    let floor = of_one_material(matte([0.5; 3]), vec![floor()]);
    let mut scene = renderer().upload(&floor).unwrap();
    scene.surface = SurfacePoints {
        points: [-radius_m, radius_m]
            .map(|up_m| SurfacePoint {
                position_m: centre_m + Vec3::Y * up_m,
                normal: Vec3::Y * up_m.signum(),
            })
            .to_vec(),
        area_each_m2: 2.0 * std::f64::consts::PI * f64::from(radius_m * radius_m),
    };
    scene
}

/// The share of cosine-weighted directions about +Y that meet a sphere, counted.
fn counted(from_m: Vec3, centre_m: Vec3, radius_m: f32) -> f32 {
    const DIRECTIONS: u32 = 20_000;
    let offset_m = centre_m - from_m;
    let meets = |i: &u32| {
        let share = (*i as f32 + 0.5) / DIRECTIONS as f32;
        let (sin, cos) = (2.399_963_2 * *i as f32).sin_cos();
        let (side, up) = (share.sqrt(), (1.0 - share).sqrt());
        let direction = Vec3::new(side * cos, up, side * sin);
        let along_m = direction.dot(offset_m);
        along_m > 0.0 && offset_m.length_squared() - along_m * along_m < radius_m * radius_m
    };
    (0..DIRECTIONS).filter(meets).count() as f32 / DIRECTIONS as f32
}

/// A sphere of half angle a whose centre stands at an angle θ to the normal hides sin²a cos θ of the
/// cosine-weighted light, while all of it is above the tangent plane.
#[test]
fn a_sphere_hides_what_its_closed_form_says() {
    let mut request = far_band();
    request.occlusion.set("proxies", 1.0).unwrap();
    for (centre_m, radius_m) in [
        (Vec3::new(0.0, 1.2, 0.0), 0.8),
        (Vec3::new(0.6, 0.8, 1.0), 0.3),
    ] {
        let scene = floor_under_a_sphere(centre_m, radius_m);
        let found = renderer().render(&scene, &request).unwrap();
        let occlusion = found.occlusion.unwrap();
        for x_m in [-1.0, -0.4, 0.0, 0.7] {
            let point = Vec3::new(x_m, 0.0, 0.6);
            let (x, y) = pixel_of(&request, point);
            // The pixel's own point, not the one that was asked for.
            let ray = crate::render::testing::direction_at(&request, (x, y));
            let seen_m = request.camera.position_m - ray * (1.5 / ray.y);
            let offset_m = centre_m - seen_m;
            let exact = radius_m * radius_m * offset_m.y / offset_m.length().powi(3);
            let by_count = counted(seen_m, centre_m, radius_m);
            assert!((exact - by_count).abs() < 2e-3, "{exact} {by_count}");
            // Half floats, and a geometric normal to a quarter of a degree.
            let hidden = 1.0 - occlusion.at(x, y);
            assert!((hidden - exact).abs() < 3e-3, "{hidden}, not {exact}");
        }
    }
}

/// Within a sphere, on it, and with a sphere of no size: a number from 0 to 1.
#[test]
fn inside_a_sphere_the_answer_is_finite() {
    for (centre_m, radius_m) in [
        (Vec3::ZERO, 0.0),
        (Vec3::ZERO, 3.0),
        (Vec3::new(0.0, 0.5, 0.0), 0.5),
        (Vec3::new(0.0, -2.0, 0.0), 1.0),
        (Vec3::new(0.0, 1.5, 4.0), 30.0),
    ] {
        for overlap in ["sum", "product"] {
            let mut request = far_band();
            request.occlusion.set("proxies", 1.0).unwrap();
            request.occlusion.set("overlap", overlap).unwrap();
            let scene = floor_under_a_sphere(centre_m, radius_m);
            let frame = renderer().render(&scene, &request).unwrap();
            let occlusion = frame.occlusion.unwrap();
            assert!(occlusion.values.iter().all(|k| (0.0..=1.0).contains(k)));
            if centre_m.y < 0.0 {
                assert!(occlusion.values.iter().all(|&k| k == 1.0), "from below");
            }
        }
    }
}

/// A plane hides nothing of itself, in either band, however it is looked at.
#[test]
fn an_open_plane_is_open() {
    let geometry = of_one_material(matte([1.0; 3]), vec![floor()]);
    for from_normal_deg in [0.5_f32, 45.0, 60.0, 80.0, 89.0, 89.9] {
        let mut request = request("two-band");
        let (sin, cos) = from_normal_deg.to_radians().sin_cos();
        request.camera.position_m = Vec3::new(0.0, cos, sin) * 3.0;
        request.camera.target_m = Vec3::ZERO;
        request.camera.near_m = 0.001;
        let occlusion = draw(&geometry, &request).occlusion.unwrap();
        let least = occlusion.values.iter().copied().fold(1.0, f32::min);
        assert!(least > 0.995, "{from_normal_deg}° from the normal: {least}");
    }
}

#[test]
fn the_foot_of_a_wall_is_darker_than_its_top_edge() {
    for resolution in ["full", "half"] {
        let mut request = request("two-band");
        request.occlusion.set("resolution", resolution).unwrap();
        let frame = draw(&floor_and_wall([1.0; 3]), &request);
        let occlusion = frame.occlusion.unwrap();
        let mean = |y_m: f32| {
            let points = (-8..=8).map(|i| Vec3::new(i as f32 * 0.1, y_m, 0.0));
            let values = points.map(|point| {
                let (x, y) = pixel_of(&request, point);
                occlusion.at(x, y)
            });
            values.sum::<f32>() / 17.0
        };
        let (foot, top) = (mean(0.05), mean(1.55));
        assert!(foot < top - 0.1, "{resolution}: foot {foot}, top {top}");
    }
}

/// What the picture does not show darkens all the same: the point of having proxies.
#[test]
fn a_ball_above_the_picture_darkens_the_floor() {
    let mut request = request("two-band");
    request.camera.position_m = Vec3::new(0.0, 1.0, 2.0);
    request.camera.target_m = Vec3::ZERO;
    let (centre_m, radius_m) = (Vec3::new(0.0, 1.6, 0.0), 0.5);
    let alone = of_one_material(matte([1.0; 3]), vec![floor()]);
    let both = of_one_material(matte([1.0; 3]), vec![floor(), ball(centre_m, radius_m)]);
    let below = pixel_of(&request, Vec3::ZERO);
    let k_at = |geometry: &Geometry, request: &FrameRequest| {
        let occlusion = draw(geometry, request).occlusion.unwrap();
        occlusion.at(below.0, below.1)
    };
    // The picture is the same with the ball and without: nothing of it is seen.
    let mut unoccluded = request.clone();
    unoccluded.occlusion = Settings::from_label("none").unwrap();
    let bare = |geometry: &Geometry| draw(geometry, &unoccluded).picture;
    assert!(bare(&alone) == bare(&both), "the ball is in the picture");
    assert!(k_at(&alone, &request) > 0.995);
    let hidden = 1.0 - k_at(&both, &request);
    let exact = radius_m * radius_m / (1.6 * 1.6);
    assert!((hidden - exact).abs() < 0.25 * exact, "{hidden}, {exact}");
    request.occlusion.set("proxies", 0.0).unwrap();
    assert!(k_at(&both, &request) > 0.995, "seen without proxies");
}

/// The bands share every distance out between them: where the near one reaches over the whole scene,
/// nothing is left to the far one.
#[test]
fn nothing_counts_in_both_bands() {
    let geometry = floor_and_wall([1.0; 3]);
    let with = |radius_m: f64, proxies: f64| {
        let mut request = request("two-band");
        request.occlusion.set("radius_m", radius_m).unwrap();
        request.occlusion.set("proxies", proxies).unwrap();
        draw(&geometry, &request).picture
    };
    assert!(with(100.0, 0.0) == with(100.0, 256.0));
    assert!(with(0.3, 0.0) != with(0.3, 256.0));
}

#[test]
fn half_resolution_is_close_to_full() {
    let geometry = floor_and_wall([1.0; 3]);
    let mean = |resolution: &str| {
        let mut request = request("two-band");
        request.occlusion.set("resolution", resolution).unwrap();
        let occlusion = draw(&geometry, &request).occlusion.unwrap();
        occlusion.values.iter().sum::<f32>() / occlusion.values.len() as f32
    };
    let (full, half) = (mean("full"), mean("half"));
    assert!((full - half).abs() < 0.01, "{full} {half}");
}

/// Without triangles there is nothing to fit spheres to: no error, and the plan names the technique
/// and its parameter.
#[test]
fn an_empty_scene_has_no_proxies_and_says_so() {
    let request = request("two-band");
    let frame = draw(&Geometry::default(), &request);
    assert!(frame.occlusion.unwrap().values.iter().all(|&k| k == 1.0));
    let plan = FramePlan::new(&request, &GeometryFacts::of(&Geometry::default())).to_string();
    assert!(
        plan.contains("technique `two-band`, parameter `proxies`"),
        "{plan}"
    );
    assert!(plan.contains("no triangles"), "{plan}");
    let seen = FramePlan::new(&request, &GeometryFacts::of(&floor_and_wall([1.0; 3]))).to_string();
    assert!(seen.contains("normals, proxies;"), "{seen}");
}
