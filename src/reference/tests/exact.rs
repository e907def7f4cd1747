//! Cases with closed forms, to 1e-3.

use glam::Vec3;

use super::shapes::{beside_wall, floor, geometry, hemisphere, point, sphere, tube, wall};
use super::*;
use crate::scene::procedural;

const BOTH: [Weighting; 2] = [Weighting::Cosine, Weighting::Uniform];

#[test]
fn an_open_plane_is_open() {
    let plane = geometry(vec![floor(100.0)]);
    let points = [(0.0, 0.0), (3.0, -20.0), (99.0, 99.0)];
    let points = points.map(|(x, z)| point(&plane, Vec3::new(x, 5.0, z), Vec3::NEG_Y));
    for weighting in BOTH {
        let found = at_points(&plane, points.to_vec(), &precise(weighting));
        assert_eq!(found.occlusion, [1.0; 3]);
    }
}

/// k_A = (1 + cos β)/2 beside an infinite wall; the finite wall's own closed form is used, and
/// at a thousand times the distance it is that to 1e-6.
#[test]
fn a_wall_takes_its_part() {
    let (distance_m, half_width_m, height_m) = (1.0_f32, 1000.0, 1.7);
    let scene = geometry(vec![floor(50.0), wall(half_width_m, height_m)]);
    let before = point(&scene, Vec3::new(0.0, 4.0, distance_m), Vec3::NEG_Y);
    let exact = beside_wall(1.0, 1000.0, 1.7);
    let cos_beta = 1.0 / 1.7_f64.hypot(1.0);
    assert!((exact - (1.0 + cos_beta) / 2.0).abs() < 1e-3);
    let found = at_points(&scene, vec![before], &precise(Weighting::Cosine));
    assert_near(found.occlusion[0], exact, 1e-3, "cosine");
    // Uniform: the wall fills the angle β of a half turn.
    let found = at_points(&scene, vec![before], &precise(Weighting::Uniform));
    let uniform = 1.0 - cos_beta.acos() / std::f64::consts::PI;
    assert_near(found.occlusion[0], uniform, 1.5e-3, "uniform");
}

#[test]
fn a_pit_lets_in_what_its_angle_says() {
    for half_angle_rad in [0.3_f32, 0.8, 1.2] {
        let pit = geometry(vec![floor(2.0), tube(1.0, 1.0 / half_angle_rad.tan(), 512)]);
        let centre = point(&pit, Vec3::new(0.0, 0.1, 0.0), Vec3::NEG_Y);
        let t = f64::from(half_angle_rad);
        for (weighting, exact) in [
            (Weighting::Cosine, t.sin().powi(2)),
            (Weighting::Uniform, 1.0 - t.cos()),
        ] {
            let found = at_points(&pit, vec![centre], &precise(weighting));
            assert_near(found.occlusion[0], exact, 1e-3, "pit");
        }
    }
}

/// k_A = ½ at every point. The pieces are flat, the normals are the
/// sphere's: what hides under a piece's own plane, up to 0.5°, counts 1e-4.
#[test]
fn a_hemispherical_bowl_is_half_open_everywhere() {
    let bowl = geometry(vec![hemisphere()]);
    let mut points: Vec<SurfacePoint> = [(0.0, -1.0), (0.3, -0.9), (0.8, -0.5), (-0.7, -0.2)]
        .map(|(x, y)| point(&bowl, Vec3::new(0.01, -0.01, 0.013), Vec3::new(x, y, 0.21)))
        .to_vec();
    for point in &mut points {
        point.normal = -point.position_m.normalize();
    }
    let found = at_points(&bowl, points, &precise(Weighting::Cosine));
    for occlusion in found.occlusion {
        assert_near(occlusion, 0.5, 1e-3, "bowl");
    }
}

