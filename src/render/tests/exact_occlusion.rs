//! Occlusion where its value is known: planes, a wall beside a floor, a bowl, and what must not
//! depend on where things are or how large they are.

use glam::Vec3;

use super::*;
use crate::render::readback::FloatImage;

/// Techniques that estimate an integral over the hemisphere, finely sampled, with the radius far
/// beyond the scene, unblurred.
fn estimators() -> [Settings; 3] {
    let set = |name: &str, values: &[(&str, f64)]| {
        let mut settings = Settings::from_label(name).unwrap();
        for (parameter, value) in values {
            settings.set(parameter, *value).unwrap();
        }
        settings
    };
    [
        set(
            "gtao",
            &[
                ("slices", 32.0),
                ("steps", 48.0),
                ("radius_m", 1000.0),
                ("falloff", 0.0),
            ],
        ),
        set(
            "vbao",
            &[
                ("slices", 32.0),
                ("steps", 48.0),
                ("radius_m", 1000.0),
                ("thickness_m", 1000.0),
            ],
        ),
        set(
            "hbao",
            &[("directions", 64.0), ("steps", 48.0), ("radius_m", 1000.0)],
        ),
    ]
}

fn occlusion_of(geometry: &Geometry, request: &FrameRequest) -> FloatImage {
    draw(geometry, request).occlusion.unwrap()
}

fn unblurred(technique: Settings) -> FrameRequest {
    let mut request = request("none");
    (request.occlusion, request.blur_radius_px) = (technique, 0);
    request
}

/// How open each technique must leave an open plane at any angle. The thesis' blizzard and ray-march compare
/// with the pixel's own depth, before which a slanted plane stands itself; crytek greys every
/// plane. Those are artefacts that belong to them.
///
/// In the thesis' precision normals are up to 0.4° off, and so is the plane that is taken for open. Seen
/// nearer to its edge than 5°, that plane is any plane for techniques that look along slices.
fn plane_bound(technique: &str, precision: Precision, from_normal_deg: f32) -> f32 {
    let full = match technique {
        "crytek" => 0.0,
        "blizzard" => 0.92,
        "ray-march" => 0.97,
        _ => 0.999,
    };
    let rounding = match precision {
        Precision::Full => 0.0,
        Precision::Thesis if from_normal_deg > 85.0 => 0.4,
        Precision::Thesis => 0.03,
    };
    full - rounding
}

#[test]
fn an_open_plane_is_open_at_any_angle() {
    let floor = of_one_material(matte([1.0; 3]), vec![floor()]);
    for technique in TECHNIQUES.iter().filter(|t| t.shader.is_some()) {
        for from_normal_deg in [0.0_f32, 30.0, 60.0, 75.0, 85.0, 89.0, 89.9] {
            for precision in [Precision::Full, Precision::Thesis] {
                let mut request = unblurred(Settings::from_label(technique.name).unwrap());
                request.precision = precision;
                let angle = from_normal_deg.to_radians();
                let along = Vec3::new(0.0, angle.cos(), angle.sin());
                request.camera.position_m = 3.0 * along;
                request.camera.target_m = Vec3::ZERO;
                request.camera.near_m = 0.001;
                let occlusion = occlusion_of(&floor, &request);
                let lowest = occlusion.values.iter().copied().fold(1.0_f32, f32::min);
                assert!(
                    lowest >= plane_bound(technique.name, precision, from_normal_deg),
                    "{} at {from_normal_deg}°, {precision:?}: {lowest}",
                    technique.name
                );
            }
        }
    }
}

