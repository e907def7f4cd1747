//! Light through the bent cone. What is closed by direction is held to what is exact in `hollows`.

use glam::Vec3;

use super::*;
use crate::reference::Opening;
use crate::scene::Environment;

const GIVING: [&str; 2] = ["gtao", "vbao"];

/// An environment that is bright to one side, and nothing else.
fn lit(label: &str, bent_cone: &str) -> FrameRequest {
    let mut request = request(label);
    request.occlusion.set("bent_cone", bent_cone).unwrap();
    request.lighting.ambient = Ambient::Environment;
    let axes = [0.9, 0.1, 0.3, 0.3, 0.2, 0.6].map(Vec3::splat);
    request.lighting.environment = Some(Environment::from_axes(axes));
    request
}

fn constant(label: &str, bent_cone: &str) -> FrameRequest {
    let mut request = request(label);
    request.occlusion.set("bent_cone", bent_cone).unwrap();
    request
}

/// A plane has its own normal for a bent direction from wherever it is seen, and its plain light.
#[test]
fn an_open_plane_is_bent_nowhere() {
    let geometry = of_one_material(matte([0.5, 0.4, 0.3]), vec![floor()]);
    for label in ["gtao", "vbao", "ssdo"] {
        for from_normal_deg in [0.5_f32, 45.0, 80.0, 89.0] {
            let mut request = request(label);
            let (sin, cos) = from_normal_deg.to_radians().sin_cos();
            request.camera.position_m = Vec3::new(0.0, cos, sin) * 3.0;
            request.camera.target_m = Vec3::ZERO;
            request.camera.near_m = 0.001;
            request.keeps_cone = true;
            let closed = draw(&geometry, &request).closed_directions.unwrap();
            let most = closed.iter().map(|c| c.length()).fold(0.0, f32::max);
            assert!(
                most < 2e-3,
                "{label}, {from_normal_deg}° from the normal: {most}"
            );
            if label == "ssdo" {
                continue;
            }
            let [off, on] = ["off", "on"].map(|word| {
                let under = lit(label, word);
                request.occlusion = under.occlusion;
                request.lighting = under.lighting;
                draw(&geometry, &request).picture
            });
            let apart = (off.rgba8.iter().zip(&on.rgba8)).map(|(a, b)| a.abs_diff(*b));
            assert!(apart.max() <= Some(1), "{label}, {from_normal_deg}°");
        }
    }
}

/// What the picture shows is the irradiance of the processor's formula through what was kept.
#[test]
fn the_picture_is_lit_through_the_cone_that_is_kept() {
    let geometry = floor_and_wall([0.8; 3]);
    for label in GIVING {
        for resolution in ["full", "half"] {
            let mut request = lit(label, "on");
            request.keeps_cone = true;
            request.occlusion.set("resolution", resolution).unwrap();
            let frame = draw(&geometry, &request);
            let (share, closed) = (frame.occlusion.as_ref(), frame.closed_directions.as_ref());
            let (share, closed) = (share.unwrap(), closed.unwrap());
            let light = request.lighting.environment.as_ref().unwrap();
            for (x, z) in [(-1.0, 0.06), (0.3, 0.1), (1.0, 0.3), (0.0, 1.2)] {
                let (column, row) = pixel_of(&request, Vec3::new(x, 0.0, z));
                let opening = Opening {
                    share: share.at(column, row),
                    moment: Vec3::Y * (2.0 / 3.0)
                        - closed[(row * request.width_px + column) as usize],
                };
                let radiance = opening.irradiance(&light.irradiance()) / std::f32::consts::PI;
                let found = rgb(&frame, (column, row))[0];
                let expected = srgb8(0.8 * radiance.x);
                assert!(
                    (i32::from(found) - expected).abs() <= 2,
                    "{label} {resolution} {x} {z}: {found}, {expected}"
                );
            }
        }
    }
}

/// A wall takes what comes from its side: before it the floor keeps more of the light from the other side
/// than k_A says, and less where the light comes from behind the wall.
#[test]
fn a_wall_takes_the_light_that_comes_from_its_side() {
    let geometry = floor_and_wall([0.8; 3]);
    for label in GIVING {
        let level = |word: &str, towards_eye: bool| {
            let mut request = lit(label, word);
            let axes = if towards_eye {
                [0.3, 0.3, 0.3, 0.3, 1.0, 0.0]
            } else {
                [0.3, 0.3, 0.3, 0.3, 0.0, 1.0]
            };
            request.lighting.environment = Some(Environment::from_axes(
                axes.map(|value| Vec3::splat(value * 2.0)),
            ));
            let frame = draw(&geometry, &request);
            rgb(&frame, pixel_of(&request, Vec3::new(0.0, 0.0, 0.06)))[0]
        };
        assert!(level("on", true) > level("off", true) + 8, "{label}");
        assert!(level("on", false) + 8 < level("off", false), "{label}");
    }
}

/// Constant light comes through any cone alike, and nothing is made for it.
#[test]
fn constant_light_is_the_same_byte_for_byte() {
    let geometry = floor_and_wall([0.7, 0.5, 0.3]);
    for label in GIVING {
        let [off, on] = ["off", "on"].map(|word| draw(&geometry, &constant(label, word)).picture);
        assert!(off == on, "{label}");
        for mut request in [constant(label, "on"), lit(label, "on"), lit(label, "off")] {
            let asked = draw(&geometry, &request).picture;
            request.all_effects = true;
            assert!(asked == draw(&geometry, &request).picture, "{label}");
        }
    }
}
