//! Light over many bounces: an integrating sphere, a furnace, black surfaces, and coloured ones.

use glam::Vec3;

use super::super::{Albedos, InterReflectionSettings, InterReflections, follow};
use super::shapes::{bowl, floor, geometry, hemisphere, point, seen, wall};
use super::*;
use crate::scene::procedural;
use crate::scene::{Camera, Material, Texture, TextureEncoding, TextureUse, Wrap};

fn following(
    geometry: &Geometry,
    points: Vec<SurfacePoint>,
    settings: &InterReflectionSettings,
) -> InterReflections {
    let bvh = SceneBvh::new(geometry);
    let points = RayTraced::new(&bvh, points.into_iter().map(Some).collect());
    follow(&points, &Albedos::of(geometry), settings, &|_| {}).unwrap()
}

/// A unit sphere from whose wall a cap is cut away that is `open` of its area.
fn cavity(open: f32, albedo: [f32; 3]) -> Geometry {
    let mut cavity = geometry(vec![bowl(96, (2.0 * open - 1.0).acos())]);
    cavity.materials[0].albedo = albedo;
    cavity
}

/// A point of its wall, with the sphere's own normal.
fn inside(cavity: &Geometry, towards: Vec3) -> SurfacePoint {
    let mut inside = point(cavity, Vec3::new(0.01, -0.01, 0.013), towards);
    inside.normal = -inside.position_m.normalize();
    inside
}

/// Every part of a sphere's wall receives from every other in proportion to its area. So a share s
/// comes from the opening, what is sent back goes on in the same parts, and E/E₀ = s/(1 − ρ(1−s))
/// at every point. The wall's pieces are flat, which changes 2e-4.
#[test]
fn a_cavity_is_an_integrating_sphere() {
    let (open, albedo) = (0.2_f32, [0.9, 0.5, 0.1]);
    let cavity = cavity(open, albedo);
    let towards = [Vec3::NEG_Y, Vec3::new(0.8, 0.3, 0.21)];
    let settings = InterReflectionSettings {
        error: 2e-3,
        max_paths: 1 << 18,
        bounces: 100,
        ..InterReflectionSettings::new(3)
    };
    let points = towards.map(|towards| inside(&cavity, towards)).to_vec();
    let found = following(&cavity, points, &settings);
    for place in 0..towards.len() {
        assert_near(found.direct[place], open.into(), 5e-3, "direct");
        for (channel, rho) in albedo.into_iter().enumerate() {
            let exact = f64::from(open / (1.0 - rho * (1.0 - open)));
            let error = f64::from(found.standard_error[place][channel]);
            assert!(error <= 2e-3);
            let value = found.irradiance[place][channel];
            assert_near(value, exact, 4.0 * error + 2e-4, "cavity");
        }
    }
    assert!(found.given_up.iter().all(|&light| light < 1e-5));
}

/// Over many estimates of one number (found − exact) / standard error has a mean square of 15/13
/// with 16 replicates, and a mean of 0. Of 200 they stray by 0.13 and 0.08 (one standard deviation).
#[test]
fn the_standard_error_of_bounced_light_is_what_it_says() {
    let cavity = cavity(0.4, [0.7; 3]);
    let points = vec![inside(&cavity, Vec3::new(0.8, -0.3, 0.21)); 200];
    let settings = InterReflectionSettings {
        error: 0.02,
        ..InterReflectionSettings::new(5)
    };
    let found = following(&cavity, points, &settings);
    let exact = 0.4 / (1.0 - 0.7 * 0.6);
    let z: Vec<f64> = (found.irradiance.iter().zip(&found.standard_error))
        .map(|(value, error)| (f64::from(value[0]) - exact) / f64::from(error[0]))
        .collect();
    let mean = z.iter().sum::<f64>() / 200.0;
    let square = z.iter().map(|z| z * z).sum::<f64>() / 200.0;
    assert!(mean.abs() < 0.35, "mean {mean}");
    assert!((0.7..1.8).contains(&square), "mean square {square}");
}

/// Where nothing absorbs, every path reaches the sky with all its light, or is given up with it:
/// in a bowl, and among the generator's shapes, of leaning shading normals too.
#[test]
fn a_white_furnace_loses_no_light() {
    let settings = InterReflectionSettings {
        error: 0.5,
        ..InterReflectionSettings::new(3)
    };
    let whole = |found: &InterReflections| {
        for (value, given_up) in found.irradiance.iter().zip(&found.given_up) {
            let sum = value.map(|value| f64::from(value) + f64::from(*given_up));
            assert!(sum.iter().all(|sum| (sum - 1.0).abs() < 1e-6), "{value:?}");
        }
    };
    let mut bowl = geometry(vec![hemisphere()]);
    bowl.materials[0].albedo = [1.0; 3];
    let found = following(&bowl, vec![inside(&bowl, Vec3::NEG_Y)], &settings);
    whole(&found);
    assert!(found.given_up[0] < 0.01 && found.irradiance[0][0] > 0.99);

    let mut shapes = (procedural::shapes::GENERATOR.generate)(0);
    for material in &mut shapes.materials {
        material.albedo = [1.0; 3];
        material.albedo_texture = None;
    }
    let bvh = SceneBvh::new(&shapes);
    let camera = Camera {
        position_m: Vec3::new(0.0, 3.0, 6.0),
        target_m: Vec3::ZERO,
        vertical_fov_rad: 0.8,
        near_m: 0.1,
        far_m: 100.0,
    };
    let mut surfaces = seen(&bvh, camera, (24, 16));
    for normal in &mut surfaces.normals {
        *normal = (*normal + Vec3::new(0.3, 0.1, 0.2)).normalize_or(Vec3::Y);
    }
    let points = RayTraced::of_visible(&bvh, &surfaces);
    let found = follow(&points, &Albedos::of(&shapes), &settings, &|_| {}).unwrap();
    assert!(found.surfaces > 50, "{}", found.surfaces);
    whole(&found);
}

