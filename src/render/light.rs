//! The lights of a frame as its shaders are given them.

use glam::{Mat4, Vec3};

use super::frame::{FrameRequest, SHADOW_SIZE_PX};
use super::shadow_view::{SUN_RADIUS, ShadowView};
use crate::scene::{Ambient, Background, PointLight};

/// The WGSL struct `Light`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct LightUniform {
    irradiance: [[f32; 4]; 9],
    constant_ambient: [f32; 4],
    background: [f32; 4],
    sun_towards: [f32; 4],
    sun_irradiance: [f32; 4],
    occlusion_weight: f32,
    shadow_weight: f32,
    reflection_weight: f32,
    sky_weight: f32,
    environment_turn: f32,
    environment_intensity: f32,
    unused: [f32; 2],
    shadow_from_world: Mat4,
    shadow_right: [f32; 4],
    shadow_up: [f32; 4],
    shadow_depth: [f32; 4],
}

impl LightUniform {
    /// The lights of `request`, as a person wrote it: an effect that it does not ask for has
    /// weight 0, whether the frame runs it or not.
    pub(super) fn new(request: &FrameRequest, shadow: Option<ShadowView>) -> Self {
        let lighting = &request.lighting;
        let mut uniform: Self = bytemuck::Zeroable::zeroed();
        let weight = |asked: bool| f32::from(u8::from(asked));
        uniform.occlusion_weight = weight(request.occlusion.technique.occludes());
        uniform.reflection_weight = weight(lighting.reflections);
        uniform.sky_weight = weight(lighting.background == Background::Environment);
        if let Some(environment) = &lighting.environment {
            uniform.environment_turn = environment.about_y_rad() / std::f32::consts::TAU;
            uniform.environment_intensity = environment.intensity();
            if lighting.ambient == Ambient::Environment {
                uniform.irradiance = environment.irradiance().coefficients.map(pad);
            }
        }
        if let Ambient::Constant(radiance) = lighting.ambient {
            uniform.constant_ambient = pad(radiance);
        }
        if let Background::Colour(radiance) = lighting.background {
            uniform.background = pad(radiance);
        }
        uniform.sun_towards = pad(Vec3::Y);
        if let Some(sun) = &lighting.sun {
            uniform.sun_towards = pad(sun.towards);
            uniform.sun_irradiance = pad(sun.irradiance);
            uniform.shadow_weight = weight(sun.casts_shadows);
        }
        if let Some(shadow) = shadow {
            uniform.shadow_from_world = shadow.from_world;
            uniform.shadow_right = shadow.right.extend(shadow.uv_per_m.x).to_array();
            uniform.shadow_up = shadow.up.extend(shadow.uv_per_m.y).to_array();
            uniform.shadow_depth = [
                shadow.depth_per_m,
                shadow.texel_m,
                SUN_RADIUS,
                SHADOW_SIZE_PX as f32,
            ];
        }
        uniform
    }
}

/// The WGSL struct `PointLight`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct PointUniform {
    position_m: Vec3,
    cone_scale: f32,
    intensity: Vec3,
    cone_offset: f32,
    along: Vec3,
    unused: f32,
}

impl From<&PointLight> for PointUniform {
    fn from(light: &PointLight) -> Self {
        // KHR_lights_punctual: the edge falls from the inner to the outer cosine. Without a
        // cone the edge is 1 everywhere.
        let (along, cone_scale, cone_offset) = light.cone.map_or((Vec3::Y, 0.0, 1.0), |cone| {
            let (inner, outer) = (cone.inner_rad.cos(), cone.outer_rad.cos());
            let scale = 1.0 / (inner - outer).max(1e-3);
            (cone.along, scale, -outer * scale)
        });
        Self {
            position_m: light.position_m,
            cone_scale,
            intensity: light.intensity,
            cone_offset,
            along,
            unused: 0.0,
        }
    }
}

fn pad(v: Vec3) -> [f32; 4] {
    v.extend(0.0).to_array()
}
