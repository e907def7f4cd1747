//! Directional occlusion: which light is lost, and what comes back from what hides it.

use glam::Vec3;

use super::*;
use crate::scene::Environment;

/// Looks at the origin from an angle to the vertical.
fn seen_from(from_normal_deg: f32) -> FrameRequest {
    let mut request = request("ssdo");
    let (sin, cos) = from_normal_deg.to_radians().sin_cos();
    request.camera.position_m = Vec3::new(0.0, cos, sin) * 3.0;
    request.camera.target_m = Vec3::ZERO;
    request.camera.near_m = 0.001;
    request
}

fn without(request: &FrameRequest) -> FrameRequest {
    FrameRequest {
        occlusion: Settings::from_label("none").unwrap(),
        ..request.clone()
    }
}

/// Linear radiance of a pixel, as far as eight bits say it.
fn linear(frame: &RenderedFrame, pixel: (u32, u32)) -> Vec3 {
    Vec3::from(rgb(frame, pixel).map(|level| crate::scene::srgb::decode(f32::from(level) / 255.0)))
}

/// Mean linear radiance of a row of points.
fn mean(frame: &RenderedFrame, request: &FrameRequest, points: impl Iterator<Item = Vec3>) -> Vec3 {
    let values: Vec<Vec3> = points
        .map(|point| linear(frame, pixel_of(request, point)))
        .collect();
    values.iter().sum::<Vec3>() / values.len() as f32
}

/// Nothing is hidden on a plane, and nothing changes there: not k_A, and not a byte of the picture.
#[test]
fn an_open_plane_is_open_and_without_noise() {
    let geometry = of_one_material(matte([0.5, 0.4, 0.3]), vec![floor()]);
    for from_normal_deg in [0.5, 45.0, 60.0, 80.0, 89.0, 89.9] {
        let mut request = seen_from(from_normal_deg);
        request.lighting.environment = brightest("none").lighting.environment;
        request.lighting.ambient = Ambient::Environment;
        let frame = draw(&geometry, &request);
        let least =
            (frame.occlusion.as_ref().unwrap().values.iter()).fold(1.0_f32, |a, &b| a.min(b));
        assert!(least > 0.998, "{from_normal_deg}° from the normal: {least}");
        let bare = draw(&geometry, &without(&request));
        assert!(frame.picture == bare.picture, "{from_normal_deg}°");
    }
}

#[test]
fn the_foot_of_a_wall_is_darker_than_its_top_edge() {
    for resolution in ["full", "half"] {
        let mut request = request("ssdo");
        request.occlusion.set("resolution", resolution).unwrap();
        request.occlusion.set("bounce", 0.0).unwrap();
        let frame = draw(&floor_and_wall([1.0; 3]), &request);
        let row = |y_m: f32| (-8..=8).map(move |i| Vec3::new(i as f32 * 0.1, y_m, 0.0));
        let (foot, top) = (
            mean(&frame, &request, row(0.05)).x,
            mean(&frame, &request, row(1.55)).x,
        );
        assert!(foot < top - 0.1, "{resolution}: foot {foot}, top {top}");
        // In one light from everywhere, what is lost is what k_A says.
        let occlusion = frame.occlusion.as_ref().unwrap();
        for point in row(0.05).chain(row(0.4)) {
            let (x, y) = pixel_of(&request, point);
            let level = linear(&frame, (x, y)).x;
            assert!((level - occlusion.at(x, y)).abs() < 0.01, "{point}");
        }
    }
}

/// A white floor before a red wall.
fn red_wall() -> Geometry {
    let mut geometry = floor_and_wall([1.0; 3]);
    geometry.materials.push(matte([0.9, 0.05, 0.05]));
    geometry.meshes[1].material = 1;
    geometry
}

/// Before a red wall the floor is red, and nowhere else.
#[test]
fn a_red_wall_tints_the_floor_before_it() {
    for resolution in ["full", "half"] {
        let mut request = request("ssdo");
        request.occlusion.set("resolution", resolution).unwrap();
        let row = |z_m: f32| (-8..=8).map(move |i| Vec3::new(i as f32 * 0.1, 0.0, z_m));
        let frame = draw(&red_wall(), &request);
        let near = mean(&frame, &request, row(0.08));
        assert!(near.x > near.y + 0.03, "{resolution}: {near}");
        assert!((near.y - near.z).abs() < 0.005, "{resolution}: {near}");
        for z_m in [1.2, 1.5] {
            let far = mean(&frame, &request, row(z_m));
            assert!(far.x == far.y && far.x > 0.99, "{resolution}: {far}");
        }
        request.occlusion.set("bounce", 0.0).unwrap();
        let grey = mean(&draw(&red_wall(), &request), &request, row(0.08));
        assert!((grey.x - grey.y).abs() < 0.005, "{grey}");
        assert!(grey.x < near.x, "a bounce brightens");
    }
}

