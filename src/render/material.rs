//! Materials on the GPU: each given the textures it has and no others.

use glam::Affine2;

use super::Gpu;
use super::bindings::{Bindings, Bound, uniform_of};
use super::upload::{GpuScene, Samplers};
use crate::scene::{Material, TextureUse};

/// What of the geometry shader differs between materials, beside their numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct MaterialShape {
    albedo_texture: bool,
    normal_texture: bool,
    finish_texture: bool,
    emission_texture: bool,
    baked_texture: bool,
    /// Whether its alpha cuts holes.
    pub masked: bool,
    /// Whether both sides are drawn.
    pub double_sided: bool,
}

/// What of a frame decides which textures its materials are read with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct MaterialUse {
    /// Normals are stored.
    pub normals: bool,
    /// Emission is stored.
    pub emission: bool,
    /// Baked occlusion is stored.
    pub baked: bool,
}

/// A material, bound for one use.
pub(super) struct GpuMaterial {
    pub shape: MaterialShape,
    pub bound: Bound,
}

impl GpuMaterial {
    /// Binds a material's numbers and the textures that `usage` reads.
    pub(super) fn new(
        gpu: &Gpu,
        material: &Material,
        scene: &GpuScene,
        samplers: &Samplers,
        usage: MaterialUse,
    ) -> Self {
        let slots = [
            (1, material.albedo_texture, true),
            (3, material.normal_texture, usage.normals),
            (5, material.roughness_texture, usage.normals),
            (7, material.emission_texture, usage.emission),
            (9, material.occlusion_texture, usage.baked),
        ];
        let factors = uniform_of(
            &gpu.device,
            &material.name,
            &[MaterialUniform::new(material)],
        );
        let mut bindings = Bindings::default().uniform(0, &factors);
        for (binding, slot, is_read) in slots {
            if let (Some(slot), true) = (slot, is_read) {
                let sampler = samplers.of(scene.wraps[slot.texture]);
                bindings = bindings
                    .texture(binding, &scene.textures[slot.texture], true)
                    .sampler(binding + 1, sampler, wgpu::SamplerBindingType::Filtering);
            }
        }
        let has = |index: usize| slots[index].1.is_some() && slots[index].2;
        Self {
            shape: MaterialShape {
                albedo_texture: has(0),
                normal_texture: has(1),
                finish_texture: has(2),
                emission_texture: has(3),
                baked_texture: has(4),
                masked: material.alpha_cutoff.is_some(),
                double_sided: material.double_sided,
            },
            bound: bindings.build(&gpu.device, &material.name),
        }
    }
}

impl MaterialShape {
    /// The shader's parts.
    pub(super) fn parts(self) -> [(&'static str, &'static str); 8] {
        let pick = |textured, with, without| if textured { with } else { without };
        [
            ("material", include_str!("shaders/material/material.wgsl")),
            ("corner", include_str!("shaders/material/corner.wgsl")),
            (
                "material_albedo",
                pick(
                    self.albedo_texture,
                    include_str!("shaders/material/albedo_texture.wgsl"),
                    include_str!("shaders/material/albedo_plain.wgsl"),
                ),
            ),
            (
                "material_mask",
                pick(
                    self.masked,
                    include_str!("shaders/material/masked.wgsl"),
                    include_str!("shaders/material/opaque.wgsl"),
                ),
            ),
            (
                "material_normal",
                pick(
                    self.normal_texture,
                    include_str!("shaders/material/normal_map.wgsl"),
                    include_str!("shaders/material/normal_plain.wgsl"),
                ),
            ),
            (
                "material_finish",
                pick(
                    self.finish_texture,
                    include_str!("shaders/material/finish_texture.wgsl"),
                    include_str!("shaders/material/finish_plain.wgsl"),
                ),
            ),
            (
                "material_emission",
                pick(
                    self.emission_texture,
                    include_str!("shaders/material/emission_texture.wgsl"),
                    include_str!("shaders/material/emission_plain.wgsl"),
                ),
            ),
            (
                "material_baked",
                pick(
                    self.baked_texture,
                    include_str!("shaders/material/baked_texture.wgsl"),
                    include_str!("shaders/material/baked_plain.wgsl"),
                ),
            ),
        ]
    }
}

/// The WGSL struct `Material`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct MaterialUniform {
    albedo: [f32; 4],
    emission: [f32; 3],
    alpha_cutoff: f32,
    roughness: f32,
    metallic: f32,
    specular: f32,
    normal_scale: f32,
    baked_strength: f32,
    unlit: f32,
    unused: [f32; 2],
    placements: [[f32; 8]; 5],
}

impl MaterialUniform {
    fn new(material: &Material) -> Self {
        let [r, g, b] = material.albedo;
        Self {
            albedo: [r, g, b, material.alpha],
            emission: material.emission,
            alpha_cutoff: material.alpha_cutoff.unwrap_or(0.0),
            roughness: material.roughness,
            metallic: material.metallic,
            specular: material.specular,
            normal_scale: material.normal_scale,
            baked_strength: material.occlusion_strength,
            unlit: f32::from(u8::from(material.unlit)),
            unused: [0.0; 2],
            placements: [
                material.albedo_texture,
                material.normal_texture,
                material.roughness_texture,
                material.emission_texture,
                material.occlusion_texture,
            ]
            .map(placement),
        }
    }
}

/// The WGSL struct `Placement`.
fn placement(slot: Option<TextureUse>) -> [f32; 8] {
    let transform = slot.map_or(Affine2::IDENTITY, |slot| slot.transform);
    let [a, b, c, d] = transform.matrix2.to_cols_array();
    let [x, y] = transform.translation.to_array();
    [a, b, c, d, x, y, 0.0, 0.0]
}
