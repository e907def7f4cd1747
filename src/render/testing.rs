//! What tests of plans and of frames start from.

use std::sync::OnceLock;

use glam::Vec3;

use super::technique::Settings;
use super::{FrameRequest, Gpu, Precision, RenderedFrame, Renderer};
use crate::scene::primitives::{cuboid, of_one_material, quad};
use crate::scene::{
    Ambient, Background, Camera, Environment, Geometry, Lighting, Material, Mesh, PointLight, Sun,
    ToneMap,
};

/// A request for a scene seen from 4 m away at eye height, in constant white light.
pub(super) fn request(technique: &str) -> FrameRequest {
    FrameRequest {
        width_px: 160,
        height_px: 120,
        supersampling: 1,
        camera: Camera {
            position_m: Vec3::new(0.0, 1.5, 4.0),
            target_m: Vec3::new(0.0, 0.8, 0.0),
            vertical_fov_rad: 0.9,
            near_m: 0.05,
            far_m: 50.0,
        },
        lighting: Lighting::constant(Vec3::ONE),
        occlusion: Settings::from_label(technique).unwrap(),
        handed_occlusion: None,
        blur_radius_px: 4,
        blur_plane_m: 0.05,
        precision: Precision::Full,
        seed: 2010,
        baked_occlusion: false,
        unbounded_occlusion: false,
        keeps_cone: false,
        all_effects: false,
    }
}

/// The same with everything that light can do.
pub(super) fn brightest(technique: &str) -> FrameRequest {
    let mut request = request(technique);
    request.supersampling = 2;
    request.lighting = Lighting {
        ambient: Ambient::Environment,
        background: Background::Environment,
        reflections: true,
        sun: Some(Sun {
            towards: Vec3::new(0.3, 1.0, 0.5).normalize(),
            irradiance: Vec3::splat(2.0),
            casts_shadows: true,
        }),
        points: vec![PointLight {
            position_m: Vec3::new(0.5, 1.0, 1.0),
            intensity: Vec3::ONE,
            cone: None,
        }],
        model_lights: None,
        environment: Some(Environment::from_axes(
            [0.3, 0.5, 1.0, 0.2, 0.4, 0.6].map(Vec3::splat),
        )),
        exposure_ev: -0.5,
        tone_map: ToneMap::Aces,
    };
    request
}

pub(super) fn renderer() -> &'static Renderer {
    static RENDERER: OnceLock<Renderer> = OnceLock::new();
    RENDERER.get_or_init(|| {
        Renderer::new(Gpu::open(None).expect("tests need an adapter: mesa-vulkan-drivers has one"))
    })
}

pub(super) fn matte(albedo: [f32; 3]) -> Material {
    Material {
        albedo,
        specular: 0.0,
        roughness: 1.0,
        ..Material::default()
    }
}

pub(super) fn floor() -> Mesh {
    quad(
        "floor",
        Vec3::new(-6.0, 0.0, 6.0),
        Vec3::X * 12.0,
        Vec3::NEG_Z * 12.0,
    )
}

/// A floor with a wall standing on it, 1.6 m high and free above.
pub(super) fn floor_and_wall(albedo: [f32; 3]) -> Geometry {
    let wall = cuboid("wall", Vec3::new(-1.5, 0.0, -0.5), Vec3::new(1.5, 1.6, 0.0));
    of_one_material(matte(albedo), vec![floor(), wall])
}

pub(super) fn draw(geometry: &Geometry, request: &FrameRequest) -> RenderedFrame {
    let scene = renderer().upload(geometry).unwrap();
    renderer().render(&scene, request).unwrap()
}

/// Unit direction through a pixel's centre, in the world.
pub(super) fn direction_at(request: &FrameRequest, (x, y): (u32, u32)) -> Vec3 {
    direction_through(request, glam::Vec2::new(x as f32, y as f32) + 0.5)
}

/// Unit direction through a point of the picture, pixels from its upper left corner.
pub(super) fn direction_through(request: &FrameRequest, at_px: glam::Vec2) -> Vec3 {
    let half = glam::Vec2::from(request.camera.half_extent_at_1m(request.aspect()));
    let size = glam::Vec2::new(request.width_px as f32, request.height_px as f32);
    let at = at_px / size;
    let ndc = glam::Vec2::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y);
    (request.camera.view().inverse())
        .transform_vector3((ndc * half).extend(-1.0))
        .normalize()
}

/// The pixel a point is seen at.
pub(super) fn pixel_of(request: &FrameRequest, point: Vec3) -> (u32, u32) {
    let clip =
        (request.camera.projection(request.aspect()) * request.camera.view()).project_point3(point);
    let x = (clip.x * 0.5 + 0.5) * request.width_px as f32;
    let y = (0.5 - clip.y * 0.5) * request.height_px as f32;
    (x as u32, y as u32)
}

pub(super) fn rgb(frame: &RenderedFrame, (x, y): (u32, u32)) -> [u8; 3] {
    let at = 4 * (y * frame.picture.width_px + x) as usize;
    [
        frame.picture.rgba8[at],
        frame.picture.rgba8[at + 1],
        frame.picture.rgba8[at + 2],
    ]
}

/// IEC 61966-2-1, to the nearest 8-bit level.
pub(super) fn srgb8(linear: f32) -> i32 {
    let encoded = if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0).round() as i32
}

pub(super) fn assert_level(found: [u8; 3], linear: f32) {
    for channel in found {
        assert!(
            (i32::from(channel) - srgb8(linear)).abs() <= 1,
            "{found:?} is not {}",
            srgb8(linear)
        );
    }
}