/// From a point of a unit sphere's inside the way in a direction is 2 cosθ, so that with
/// ρ = t / d_max, d_max ≥ 2: cosine 4 / (3 d_max), uniform 1 / d_max. Without a d_max all is
/// closed: an enclosed room needs one.
#[test]
fn an_enclosed_room_needs_a_distance() {
    let room = geometry(vec![sphere()]);
    let at = point(&room, Vec3::ZERO, Vec3::new(0.3, -0.8, 0.21));
    for (weighting, exact) in [
        (Weighting::Cosine, 4.0 / 9.0),
        (Weighting::Uniform, 1.0 / 3.0),
    ] {
        let near = OcclusionSettings {
            d_max_m: Some(3.0),
            ..precise(weighting)
        };
        let found = at_points(&room, vec![at], &near);
        assert_near(found.occlusion[0], exact, 1e-3, "room");
        let found = at_points(&room, vec![at], &precise(weighting));
        assert_eq!(found.occlusion, [0.0]);
    }
}

/// Beyond d_max nothing is tested: a wall past it takes nothing.
#[test]
fn nothing_beyond_the_distance_counts() {
    let scene = geometry(vec![floor(50.0), wall(20.0, 10.0)]);
    let before = point(&scene, Vec3::new(0.0, 4.0, 1.0), Vec3::NEG_Y);
    let within = |d_max_m| OcclusionSettings {
        d_max_m: Some(d_max_m),
        ..precise(Weighting::Cosine)
    };
    let at = |d_max_m| at_points(&scene, vec![before], &within(d_max_m)).occlusion[0];
    assert_eq!(at(0.999), 1.0);
    assert!(at(1.5) < 0.99 && at(4.0) < at(1.5));
}

/// A shading normal may lean over its surface, which then hides a part of its hemisphere: a
/// plane seen from a hemisphere that leans by β leaves (1 + cos β)/2 of it.
#[test]
fn a_leaning_normal_sees_its_own_surface() {
    let plane = geometry(vec![floor(100.0)]);
    let mut leaning = point(&plane, Vec3::Y, Vec3::NEG_Y);
    leaning.normal = Vec3::new(0.6, 0.8, 0.0);
    let found = at_points(&plane, vec![leaning], &precise(Weighting::Cosine));
    assert_near(found.occlusion[0], 0.9, 1e-3, "leaning");
}

/// The meshes of the generator `shapes` whose name begins so.
fn of_shapes(shape: &str) -> Geometry {
    let mut scene = (procedural::shapes::GENERATOR.generate)(0);
    scene.meshes.retain(|mesh| mesh.name.starts_with(shape));
    scene
}

/// A floor point between two walls that meet at a right angle loses what each of the two hides, two
/// rectangles at its foot each; and they hide nothing of each other.
#[test]
fn the_corner_of_the_shapes_is_known() {
    let corner = of_shapes("corner");
    for from_walls_m in [0.1_f64, 0.4, 0.9] {
        let across = (std::f64::consts::SQRT_2 * from_walls_m) as f32;
        let above = procedural::shapes::CORNER_M + Vec3::new(0.0, 0.5, across);
        let hidden = |half_width_m: f64| {
            1.0 - beside_wall(
                from_walls_m,
                half_width_m,
                procedural::shapes::CORNER_HEIGHT_M.into(),
            )
        };
        let length_m = f64::from(procedural::shapes::CORNER_LENGTH_M);
        let exact = 1.0 - hidden(from_walls_m) - hidden(length_m - from_walls_m);
        let at = point(&corner, above, Vec3::NEG_Y);
        let found = at_points(&corner, vec![at], &precise(Weighting::Cosine));
        assert_near(found.occlusion[0], exact, 1e-3, "corner");
    }
}

/// A sphere that rests on the floor hides (R/d)² cosθ = (R/d)³ of it, d from its centre. It is
/// of flat pieces, a thousandth smaller.
#[test]
fn the_floor_round_the_sphere_of_the_shapes_is_known() {
    let sphere = of_shapes("sphere");
    let radius_m = procedural::shapes::SPHERE_RADIUS_M;
    for away_m in [0.5_f32, 0.6, 0.8] {
        let above = procedural::shapes::SPHERE_M + Vec3::new(away_m, 0.5, 0.0);
        let at = point(&sphere, above, Vec3::NEG_Y);
        let exact = 1.0 - f64::from(radius_m / radius_m.hypot(away_m)).powi(3);
        let found = at_points(&sphere, vec![at], &precise(Weighting::Cosine));
        assert_near(found.occlusion[0], exact, 2e-3, "sphere");
    }
}
