//! Shading: composed of the parts the scene's lighting calls for, given their inputs and no others.

use super::super::Gpu;
use super::super::bindings::{Bindings, uniform_of};
use super::super::frame::LightUniform;
use super::Fullscreen;
use crate::scene::{Ambient, Background, Lighting};

/// What shading may read; what is absent is not bound.
pub(in super::super) struct LightingInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub albedo: &'a wgpu::TextureView,
    pub depth_m: &'a wgpu::TextureView,
    pub normals: Option<&'a wgpu::TextureView>,
    pub normals_part: (&'static str, &'static str),
    /// The occlusion and the depth it belongs to.
    pub occlusion: Option<(&'a wgpu::TextureView, &'a wgpu::TextureView)>,
    pub shadow: Option<&'a wgpu::TextureView>,
    pub light: LightUniform,
}

/// Shades every pixel into `target`.
pub(in super::super) fn lighting(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    lighting: &Lighting,
    inputs: &LightingInputs,
    target: &wgpu::TextureView,
) {
    let light = uniform_of(&gpu.device, "light", &[inputs.light]);
    let shadow_sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadow"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare: Some(wgpu::CompareFunction::LessEqual),
        ..wgpu::SamplerDescriptor::default()
    });
    let mut bindings = Bindings::default()
        .uniform(0, inputs.frame)
        .texture(1, inputs.depth_m, false)
        .texture(3, inputs.albedo, false)
        .uniform(4, &light);
    if let Some(normals) = inputs.normals {
        bindings = bindings.texture(2, normals, false);
    }
    if let Some((occlusion, depth_m)) = inputs.occlusion {
        bindings = bindings
            .texture(5, occlusion, false)
            .texture(6, depth_m, false);
    }
    if let Some(shadow) = inputs.shadow {
        bindings = bindings.texture(8, shadow, true).sampler(
            9,
            &shadow_sampler,
            wgpu::SamplerBindingType::Comparison,
        );
    }
    let bound = bindings.build(&gpu.device, "lighting");
    Fullscreen {
        label: "lighting",
        source: include_str!("../shaders/lighting/main.wgsl"),
        variants: &parts(lighting, inputs),
        fragment: "fs_lighting",
        bound: &bound,
    }
    .draw(gpu, encoder, target);
}

/// The shader's parts, by what the scene calls for.
fn parts(lighting: &Lighting, inputs: &LightingInputs) -> [(&'static str, &'static str); 7] {
    let ambient = match lighting.ambient {
        Ambient::Constant(_) => include_str!("../shaders/lighting/ambient_constant.wgsl"),
        Ambient::Environment => include_str!("../shaders/lighting/ambient_environment.wgsl"),
    };
    let background = match lighting.background {
        Background::Colour(_) => include_str!("../shaders/lighting/background_colour.wgsl"),
        Background::Environment => include_str!("../shaders/lighting/background_environment.wgsl"),
    };
    let occlusion = match inputs.occlusion {
        None => include_str!("../shaders/lighting/occlusion_none.wgsl"),
        Some(_) => include_str!("../shaders/lighting/occlusion_read.wgsl"),
    };
    let sun = match lighting.sun {
        None => include_str!("../shaders/lighting/sun_none.wgsl"),
        Some(_) => include_str!("../shaders/lighting/sun.wgsl"),
    };
    let visibility = match inputs.shadow {
        None => include_str!("../shaders/lighting/sun_unshadowed.wgsl"),
        Some(_) => include_str!("../shaders/lighting/sun_shadowed.wgsl"),
    };
    [
        inputs.normals_part,
        ("light", include_str!("../shaders/lighting/light.wgsl")),
        ("ambient", ambient),
        ("background", background),
        ("occlusion_factor", occlusion),
        ("sun", sun),
        ("sun_visibility", visibility),
    ]
}
