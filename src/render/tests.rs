//! Frames of scenes whose answer is known, on whatever adapter there is.

use std::sync::OnceLock;

use glam::Vec3;

use super::technique::{Settings, TECHNIQUES};
use super::testing::{brightest, request};
use super::*;
use crate::scene::primitives::{cuboid, of_one_material, quad};
use crate::scene::{Ambient, Background, Geometry, Material, Mesh, Sun};

fn renderer() -> &'static Renderer {
    static RENDERER: OnceLock<Renderer> = OnceLock::new();
    RENDERER.get_or_init(|| {
        Renderer::new(Gpu::open(None).expect("tests need an adapter: mesa-vulkan-drivers has one"))
    })
}

fn matte(albedo: [f32; 3]) -> Material {
    Material {
        albedo,
        specular: 0.0,
        roughness: 1.0,
        ..Material::default()
    }
}

fn floor() -> Mesh {
    quad(
        "floor",
        Vec3::new(-6.0, 0.0, 6.0),
        Vec3::X * 12.0,
        Vec3::NEG_Z * 12.0,
    )
}

/// A floor with a wall standing on it, 1.6 m high and free above.
fn floor_and_wall(albedo: [f32; 3]) -> Geometry {
    let wall = cuboid("wall", Vec3::new(-1.5, 0.0, -0.5), Vec3::new(1.5, 1.6, 0.0));
    of_one_material(matte(albedo), vec![floor(), wall])
}

fn draw(geometry: &Geometry, request: &FrameRequest) -> RenderedFrame {
    let scene = renderer().upload(geometry).unwrap();
    renderer().render(&scene, request).unwrap()
}

/// The pixel a point is seen at.
fn pixel_of(request: &FrameRequest, point: Vec3) -> (u32, u32) {
    let clip =
        (request.camera.projection(request.aspect()) * request.camera.view()).project_point3(point);
    let x = (clip.x * 0.5 + 0.5) * request.width_px as f32;
    let y = (0.5 - clip.y * 0.5) * request.height_px as f32;
    (x as u32, y as u32)
}

fn rgb(frame: &RenderedFrame, (x, y): (u32, u32)) -> [u8; 3] {
    let at = 4 * (y * frame.picture.width_px + x) as usize;
    [
        frame.picture.rgba8[at],
        frame.picture.rgba8[at + 1],
        frame.picture.rgba8[at + 2],
    ]
}

/// IEC 61966-2-1, to the nearest 8-bit level.
fn srgb8(linear: f32) -> i32 {
    let encoded = if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0).round() as i32
}

fn assert_level(found: [u8; 3], linear: f32) {
    for channel in found {
        assert!(
            (i32::from(channel) - srgb8(linear)).abs() <= 1,
            "{found:?} is not {}",
            srgb8(linear)
        );
    }
}

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

/// Lambert: irradiance π/2 on albedo 0.8 from straight above is radiance 0.4; at 60° half of it.
#[test]
fn the_directional_light_follows_lambert() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    for (towards, expected) in [
        (Vec3::Y, 0.4),
        (Vec3::new(3.0_f32.sqrt() / 2.0, 0.5, 0.0), 0.2),
        (Vec3::new(0.5, -0.5, 0.5).normalize(), 0.0),
    ] {
        request.lighting.sun = Some(Sun {
            towards,
            irradiance: Vec3::splat(std::f32::consts::FRAC_PI_2),
            casts_shadows: true,
        });
        let frame = draw(&of_one_material(matte([0.8; 3]), vec![floor()]), &request);
        assert_level(
            rgb(&frame, pixel_of(&request, Vec3::new(0.3, 0.0, 1.0))),
            expected,
        );
    }
}

#[test]
fn a_box_casts_its_shadow_where_geometry_says() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    request.lighting.sun = Some(Sun {
        towards: Vec3::new(1.0, 1.0, 0.0).normalize(),
        irradiance: Vec3::splat(3.0),
        casts_shadows: true,
    });
    // At 45° a box 1 m high shades 1 m of floor on its −X side.
    let tower = cuboid("box", Vec3::new(0.0, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5));
    let frame = draw(
        &of_one_material(matte([0.8; 3]), vec![floor(), tower]),
        &request,
    );
    let lit = |x: f32| rgb(&frame, pixel_of(&request, Vec3::new(x, 0.0, 0.3)))[0] > 20;
    assert!(!lit(-0.1), "the foot of the box leaks light");
    assert!(!lit(-0.5));
    assert!(!lit(-0.9));
    assert!(lit(-1.15));
    assert!(lit(0.8));
}

