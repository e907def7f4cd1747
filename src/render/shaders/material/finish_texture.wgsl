//!use sampling
@group(1) @binding(5) var finish_map: texture_2d<f32>;
@group(1) @binding(6) var finish_sampler: sampler;

// Roughness and metalness.
fn material_finish(surface: Surface) -> vec2f {
    let texel = sample_map(finish_map, finish_sampler, slot_uv(surface.uv, 2u));
    return vec2f(material.roughness, material.metallic) * texel.gb;
}
