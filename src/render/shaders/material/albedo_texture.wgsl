//!use sampling
@group(1) @binding(1) var albedo_map: texture_2d<f32>;
@group(1) @binding(2) var albedo_sampler: sampler;

fn material_albedo(surface: Surface) -> vec4f {
    return material.albedo * surface.color * sample_map(albedo_map, albedo_sampler, slot_uv(surface.uv, 0u));
}
