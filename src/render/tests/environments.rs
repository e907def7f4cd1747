//! What stands behind surfaces and in their mirrors, against the environment itself.

use glam::Vec3;

use super::*;
use crate::render::testing::direction_at;
use crate::scene::Environment;
use crate::scene::brdf::EnvironmentTable;
use crate::scene::environment::Sky;

fn under(environment: Environment) -> FrameRequest {
    let mut request = request("none");
    request.lighting.background = Background::Environment;
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    request.lighting.environment = Some(environment);
    request
}

fn assert_shows(frame: &RenderedFrame, pixel: (u32, u32), expected: Vec3, tolerance: i32) {
    let found = rgb(frame, pixel);
    for (found, expected) in found.into_iter().zip(expected.to_array()) {
        let expected = srgb8(expected.clamp(0.0, 1.0));
        assert!(
            (i32::from(found) - expected).abs() <= tolerance,
            "{pixel:?} shows {found}, not {expected}"
        );
    }
}

const CORNERS_AND_MIDDLE: [(u32, u32); 5] = [(0, 0), (159, 0), (80, 60), (0, 119), (159, 119)];

/// Behind no surface stands what the environment has in that direction, however it is turned.
#[test]
fn the_skybox_is_the_environment() {
    let axes = [0.9, 0.2, 0.6, 0.1, 0.4, 0.7].map(|v| Vec3::new(v, 0.5 * v, 1.0 - v));
    for turn_rad in [0.0, 1.2, -2.9] {
        let environment = Environment::from_axes(axes).turned(turn_rad).scaled(0.8);
        for target_m in [Vec3::ZERO, Vec3::Y * 10.0, Vec3::new(9.0, 1.0, 4.1)] {
            let mut request = under(environment.clone());
            request.camera.target_m = target_m;
            let frame = draw(&Geometry::default(), &request);
            for pixel in CORNERS_AND_MIDDLE {
                let expected = environment.radiance(direction_at(&request, pixel));
                assert_shows(&frame, pixel, expected, 1);
            }
        }
    }
}

#[test]
fn a_sky_is_seen_as_its_map_has_it() {
    let environment = Environment::sky(Sky::default()).scaled(0.05);
    let request = under(environment.clone());
    let frame = draw(&Geometry::default(), &request);
    for pixel in CORNERS_AND_MIDDLE {
        assert_shows(
            &frame,
            pixel,
            environment.radiance(direction_at(&request, pixel)),
            1,
        );
    }
}

fn metal(albedo: f32, roughness: f32) -> Material {
    Material {
        albedo: [albedo; 3],
        metallic: 1.0,
        roughness,
        ..Material::default()
    }
}

/// A metal in light of 1 from everywhere shows what its BRDF reflects of it, whatever the view.
#[test]
fn reflections_of_constant_light_are_the_table() {
    let table = EnvironmentTable::new();
    for roughness in [0.1, 0.5, 1.0] {
        let mut request = under(Environment::from_axes([Vec3::ONE; 6]));
        request.lighting.reflections = true;
        let frame = draw(
            &of_one_material(metal(0.7, roughness), vec![floor()]),
            &request,
        );
        for point in [
            Vec3::new(0.0, 0.0, 1.5),
            Vec3::ZERO,
            Vec3::new(1.0, 0.0, -3.0),
        ] {
            let pixel = pixel_of(&request, point);
            let n_dot_v = -direction_at(&request, pixel).y;
            let (scale, offset) = table.at(n_dot_v, roughness);
            assert_shows(&frame, pixel, Vec3::splat(0.7 * scale + offset), 2);
        }
    }
}

