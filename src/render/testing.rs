//! What tests of plans and of frames start from.

use glam::Vec3;

use super::technique::Settings;
use super::{FrameRequest, Precision};
use crate::scene::{Ambient, Background, Camera, Environment, Lighting, PointLight, Sun, ToneMap};

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
        lighting: Lighting {
            ambient: Ambient::Constant(Vec3::ONE),
            background: Background::Colour(Vec3::ONE),
            reflections: false,
            sun: None,
            points: Vec::new(),
            model_lights: None,
            environment: None,
            exposure_ev: 0.0,
            tone_map: ToneMap::None,
        },
        occlusion: Settings::from_label(technique).unwrap(),
        blur_radius_px: 4,
        blur_plane_m: 0.05,
        precision: Precision::Full,
        seed: 2010,
        baked_occlusion: false,
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
        environment: Some(Environment {
            axes: [0.3, 0.5, 1.0, 0.2, 0.4, 0.6].map(Vec3::splat),
        }),
        exposure_ev: -0.5,
        tone_map: ToneMap::Aces,
    };
    request
}