/// The meaning that the listings' signs must have: what stands in front occludes. Before the foot
/// of a wall the floor stands in front of it; before its free top edge and its middle stands
/// nothing. With the sign of appendix B as printed the top edge would darken, and the foot not.
#[test]
fn the_foot_of_a_wall_darkens_and_its_top_edge_does_not() {
    for technique in ["crytek24", "blizzard24", "ray-march30"] {
        let request = request(technique);
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
        let (foot, middle, top) = (mean(0.05), mean(0.8), mean(1.55));
        assert!(
            foot < top - 0.03,
            "{technique}: foot {foot}, top edge {top}"
        );
        assert!(
            foot < middle - 0.03,
            "{technique}: foot {foot}, middle {middle}"
        );
        assert!(
            top > middle - 0.03,
            "{technique}: top edge {top}, middle {middle}"
        );
    }
}

/// Thesis eq. 5: the coefficient stands before the ambient term, and only there.
#[test]
fn occlusion_scales_the_ambient_term_alone() {
    let geometry = floor_and_wall([0.5; 3]);
    let request = request("blizzard24");
    let frame = draw(&geometry, &request);
    let occlusion = frame.occlusion.as_ref().unwrap();
    for point in [
        Vec3::new(0.0, 0.0, 0.1),
        Vec3::new(-0.7, 0.9, 0.0),
        Vec3::new(0.9, 0.0, 1.2),
    ] {
        let (x, y) = pixel_of(&request, point);
        assert_level(rgb(&frame, (x, y)), 0.5 * occlusion.at(x, y));
    }
    let sunlit = |technique: &str| {
        let mut request = request.clone();
        request.occlusion = Settings::from_label(technique).unwrap();
        request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
        request.lighting.sun = Some(Sun {
            towards: Vec3::new(0.3, 1.0, 0.5).normalize(),
            irradiance: Vec3::ONE,
            casts_shadows: true,
        });
        draw(&geometry, &request).picture
    };
    assert_eq!(sunlit("none"), sunlit("blizzard24"));
}

/// Whatever the scene and the parameters: a number from 0 to 1.
#[test]
fn degenerate_frames_stay_finite() {
    let near_wall = quad("near", Vec3::new(-1.0, 1.0, 3.94), Vec3::X * 2.0, Vec3::Y);
    let pole = cuboid("pole", Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.21, 3.0, 0.01));
    let scenes = [
        of_one_material(matte([0.5; 3]), vec![floor()]),
        of_one_material(matte([0.5; 3]), vec![floor(), near_wall]),
        of_one_material(matte([0.5; 3]), vec![pole]),
    ];
    for technique in TECHNIQUES
        .iter()
        .filter(|technique| technique.shader.is_some())
    {
        for scene in &scenes {
            for extreme in [0.0, 0.5, 1.0] {
                let mut request = request(technique.name);
                for parameter in technique.parameters.iter().filter(|p| p.multiple_of == 0.0) {
                    let value = parameter.low + extreme * (parameter.high - parameter.low);
                    request.occlusion.set(parameter.name, value).unwrap();
                }
                let occlusion = draw(scene, &request).occlusion.unwrap();
                let worst = occlusion.values.iter().find(|k| !(0.0..=1.0).contains(*k));
                assert_eq!(worst, None, "{} at {extreme}", technique.name);
            }
        }
    }
}

/// With no room to look round, nothing can be found in front.
#[test]
fn a_radius_of_nothing_is_open() {
    for technique in ["blizzard24", "ray-march30"] {
        let mut request = request(technique);
        request.occlusion.set("radius_m", 0.0).unwrap();
        let occlusion = draw(&floor_and_wall([1.0; 3]), &request).occlusion.unwrap();
        assert!(occlusion.values.iter().all(|&k| k == 1.0), "{technique}");
    }
}