/// A polished floor shows the environment upside down.
#[test]
fn a_mirror_shows_the_environment() {
    let axes = [0.9, 0.2, 0.6, 0.1, 0.3, 0.8].map(Vec3::splat);
    let environment = Environment::from_axes(axes).turned(0.8);
    let mut request = under(environment.clone());
    request.lighting.reflections = true;
    let frame = draw(&of_one_material(metal(1.0, 0.0), vec![floor()]), &request);
    for point in [
        Vec3::new(0.5, 0.0, 1.5),
        Vec3::ZERO,
        Vec3::new(-1.0, 0.0, 1.0),
    ] {
        let pixel = pixel_of(&request, point);
        let mirrored = direction_at(&request, pixel) * Vec3::new(1.0, -1.0, 1.0);
        assert_shows(&frame, pixel, environment.radiance(mirrored), 3);
    }
}

/// Ambient light of an environment is its irradiance on the normal.
#[test]
fn a_floor_under_a_sky_has_its_irradiance() {
    let environment = Environment::sky(Sky::default()).turned(2.0).scaled(0.02);
    let mut request = under(environment.clone());
    request.lighting.ambient = Ambient::Environment;
    let frame = draw(&of_one_material(matte([0.5; 3]), vec![floor()]), &request);
    let expected = environment.irradiance().at(Vec3::Y) * 0.5 / std::f32::consts::PI;
    assert_shows(
        &frame,
        pixel_of(&request, Vec3::new(0.3, 0.0, 1.0)),
        expected,
        1,
    );
}

/// `KHR_lights_punctual`: whole inside the inner cone, nothing outside the outer, between them the square
/// of a straight line in the cosine.
#[test]
fn a_spot_light_ends_at_its_cone() {
    use crate::scene::{Cone, PointLight};
    let (inner, outer) = (0.2_f32, 0.5_f32);
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    request.lighting.points = vec![PointLight {
        position_m: Vec3::new(0.0, 2.0, 0.0),
        intensity: Vec3::splat(8.0),
        cone: Some(Cone {
            along: Vec3::NEG_Y,
            inner_rad: inner,
            outer_rad: outer,
        }),
    }];
    let frame = draw(&of_one_material(matte([0.8; 3]), vec![floor()]), &request);
    for angle in [0.0_f32, 0.15, 0.3, 0.4, 0.6] {
        let pixel = pixel_of(&request, Vec3::new(2.0 * angle.tan(), 0.0, 0.0));
        let direction = direction_at(&request, pixel);
        let point = request.camera.position_m - direction * (1.5 / direction.y);
        let apart = Vec3::new(0.0, 2.0, 0.0) - point;
        let cosine = apart.normalize().y;
        let edge = ((cosine - outer.cos()) / (inner.cos() - outer.cos())).clamp(0.0, 1.0);
        let irradiance = 8.0 * edge * edge * cosine / apart.length_squared();
        let expected = Vec3::splat(0.8 / std::f32::consts::PI * irradiance);
        assert_shows(&frame, pixel, expected, 2);
    }
}

/// The shaders' BRDF is the one whose energy `scene::brdf` is held to.
#[test]
fn sunlight_is_reflected_as_the_brdf_says() {
    use crate::scene::brdf::Finish;
    for (metallic, roughness) in [(0.0, 0.3), (1.0, 0.5), (0.4, 0.9)] {
        let mut request = request("none");
        request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
        let towards = Vec3::new(0.2, 0.8, -1.0).normalize();
        request.lighting.sun = Some(Sun {
            towards,
            irradiance: Vec3::splat(1.2),
            casts_shadows: false,
        });
        let material = Material {
            albedo: [0.6, 0.4, 0.2],
            specular: 0.04,
            metallic,
            roughness,
            ..Material::default()
        };
        let finish = Finish {
            albedo: Vec3::from(material.albedo),
            specular: 0.04,
            roughness,
            metallic,
        };
        let frame = draw(&of_one_material(material, vec![floor()]), &request);
        for x_m in [-1.5, -0.5, 0.0, 0.4, 1.2] {
            let pixel = pixel_of(&request, Vec3::new(x_m, 0.0, 0.5));
            let to_eye = -direction_at(&request, pixel);
            let expected = finish.brdf(Vec3::Y, to_eye, towards) * 1.2 * towards.y;
            // Albedo, specular, roughness and metalness are stored in eight bits.
            assert_shows(&frame, pixel, expected, 3);
        }
    }
}
