//!use sampling
@group(1) @binding(3) var normal_map: texture_2d<f32>;
@group(1) @binding(4) var normal_sampler: sampler;

fn material_normal(surface: Surface, geometric: vec3f) -> vec3f {
    let texel = sample_map(normal_map, normal_sampler, slot_uv(surface.uv, 1u)).xyz * 2.0 - 1.0;
    let scaled = vec3f(texel.xy * material.normal_scale, texel.z);
    let tangent = safe_normalize(
        surface.tangent.xyz - geometric * dot(geometric, surface.tangent.xyz), vec3f(0.0));
    let bitangent = cross(geometric, tangent) * surface.tangent.w;
    return safe_normalize(tangent * scaled.x + bitangent * scaled.y + geometric * scaled.z, geometric);
}