#[test]
fn thesis_precision_stays_close_to_full() {
    let full = request("blizzard24");
    let thesis = FrameRequest {
        precision: Precision::Thesis,
        ..full.clone()
    };
    let geometry = floor_and_wall([1.0; 3]);
    let (full, thesis) = (draw(&geometry, &full), draw(&geometry, &thesis));
    let (full, thesis) = (full.occlusion.unwrap(), thesis.occlusion.unwrap());
    let mean = full
        .values
        .iter()
        .zip(&thesis.values)
        .map(|(a, b)| (a - b).abs())
        .sum::<f32>()
        / full.values.len() as f32;
    // 8-bit normals are off by up to 0.4°, 8-bit occlusion by up to 0.002, three passes of it.
    assert!(mean > 0.0 && mean < 0.01, "{mean}");
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

/// Inverse square and Lambert: intensity π/2 from 0.5 m straight above albedo 0.8 is an
/// irradiance of 2π and a radiance of 1.6; from 1 m it is a quarter of that.
#[test]
fn a_point_light_falls_with_the_square() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    let spot = Vec3::new(0.3, 0.0, 1.0);
    for (height_m, cone, expected) in [
        (1.0, None, 0.4),
        (2.0, None, 0.1),
        (1.0, Some((Vec3::NEG_Y, 0.2, 0.4)), 0.4),
        (1.0, Some((Vec3::X, 0.2, 0.4)), 0.0),
    ] {
        request.lighting.points = vec![crate::scene::PointLight {
            position_m: spot + Vec3::Y * height_m,
            intensity: Vec3::splat(std::f32::consts::FRAC_PI_2),
            cone: cone.map(|(along, inner_rad, outer_rad)| crate::scene::Cone {
                along,
                inner_rad,
                outer_rad,
            }),
        }];
        let frame = draw(&of_one_material(matte([0.8; 3]), vec![floor()]), &request);
        assert_level(rgb(&frame, pixel_of(&request, spot)), expected);
    }
}

#[test]
fn emission_and_unlit_surfaces_show_their_own_light() {
    let request = request("none");
    let spot = pixel_of(&request, Vec3::new(0.3, 0.0, 1.0));
    let lamp = Material {
        emission: [0.3; 3],
        ..matte([0.2; 3])
    };
    let frame = draw(&of_one_material(lamp, vec![floor()]), &request);
    assert_level(rgb(&frame, spot), 0.5);
    let unlit = Material {
        unlit: true,
        ..matte([0.35; 3])
    };
    let mut dark = request.clone();
    dark.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    let frame = draw(&of_one_material(unlit, vec![floor()]), &dark);
    assert_level(rgb(&frame, spot), 0.35);
}

/// A texture of two columns, one opaque and one not: where alpha is below the cutoff the
/// floor shows nothing, and light falls through.
#[test]
fn an_alpha_mask_cuts_holes() {
    use crate::scene::{Texture, TextureEncoding, Wrap};
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
    let moved = crate::scene::TextureUse {
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

/// Baked occlusion counts where a scene asks for it, and not otherwise.
#[test]
fn baked_occlusion_is_used_when_asked_for() {
    use crate::scene::{Texture, TextureEncoding, Wrap};
    let mut request = request("none");
    let mut geometry = of_one_material(matte([0.8; 3]), vec![floor()]);
    geometry.textures.push(Texture {
        name: String::from("baked"),
        width_px: 1,
        height_px: 1,
        rgba8: vec![128, 0, 0, 255],
        encoding: TextureEncoding::Linear,
        wrap: [Wrap::Repeat; 2],
    });
    geometry.materials[0].occlusion_texture = Some(0.into());
    let spot = pixel_of(&request, Vec3::new(0.3, 0.0, 1.0));
    assert_level(rgb(&draw(&geometry, &request), spot), 0.8);
    request.baked_occlusion = true;
    assert_level(rgb(&draw(&geometry, &request), spot), 0.8 * 128.0 / 255.0);
    geometry.materials[0].occlusion_strength = 0.5;
    assert_level(
        rgb(&draw(&geometry, &request), spot),
        0.8 * (1.0 + 128.0 / 255.0) / 2.0,
    );
}
