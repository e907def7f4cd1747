//! Passes that add light to the radiance target: each one kind of light, given its inputs and
//! no others.

use super::super::Gpu;
use super::super::bindings::{Bindings, Bound};
use super::super::environment::EnvironmentTextures;
use super::super::plan::PassKind;
use super::fullscreen::{Fullscreen, Onto};

/// What passes of light may read; what a frame does not have is absent.
pub(in super::super) struct LightInputs<'a> {
    pub frame: &'a wgpu::Buffer,
    pub light: &'a wgpu::Buffer,
    pub depth_m: &'a wgpu::TextureView,
    pub albedo: &'a wgpu::TextureView,
    pub normals: Option<&'a wgpu::TextureView>,
    pub normals_part: (&'static str, &'static str),
    pub emission: Option<&'a wgpu::TextureView>,
    /// Whether the emission target's alpha is baked occlusion that counts.
    pub is_baked: bool,
    pub occlusion: Option<&'a wgpu::TextureView>,
    /// What the ambient light changes by, where the technique says it by direction.
    pub directional: Option<&'a wgpu::TextureView>,
    /// What is closed by direction, where the environment's light comes in through the bent cone.
    pub cone: Option<&'a wgpu::TextureView>,
    /// How much of the directional light arrives.
    pub visibility: Option<&'a wgpu::TextureView>,
    /// The environment; what no pass reads is absent.
    pub environment: &'a EnvironmentTextures,
    /// The lights from points.
    pub points: Option<&'a wgpu::Buffer>,
    /// Whether the environment's irradiance is part of the ambient light.
    pub has_irradiance: bool,
    /// The WGSL of light between surfaces, where the ambient term gets any.
    pub inter_reflection: Option<&'a str>,
    /// What the radiance target is before any light: linear RGB.
    pub background: [f32; 3],
}