/// Sunlight on a wall comes back to the floor, even where there is no ambient light; a wall in shadow
/// sends nothing.
#[test]
fn sunlight_bounces_off_a_lit_wall() {
    let mut request = request("ssdo");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    let mut gain = |towards: Vec3| {
        request.lighting.sun = Some(Sun {
            towards: towards.normalize(),
            irradiance: Vec3::splat(1.0),
            casts_shadows: true,
        });
        let row = || (-8..=8).map(|i| Vec3::new(i as f32 * 0.1, 0.0, 0.08));
        let [with, bare] = [request.clone(), without(&request)]
            .map(|request| mean(&draw(&red_wall(), &request), &request, row()));
        with - bare
    };
    let lit = gain(Vec3::new(0.0, 0.5, 1.0));
    assert!(lit.x > 0.02 && lit.x > 4.0 * lit.y, "{lit}");
    let shadowed = gain(Vec3::new(0.0, 0.5, -1.0));
    assert!(shadowed.abs().max_element() < 0.002, "{shadowed}");
}

/// Light comes from +x. The wall on that side takes it from the floor at its foot; the wall on the other side
/// takes hardly any, though as much of the sky is hidden there.
#[test]
fn a_wall_takes_the_light_that_comes_from_behind_it() {
    let wall = |x_m: f32| {
        cuboid(
            "wall",
            Vec3::new(x_m - 0.1, 0.0, -1.0),
            Vec3::new(x_m + 0.1, 1.2, 1.0),
        )
    };
    let meshes = vec![floor(), wall(-1.1), wall(1.1)];
    let geometry = of_one_material(matte([0.8; 3]), meshes);
    let mut request = request("ssdo");
    request.camera.position_m = Vec3::new(0.0, 3.0, 4.0);
    request.camera.target_m = Vec3::ZERO;
    request.occlusion.set("bounce", 0.0).unwrap();
    request.lighting.ambient = Ambient::Environment;
    let axes = [2.0, 0.0, 0.3, 0.3, 0.3, 0.3].map(Vec3::splat);
    request.lighting.environment = Some(Environment::from_axes(axes));
    let frame = draw(&geometry, &request);
    let bare = draw(&geometry, &without(&request));
    let occlusion = frame.occlusion.as_ref().unwrap();
    let foot = |x_m: f32| {
        let row = || (-3..=6).map(move |i| Vec3::new(x_m, 0.0, i as f32 * 0.1));
        let share = mean(&frame, &request, row()).x / mean(&bare, &request, row()).x;
        let k: f32 = row()
            .map(|point| pixel_of(&request, point))
            .map(|(x, y)| occlusion.at(x, y))
            .sum();
        (share, k / 10.0)
    };
    let ((shaded, k_shaded), (lit, k_lit)) = (foot(0.9), foot(-0.9));
    assert!((k_shaded - k_lit).abs() < 0.06, "{k_shaded} {k_lit}");
    assert!(k_shaded < 0.9, "{k_shaded}");
    assert!(shaded < k_shaded - 0.1, "{shaded} {k_shaded}");
    assert!(lit > k_lit + 0.05, "{lit} {k_lit}");
}

/// Running every effect changes no byte of a picture that says its occlusion by direction.
#[test]
fn every_effect_leaves_the_picture_alone() {
    let geometry = red_wall();
    let mut half = brightest("ssdo");
    half.occlusion.set("resolution", "half").unwrap();
    let mut unshadowed = brightest("ssdo");
    unshadowed.lighting.sun.as_mut().unwrap().casts_shadows = false;
    unshadowed.lighting.reflections = false;
    let thesis = FrameRequest {
        precision: Precision::Thesis,
        ..request("ssdo")
    };
    for request in [
        request("ssdo"),
        brightest("ssdo"),
        half,
        unshadowed,
        thesis,
        brightest("two-band"),
    ] {
        let all = FrameRequest {
            all_effects: true,
            ..request.clone()
        };
        let (asked, all) = (draw(&geometry, &request), draw(&geometry, &all));
        assert!(asked.picture == all.picture, "{:?}", request.lighting);
    }
}