/// Black surfaces leave what arrives directly, which is the cosine-weighted openness of
/// `estimate`, along other directions.
#[test]
fn without_albedo_what_arrives_is_cosine_weighted_openness() {
    let mut scene = geometry(vec![floor(50.0), wall(8.0, 1.7)]);
    scene.materials[0].albedo = [0.0; 3];
    let at = |z: f32| point(&scene, Vec3::new(0.3, 4.0, z), Vec3::NEG_Y);
    let mut points: Vec<SurfacePoint> = [0.2, 0.7, 3.0].map(at).to_vec();
    points[1].normal = Vec3::new(0.6, 0.8, 0.0);
    let settings = InterReflectionSettings {
        error: 1e-3,
        ..InterReflectionSettings::new(3)
    };
    let found = following(&scene, points.clone(), &settings);
    let openness = at_points(&scene, points, &precise(Weighting::Cosine));
    for (place, &wanted) in openness.occlusion.iter().enumerate() {
        let [red, green, blue] = found.irradiance[place];
        assert!(red == green && green == blue && red == found.direct[place]);
        assert_near(red, wanted.into(), 5e-3, "openness");
    }
}

/// A black floor before a wall whose left half is red and right half is green: what bounces off it.
fn before_a_painted_wall(rgba8: Vec<u8>) -> InterReflections {
    let mut painted = wall(3.0, 2.0);
    painted.material = 1;
    let mut scene = geometry(vec![floor(50.0), painted]);
    scene.materials[0].albedo = [0.0; 3];
    scene.materials.push(Material {
        albedo: [1.0; 3],
        albedo_texture: Some(TextureUse::from(0)),
        ..Material::default()
    });
    scene.textures.push(Texture {
        name: String::from("paint"),
        width_px: 2,
        height_px: 1,
        rgba8,
        encoding: TextureEncoding::Srgb,
        wrap: [Wrap::Clamp; 2],
    });
    let at = |x: f32| point(&scene, Vec3::new(x, 4.0, 0.8), Vec3::NEG_Y);
    let settings = InterReflectionSettings {
        error: 1e-3,
        max_paths: 1 << 15,
        ..InterReflectionSettings::new(3)
    };
    following(&scene, [-1.0, 0.0, 1.0].map(at).to_vec(), &settings)
}

#[test]
fn the_colour_of_a_bounce_is_that_of_the_texture_where_it_falls() {
    let painted = before_a_painted_wall(vec![255, 0, 0, 255, 0, 255, 0, 255]);
    let plain = before_a_painted_wall(vec![255; 8]);
    let bounced = |found: &InterReflections, place: usize| {
        found.irradiance[place].map(|value| value - found.direct[place])
    };
    for place in 0..3 {
        let [red, green, blue] = bounced(&painted, place);
        assert_eq!(blue, 0.0);
        let [whole, ..] = bounced(&plain, place);
        assert!(whole > 0.05);
        assert_near(red + green, whole.into(), 5e-3, "both halves");
    }
    let [
        [left_red, left_green, _],
        [red, green, _],
        [right_red, right_green, _],
    ] = [0, 1, 2].map(|place| bounced(&painted, place));
    assert_near(red, green.into(), 5e-3, "the middle");
    assert!(left_red > 3.0 * left_green && right_green > 3.0 * right_red);
}

#[test]
fn the_number_of_threads_changes_no_bit_of_bounced_light() {
    let scene = geometry(vec![floor(50.0), wall(8.0, 1.7)]);
    let at = |k: usize| point(&scene, Vec3::new(0.1, 4.0, 0.1 + k as f32), Vec3::NEG_Y);
    let points: Vec<SurfacePoint> = (0..4).map(at).collect::<Vec<_>>().repeat(150);
    let with = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let settings = InterReflectionSettings {
            error: 0.05,
            ..InterReflectionSettings::new(seed)
        };
        pool.install(|| following(&scene, points.clone(), &settings))
    };
    assert_eq!(with(1, 3), with(2, 3));
    assert_ne!(with(2, 3), with(2, 4));
}

/// What a limit on bounces loses is no more than what it says was given up.
#[test]
fn what_is_given_up_bounds_what_is_lost() {
    let cavity = cavity(0.2, [0.9, 0.5, 0.1]);
    let with = |bounces| {
        let settings = InterReflectionSettings {
            error: 5e-3,
            bounces,
            ..InterReflectionSettings::new(3)
        };
        following(&cavity, vec![inside(&cavity, Vec3::X)], &settings)
    };
    let (none, three, all) = (with(0), with(3), with(200));
    assert_eq!(none.irradiance[0], [none.direct[0]; 3]);
    let (short, bound) = (three.irradiance[0][0], three.given_up[0]);
    assert!(short + 0.1 < all.irradiance[0][0]);
    assert!(short + bound + 0.02 > all.irradiance[0][0]);
}

#[test]
fn settings_of_bounced_light_out_of_range_are_refused() {
    let good = InterReflectionSettings::new(1);
    assert!(good.check().is_ok());
    let bad = |change: fn(&mut InterReflectionSettings)| {
        let mut settings = good;
        change(&mut settings);
        settings.check().unwrap_err().setting
    };
    assert_eq!(bad(|s| s.error = f64::NAN), "error");
    assert_eq!(bad(|s| s.max_paths = 63), "max-paths");
    assert_eq!(bad(|s| s.min_paths = 1 << 20), "min-paths");
    assert_eq!(bad(|s| s.bounces = 1001), "bounces");
}