impl<'a> LightInputs<'a> {
    /// The surfaces, and what each kind of light reads beside them.
    fn bindings(&self, kind: PassKind) -> Bindings<'a> {
        let mut bindings =
            Bindings::default()
                .uniform(0, self.frame)
                .texture(1, self.depth_m, false);
        if kind == PassKind::Emission {
            return bindings.texture_if_any(10, self.emission);
        }
        bindings = bindings.uniform(4, self.light);
        if kind == PassKind::Skybox {
            return self.environment(bindings, self.environment.sky.as_ref());
        }
        bindings = bindings
            .texture_if_any(2, self.normals)
            .texture(3, self.albedo, false);
        match kind {
            PassKind::Sun => bindings.texture_if_any(8, self.visibility),
            PassKind::PointLights => match self.points {
                Some(points) => bindings.storage(7, points),
                None => bindings,
            },
            _ => self
                .occlusion(kind, self.reflections(kind, bindings))
                .texture_if_any(10, self.emission.filter(|_| self.is_baked)),
        }
    }

    /// The mirror's light has one coefficient always: what is known by direction is known of
    /// matte surfaces.
    fn occlusion(&self, kind: PassKind, bindings: Bindings<'a>) -> Bindings<'a> {
        match (kind, self.directional) {
            (PassKind::Reflections, _) => bindings.texture_if_any(5, self.occlusion),
            (_, None) => bindings
                .texture_if_any(5, self.occlusion)
                .texture_if_any(15, self.cone),
            (_, Some(directional)) => bindings.texture(6, directional, false),
        }
    }

    fn reflections(&self, kind: PassKind, bindings: Bindings<'a>) -> Bindings<'a> {
        match (kind, &self.environment.table) {
            (PassKind::Reflections, Some(table)) => self
                .environment(bindings, self.environment.blurred.as_ref())
                .texture(14, table, true),
            _ => bindings,
        }
    }

    fn environment(
        &self,
        bindings: Bindings<'a>,
        map: Option<&'a wgpu::TextureView>,
    ) -> Bindings<'a> {
        let Some(map) = map else {
            return bindings;
        };
        let sampler = &self.environment.sampler;
        bindings
            .texture(12, map, true)
            .sampler(13, sampler, wgpu::SamplerBindingType::Filtering)
    }

    /// What the ambient term is bound to, for a pass of it in `label`'s name.
    pub(super) fn bind_ambient(&self, gpu: &Gpu, display: &'a wgpu::Buffer) -> Bound {
        self.bindings(PassKind::Ambient)
            .uniform(11, display)
            .build(&gpu.device, "shade")
    }

    /// The parts of the shaders that differ by what the frame has.
    pub(super) fn parts(&self) -> [(&'static str, &'a str); 8] {
        [
            self.normals_part,
            (
                "ambient_term",
                if self.has_irradiance {
                    include_str!("../shaders/lighting/ambient_environment.wgsl")
                } else {
                    include_str!("../shaders/lighting/ambient_constant.wgsl")
                },
            ),
            (
                "occluded_ambient",
                match (self.directional, self.cone, self.inter_reflection) {
                    (Some(_), ..) => include_str!("../shaders/lighting/occluded_by_direction.wgsl"),
                    (None, Some(_), _) => include_str!("../shaders/lighting/occluded_in_cone.wgsl"),
                    (None, None, Some(_)) => {
                        include_str!("../shaders/lighting/occluded_and_lit_back.wgsl")
                    }
                    (None, None, None) => include_str!("../shaders/lighting/occluded_alike.wgsl"),
                },
            ),
            (
                "computed_occlusion",
                match self.occlusion {
                    None => include_str!("../shaders/lighting/occlusion_none.wgsl"),
                    Some(_) => include_str!("../shaders/lighting/occlusion_read.wgsl"),
                },
            ),
            (
                "baked_occlusion",
                if self.is_baked {
                    include_str!("../shaders/lighting/baked_read.wgsl")
                } else {
                    include_str!("../shaders/lighting/baked_none.wgsl")
                },
            ),
            (
                "received",
                match self.inter_reflection {
                    None => include_str!("../shaders/lighting/received_alone.wgsl"),
                    Some(_) => include_str!("../shaders/lighting/received_lit_back.wgsl"),
                },
            ),
            (
                "inter_reflection",
                self.inter_reflection.unwrap_or_default(),
            ),
            sun_visibility_part(self.visibility),
        ]
    }
}

/// The WGSL part `sun_visibility` for a frame.
pub(super) fn sun_visibility_part(
    visibility: Option<&wgpu::TextureView>,
) -> (&'static str, &'static str) {
    let text = match visibility {
        None => include_str!("../shaders/lighting/sun_unshadowed.wgsl"),
        Some(_) => include_str!("../shaders/lighting/sun_shadowed.wgsl"),
    };
    ("sun_visibility", text)
}

/// Adds one kind of light to `target`; the ambient pass, the first, clears it before.
pub(in super::super) fn light(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    kind: PassKind,
    inputs: &LightInputs,
    target: &wgpu::TextureView,
) {
    let source = match kind {
        PassKind::Reflections => include_str!("../shaders/lighting/reflections.wgsl"),
        PassKind::Emission => include_str!("../shaders/lighting/emission.wgsl"),
        PassKind::Sun => include_str!("../shaders/lighting/sun.wgsl"),
        PassKind::PointLights => include_str!("../shaders/lighting/points.wgsl"),
        PassKind::Skybox => include_str!("../shaders/lighting/skybox.wgsl"),
        _ => include_str!("../shaders/lighting/ambient.wgsl"),
    };
    let bound = inputs.bindings(kind).build(&gpu.device, kind.name());
    let [r, g, b] = inputs.background.map(f64::from);
    Fullscreen {
        label: kind.name(),
        source,
        variants: &inputs.parts(),
        fragment: "fs_light",
        bound: &bound,
        onto: match kind {
            PassKind::Ambient => Onto::Cleared(wgpu::Color { r, g, b, a: 0.0 }),
            _ => Onto::Added,
        },
    }
    .draw(gpu, encoder, target);
}
