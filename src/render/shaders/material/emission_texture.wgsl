//!use sampling
@group(1) @binding(7) var emission_map: texture_2d<f32>;
@group(1) @binding(8) var emission_sampler: sampler;

fn material_emission(surface: Surface) -> vec3f {
    return material.emission * sample_map(emission_map, emission_sampler, slot_uv(surface.uv, 3u)).rgb;
}
