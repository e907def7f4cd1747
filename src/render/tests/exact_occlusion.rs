//! Planes, whose occlusion is known at any angle, and what must not depend on where things are or how
//! large they are. What hollows close is in `hollows`.

use glam::Vec3;

use super::*;
use crate::render::readback::FloatImage;

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

/// What the means of two neighbouring rows of an even plane may differ by, once blurred. Depth as a float is
/// as fine far away as it is near; normals of 8 bits are stripes that the blur has to hide. Those of 2010
/// close a slanted plane by how slanted it is, which changes evenly over the picture.
fn band_bound(technique: &str, precision: Precision) -> f32 {
    match (technique, precision) {
        ("crytek" | "blizzard" | "ray-march", _) => 0.012,
        (_, Precision::Full) => 0.002,
        (_, Precision::Thesis) => 0.01,
    }
}

/// An even plane has no stripes, however far it is: depths and normals are stored finely enough.
#[test]
fn a_plane_has_no_bands() {
    let mut bands = Vec::new();
    for technique in TECHNIQUES.iter().filter(|t| t.shader.is_some()) {
        for distance_m in [1.0_f32, 1000.0, 100_000.0] {
            for precision in [Precision::Full, Precision::Thesis] {
                let side = 20.0 * distance_m;
                let corner = Vec3::new(-0.5, 0.0, 0.5) * side;
                let plane = quad("plane", corner, Vec3::X * side, Vec3::NEG_Z * side);
                let mut request = request(technique.name);
                for parameter in technique.parameters {
                    if parameter.name.ends_with("_m") {
                        let metres = request.occlusion.get(parameter.name);
                        // As far as its range goes.
                        let _ = (request.occlusion)
                            .set(parameter.name, metres * f64::from(distance_m) / 3.0);
                    }
                }
                request.precision = precision;
                request.blur_plane_m = 0.02 * distance_m;
                request.camera.position_m = Vec3::new(0.0, 0.5, 0.866) * distance_m;
                request.camera.target_m = Vec3::ZERO;
                (request.camera.near_m, request.camera.far_m) =
                    (0.01 * distance_m, 30.0 * distance_m);
                let plane = of_one_material(matte([1.0; 3]), vec![plane]);
                let occlusion = occlusion_of(&plane, &request);
                // The blur is another one at the picture's edge.
                let means: Vec<f32> = (8..request.height_px - 8)
                    .map(|y| (8..152).map(|x| occlusion.at(x, y)).sum::<f32>() / 144.0)
                    .collect();
                let steps = means.windows(2).map(|rows| (rows[0] - rows[1]).abs());
                let largest = steps.fold(0.0, f32::max);
                if largest > band_bound(technique.name, precision) {
                    bands.push((technique.name, distance_m, precision, largest));
                }
            }
        }
    }
    assert!(bands.is_empty(), "{bands:?}");
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