/// An endless wall beside a floor, seen from straight above so that the whole wall's top edge
/// is all that hides: from a floor point whose line to the edge stands at elevation β, the
/// cosine-weighted share is (1 + cos β)/2. Seen from above, the wall's side is not in the depth buffer
/// but its top is, which for a height field is the same.
#[test]
fn a_wall_beside_a_floor_closes_as_much_as_it_should() {
    let wall = cuboid(
        "wall",
        Vec3::new(-60.0, 0.0, -60.0),
        Vec3::new(60.0, 1.0, 0.0),
    );
    let ground = quad(
        "floor",
        Vec3::new(-60.0, 0.0, 60.0),
        Vec3::X * 120.0,
        Vec3::NEG_Z * 120.0,
    );
    let geometry = of_one_material(matte([1.0; 3]), vec![ground, wall]);
    let [gtao, vbao, _] = estimators();
    for technique in [gtao, vbao] {
        let name = technique.technique.name;
        let mut request = unblurred(technique);
        (request.width_px, request.height_px) = (320, 240);
        // As good as parallel: from high up, through a narrow field.
        request.camera.position_m = Vec3::new(0.0, 400.0, 0.9);
        request.camera.target_m = Vec3::new(0.0, 0.0, 0.9);
        request.camera.vertical_fov_rad = 0.03;
        request.camera.near_m = 10.0;
        request.camera.far_m = 1000.0;
        let occlusion = occlusion_of(&geometry, &request);
        for distance_m in [0.3_f32, 0.6, 1.0, 2.0, 4.0] {
            let points = [-2, -1, 0, 1, 2].map(|i| Vec3::new(i as f32, 0.0, distance_m));
            let mean = points
                .map(|p| pixel_of(&request, p))
                .map(|(x, y)| occlusion.at(x, y))
                .iter()
                .sum::<f32>()
                / 5.0;
            let elevation = (1.0 / distance_m).atan();
            // Of the wall only ±8 m are in the picture: off the picture is open. What the two
            // far ends would close is below 0.01.
            let exact = f32::midpoint(1.0, elevation.cos());
            assert!(
                (mean - exact).abs() < 0.03,
                "{name} at {distance_m} m: {mean}, exactly {exact}"
            );
        }
    }
}

/// Every point inside a cap of a ball sees the same share of it closed: half of 1 − cos γ for a cap of
/// half-angle γ, because equal areas of a sphere have equal form factors from all its points.
#[test]
fn a_bowl_is_evenly_open() {
    let half_angle = std::f32::consts::FRAC_PI_3;
    let exact = f32::midpoint(1.0, half_angle.cos());
    let geometry = of_one_material(matte([1.0; 3]), vec![bowl(half_angle, 96)]);
    let [gtao, vbao, _] = estimators();
    for mut technique in [gtao, vbao] {
        let name = technique.technique.name;
        // Even steps that reach from rim to rim.
        technique.set("step_power", 1.0).unwrap();
        technique.set("steps", 64.0).unwrap();
        technique.set("radius_m", 1.8).unwrap();
        let mut request = unblurred(technique);
        (request.width_px, request.height_px) = (240, 240);
        request.camera.position_m = Vec3::new(0.0, 60.0, 0.0);
        request.camera.target_m = Vec3::new(0.0, 0.0, 0.001);
        request.camera.vertical_fov_rad = 2.0 * (1.0_f32 / 60.0).atan();
        request.camera.near_m = 1.0;
        request.camera.far_m = 100.0;
        let occlusion = occlusion_of(&geometry, &request);
        for across in [0.0_f32, 0.2, 0.4, 0.6, 0.8] {
            // A ring, so that the noise of single pixels averages out.
            let ring: f32 = (0..24)
                .map(|i| {
                    let angle = i as f32 * std::f32::consts::TAU / 24.0;
                    let depth = -(1.0 - across * across).sqrt();
                    let point = Vec3::new(across * angle.cos(), depth, across * angle.sin());
                    let (x, y) = pixel_of(&request, point);
                    occlusion.at(x, y)
                })
                .sum::<f32>()
                / 24.0;
            assert!(
                (ring - exact).abs() < 0.02,
                "{name}, {across} from the middle: {ring}, exactly {exact}"
            );
        }
    }
}

