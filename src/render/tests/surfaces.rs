//! What surfaces and requests come to.

use glam::Vec3;

use super::*;

#[test]
fn the_same_request_gives_the_same_bytes() {
    let geometry = floor_and_wall([0.7, 0.5, 0.3]);
    for technique in ["none", "crytek24", "blizzard8", "ray-march30"] {
        let first = draw(&geometry, &request(technique));
        let second = draw(&geometry, &request(technique));
        assert_eq!(first.picture, second.picture, "{technique}");
    }
}

#[test]
fn a_surface_in_constant_light_has_its_albedo() {
    let request = request("none");
    let frame = draw(&of_one_material(matte([0.4; 3]), vec![floor()]), &request);
    assert_level(
        rgb(&frame, pixel_of(&request, Vec3::new(0.5, 0.0, 1.0))),
        0.4,
    );
    assert!(frame.occlusion.is_none());
    let names: Vec<&str> = frame.passes.iter().map(|pass| pass.pass.as_str()).collect();
    assert_eq!(names, ["geometry", "shade"]);
}

#[test]
fn an_empty_scene_is_its_background() {
    for technique in ["none", "blizzard8"] {
        let mut request = request(technique);
        request.lighting.background = Background::Colour(Vec3::splat(0.25));
        let frame = draw(&Geometry::default(), &request);
        for pixel in [(0, 0), (80, 60), (159, 119)] {
            assert_level(rgb(&frame, pixel), 0.25);
        }
    }
}

/// Corners move to a grid of 1/16 pixel, the coarsest that adapters rasterise on, so that finer
/// ones draw the same: what lies within a step of the grid is one picture, what lies beyond is not.
#[test]
fn corners_lie_on_a_grid_that_every_adapter_has() {
    let mut request = request("none");
    request.camera.position_m = Vec3::new(0.0, 0.0, 3.0);
    request.camera.target_m = Vec3::ZERO;
    request.supersampling = 4;
    let half_m = request.camera.half_extent_at_1m(request.aspect()).1 * 3.0;
    let texel_m = 2.0 * half_m / 480.0;
    // A slanted edge, so that a shift of any size would move it over some sample.
    let at = |step: f32| {
        let mut shape = quad(
            "sheet",
            Vec3::ZERO,
            Vec3::X * 200.0 * texel_m,
            Vec3::Y * texel_m,
        );
        let corners_px = [
            [-170.0, -90.0],
            [60.0, -171.0],
            [150.0, 120.0],
            [-80.0, 190.0],
        ];
        for (vertex, [x, y]) in shape.vertices.iter_mut().zip(corners_px) {
            vertex.position_m = [(x + step) * texel_m, (y + step) * texel_m, 0.0];
        }
        draw(&of_one_material(matte([0.2; 3]), vec![shape]), &request).picture
    };
    let on_it = at(0.0);
    for within in [-0.02, 0.02] {
        assert_eq!(at(within), on_it, "{within} of a texel");
    }
    for beyond in [-0.05, 0.05] {
        assert_ne!(at(beyond), on_it, "{beyond} of a texel");
    }
}

/// The supersampled image of a smooth scene is the plain one, up to its edges.
#[test]
fn supersampling_changes_edges_only() {
    let plain = request("blizzard24");
    let fine = FrameRequest {
        supersampling: 2,
        ..plain.clone()
    };
    let geometry = floor_and_wall([0.6; 3]);
    let (plain, fine) = (
        draw(&geometry, &plain).picture,
        draw(&geometry, &fine).picture,
    );
    let differing = plain
        .rgba8
        .chunks_exact(4)
        .zip(fine.rgba8.chunks_exact(4))
        .filter(|(a, b)| a[0].abs_diff(b[0]) > 6)
        .count();
    assert!(differing < 160 * 120 / 20, "{differing} pixels differ");
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let scene = renderer().upload(&Geometry::default()).unwrap();
    let mut large = request("none");
    (large.width_px, large.supersampling) = (100_000, 2);
    let message = renderer().render(&scene, &large).unwrap_err().to_string();
    assert!(message.contains("200000"), "{message}");
    let mut broken = floor_and_wall([1.0; 3]);
    broken.meshes[1].material = 7;
    let message = renderer().upload(&broken).err().unwrap().to_string();
    assert!(
        message.contains("wall") && message.contains('7'),
        "{message}"
    );
    let message = Gpu::open(Some("no such adapter")).unwrap_err().to_string();
    assert!(message.contains("no such adapter"), "{message}");
}

/// A texture of two columns, one opaque and one not: where alpha is below the cutoff the
/// floor shows nothing, and light falls through.
#[test]
fn an_alpha_mask_cuts_holes() {
    let mut request = request("none");
    request.lighting.background = Background::Colour(Vec3::splat(0.9));
    let mut geometry = of_one_material(matte([0.2; 3]), vec![floor()]);
    geometry.textures.push(Texture {
        name: String::from("half"),
        width_px: 2,
        height_px: 1,
        rgba8: vec![255, 255, 255, 255, 255, 255, 255, 0],
        encoding: TextureEncoding::Srgb,
        wrap: [Wrap::Clamp; 2],
    });
    geometry.materials[0].albedo_texture = Some(0.into());
    geometry.materials[0].alpha_cutoff = Some(0.5);
    let frame = draw(&geometry, &request);
    // The floor's texture coordinates run from 0 to 1 along x.
    assert_level(
        rgb(&frame, pixel_of(&request, Vec3::new(-1.0, 0.0, 1.0))),
        0.2,
    );
    assert_level(
        rgb(&frame, pixel_of(&request, Vec3::new(1.0, 0.0, 1.0))),
        0.9,
    );
    // Moved by half a texture, the hole is everywhere on the right and on the left.
    let moved = TextureUse {
        texture: 0,
        transform: glam::Affine2::from_translation(glam::Vec2::new(0.5, 0.0)),
    };
    geometry.materials[0].albedo_texture = Some(moved);
    let frame = draw(&geometry, &request);
    assert_level(
        rgb(&frame, pixel_of(&request, Vec3::new(-0.5, 0.0, 1.0))),
        0.9,
    );
}
