// A material's factors, and where its textures lie on the surface.
struct Placement {
    // Columns of the 2 x 2 part, then the translation.
    columns: vec4f,
    translation: vec4f,
}

struct Material {
    // Alpha is opacity.
    albedo: vec4f,
    emission: vec3f,
    alpha_cutoff: f32,
    roughness: f32,
    metallic: f32,
    specular: f32,
    normal_scale: f32,
    baked_strength: f32,
    // 1 where the albedo is shown as it is.
    unlit: f32,
    unused: vec2f,
    // Albedo, normal, finish, emission, baked occlusion.
    placements: array<Placement, 5>,
}

@group(1) @binding(0) var<uniform> material: Material;

// Texture coordinates of a slot: KHR_texture_transform.
fn slot_uv(uv: vec2f, slot: u32) -> vec2f {
    let placement = material.placements[slot];
    return placement.columns.xy * uv.x + placement.columns.zw * uv.y + placement.translation.xy;
}

// A zero vector (an interpolated fold) has no direction: the fallback stands in.
fn safe_normalize(v: vec3f, fallback: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(fallback, v * inverseSqrt(max(square, 1e-30)), square > 1e-12);
}
