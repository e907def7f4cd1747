//! Effects that run because they are called for.

use glam::Vec3;

use super::*;

/// A lamp that shines, a curtain with a hole, a mirror and a floor: every effect has
/// something to do.
fn everything() -> Geometry {
    let lamp = Material {
        emission: [2.0, 1.0, 0.5],
        ..matte([0.1; 3])
    };
    let mirror = Material {
        roughness: 0.2,
        metallic: 1.0,
        ..matte([0.9; 3])
    };
    let mut geometry = of_one_material(matte([0.6, 0.5, 0.4]), vec![floor()]);
    for (material, mesh) in [
        (
            lamp,
            cuboid(
                "lamp",
                Vec3::new(-1.2, 0.0, -0.4),
                Vec3::new(-0.8, 0.5, 0.0),
            ),
        ),
        (
            mirror,
            cuboid(
                "mirror",
                Vec3::new(0.5, 0.0, -0.6),
                Vec3::new(1.2, 1.0, 0.1),
            ),
        ),
    ] {
        geometry.materials.push(material);
        geometry.meshes.push(Mesh {
            material: geometry.materials.len() - 1,
            ..mesh
        });
    }
    geometry
}

/// Leaving a pass out is no approximation: run at weight nought, it changes no byte.
#[test]
fn running_every_effect_changes_no_byte() {
    let scenes = [floor_and_wall([0.7, 0.5, 0.3]), everything()];
    let mut requests = Vec::new();
    for technique in ["none", "crytek24", "blizzard8"] {
        requests.extend([request(technique), brightest(technique)]);
        let mut shadowless = brightest(technique);
        shadowless.lighting.sun.as_mut().unwrap().casts_shadows = false;
        let mut plain = brightest(technique);
        plain.lighting.reflections = false;
        plain.lighting.background = Background::Colour(Vec3::new(0.18, 0.3, 0.7));
        plain.lighting.points.clear();
        let mut unblurred = request(technique);
        (unblurred.supersampling, unblurred.blur_radius_px) = (2, 0);
        unblurred.lighting.background = Background::Colour(Vec3::new(0.18, 0.3, 0.7));
        requests.extend([shadowless, plain, unblurred]);
    }
    for geometry in &scenes {
        for request in &requests {
            let all = FrameRequest {
                all_effects: true,
                ..request.clone()
            };
            let (asked, all) = (draw(geometry, request), draw(geometry, &all));
            assert_eq!(all.passes.len(), 14 - 1, "all but the shade pass");
            assert!(asked.passes.len() <= all.passes.len());
            assert!(
                asked.picture == all.picture,
                "{} {:?}",
                request.occlusion.label,
                request.lighting
            );
        }
    }
}

/// Surfaces and shadows drawn for one image serve the next, byte for byte.
#[test]
fn sharing_between_images_changes_no_byte() {
    let geometry = everything();
    let scene = renderer().upload(&geometry).unwrap();
    let mut view = renderer().view(&scene);
    let mut unlit = brightest("crytek24");
    unlit.lighting.sun = None;
    let mut turned = brightest("blizzard8");
    turned.lighting.sun.as_mut().unwrap().towards = Vec3::Y;
    for (index, request) in [
        request("none"),
        brightest("none"),
        brightest("blizzard8"),
        unlit,
        brightest("none"),
        turned,
    ]
    .iter()
    .enumerate()
    {
        let shared = view.render(request).unwrap();
        assert!(
            shared.picture == draw(&geometry, request).picture,
            "image {index}"
        );
        let is_shared = |pass: &str| shared.passes.iter().any(|p| p.pass == pass && p.shared);
        assert_eq!(is_shared("geometry"), index >= 2, "image {index}");
        assert_eq!(
            is_shared("shadow-map"),
            index == 2 || index == 4,
            "image {index}"
        );
    }
}

/// Each buffer shows what it is named after.
#[test]
fn buffers_are_what_the_frame_is_made_of() {
    let geometry = floor_and_wall([0.5, 0.25, 0.125]);
    let scene = renderer().upload(&geometry).unwrap();
    for (supersampling, precision) in [
        (1, Precision::Full),
        (2, Precision::Full),
        (2, Precision::Thesis),
    ] {
        let mut request = request("blizzard8");
        (request.supersampling, request.precision) = (supersampling, precision);
        let buffers = renderer().view(&scene).buffers(&request).unwrap();
        assert_eq!(
            buffers
                .iter()
                .map(|(buffer, _)| *buffer)
                .collect::<Vec<_>>(),
            Buffer::ALL
        );
        let at = |buffer: Buffer, point: Vec3| {
            let (_, picture) = buffers.iter().find(|(b, _)| *b == buffer).unwrap();
            let (x, y) = pixel_of(&request, point);
            let i = 4 * (y * picture.width_px + x) as usize;
            [0, 1, 2].map(|c| i32::from(picture.rgba8[i + c]))
        };
        let (near, wall) = (Vec3::new(0.2, 0.0, 1.2), Vec3::new(0.2, 0.8, 0.0));
        let expected = [0.5, 0.25, 0.125].map(srgb8);
        for (found, expected) in at(Buffer::Albedo, near).into_iter().zip(expected) {
            assert!((found - expected).abs() <= 1);
        }
        for (point, expected) in [(near, [128, 255, 128]), (wall, [128, 128, 255])] {
            for (found, expected) in at(Buffer::Normals, point).into_iter().zip(expected) {
                assert!((found - expected).abs() <= 1, "{found} {expected}");
            }
        }
        assert!(at(Buffer::Depth, near)[0] > at(Buffer::Depth, wall)[0] + 20);
        assert_eq!(buffers[5].1, draw(&geometry, &request).picture);
    }
}

/// A wall across the whole view leaves no pixel to the sky.
#[test]
fn no_skybox_where_surfaces_cover_every_pixel() {
    let request = brightest("none");
    let has_sky = |geometry: &Geometry| {
        let frame = draw(geometry, &request);
        frame.passes.iter().any(|pass| pass.pass == "skybox")
    };
    assert!(has_sky(&floor_and_wall([0.5; 3])));
    let wall = quad(
        "wall",
        Vec3::new(-9.0, -9.0, 1.0),
        Vec3::X * 18.0,
        Vec3::Y * 18.0,
    );
    assert!(!has_sky(&of_one_material(matte([0.5; 3]), vec![wall])));
}