/// The inside of a cap about the lowest point of the unit ball round the origin.
fn bowl(half_angle: f32, rings: u32) -> Mesh {
    let mut mesh = quad("bowl", Vec3::ZERO, Vec3::X, Vec3::Z);
    let corner = mesh.vertices[0];
    (mesh.vertices, mesh.indices) = (Vec::new(), Vec::new());
    let around = 4 * rings;
    for ring in 0..=rings {
        for step in 0..=around {
            let up = half_angle * ring as f32 / rings as f32;
            let turn = std::f32::consts::TAU * step as f32 / around as f32;
            let out = Vec3::new(up.sin() * turn.cos(), -up.cos(), up.sin() * turn.sin());
            let mut vertex = corner;
            vertex.position_m = out.to_array();
            vertex.normal = (-out).to_array();
            mesh.vertices.push(vertex);
        }
    }
    for ring in 0..rings {
        for step in 0..around {
            let a = ring * (around + 1) + step;
            let (b, c, d) = (a + 1, a + around + 1, a + around + 2);
            mesh.indices.extend([a, b, c, b, d, c]);
        }
    }
    mesh
}

/// A scene a thousand times larger, radius and all, is the same picture.
#[test]
fn occlusion_has_no_scale_of_its_own() {
    for label in ["gtao18", "vbao18", "hbao24", "alchemy12"] {
        let at = |scale: f32| {
            let mut request = unblurred(Settings::from_label(label).unwrap());
            for (name, metres) in [
                ("radius_m", 0.5_f32),
                ("thickness_m", 0.2),
                ("intensity_m", 0.15),
                ("softening_m", 0.01),
            ] {
                // Not every technique has every length.
                let _ = request.occlusion.set(name, f64::from(metres * scale));
            }
            let camera = &mut request.camera;
            camera.position_m *= scale;
            camera.target_m *= scale;
            camera.near_m *= scale;
            camera.far_m *= scale;
            let mut geometry = floor_and_wall([1.0; 3]);
            for vertex in geometry
                .meshes
                .iter_mut()
                .flat_map(|mesh| &mut mesh.vertices)
            {
                vertex.position_m = (Vec3::from(vertex.position_m) * scale).to_array();
            }
            occlusion_of(&geometry, &request)
        };
        // A power of two changes no bit of a coordinate but its exponent.
        let (small, large) = (at(1.0), at(1024.0));
        let differing = small
            .values
            .iter()
            .zip(&large.values)
            .filter(|(a, b)| (**a - **b).abs() > 0.002)
            .count();
        assert!(
            differing < small.values.len() / 1000,
            "{label}: {differing}"
        );
    }
}

/// Half resolution, brought back to every pixel, is the same picture but for its edges.
#[test]
fn half_resolution_stays_close() {
    for technique in TECHNIQUES.iter().filter(|t| t.shader.is_some()) {
        let full = request(technique.name);
        let mut half = full.clone();
        half.occlusion.set("resolution", "half").unwrap();
        (half.width_px, half.height_px) = (161, 121);
        let mut full = full;
        (full.width_px, full.height_px) = (161, 121);
        let geometry = floor_and_wall([1.0; 3]);
        let (full, half) = (
            occlusion_of(&geometry, &full),
            occlusion_of(&geometry, &half),
        );
        assert_eq!((half.width_px, half.height_px), (161, 121));
        let apart: f32 = full
            .values
            .iter()
            .zip(&half.values)
            .map(|(a, b)| (a - b).abs())
            .sum::<f32>()
            / full.values.len() as f32;
        assert!(apart < 0.02, "{}: {apart}", technique.name);
        assert!(half.values.iter().all(|k| (0.0..=1.0).contains(k)));
    }
}

/// The two readings of one idea differ, and neither is the other by another parameter.
#[test]
fn filion_closes_fully_what_is_near() {
    let mut thesis = unblurred(Settings::from_label("blizzard64").unwrap());
    thesis.occlusion.set("far_threshold_m", 5.0).unwrap();
    let mut filion = thesis.clone();
    filion.occlusion.set("mode", "filion").unwrap();
    // Everything nearer than the near threshold closes fully; the thesis leaves it open.
    for request in [&mut thesis, &mut filion] {
        request.occlusion.set("near_threshold_m", 4.9).unwrap();
    }
    let geometry = floor_and_wall([1.0; 3]);
    let corner = |request: &FrameRequest| {
        let (x, y) = pixel_of(request, Vec3::new(0.0, 0.03, 0.0));
        occlusion_of(&geometry, request).at(x, y)
    };
    assert_eq!(corner(&thesis), 1.0);
    assert!(corner(&filion) < 0.75, "{}", corner(&filion));
}
