// Surface record, full precision: two words a pixel.
//!use octahedral
alias SurfaceRecord = vec4u;

@group(0) @binding(2) var normals_texture: texture_2d<u32>;

fn pack_surface(normal: vec3f, geometric_normal: vec3f, roughness: f32, metallic: f32) -> SurfaceRecord {
    let geometric = octahedral_encode(geometric_normal) * 0.5 + 0.5;
    return SurfaceRecord(
        pack2x16snorm(octahedral_encode(normal)),
        pack4x8unorm(vec4f(roughness, metallic, geometric)),
        0u,
        0u,
    );
}

// Unit world-space normal used for shading.
fn world_normal(pixel: vec2i) -> vec3f {
    return octahedral_decode(unpack2x16snorm(textureLoad(normals_texture, pixel, 0).x));
}

// Unit world-space normal of the triangle, to a few degrees.
fn geometric_normal(pixel: vec2i) -> vec3f {
    let packed = unpack4x8unorm(textureLoad(normals_texture, pixel, 0).y);
    return octahedral_decode(packed.zw * 2.0 - 1.0);
}

// Roughness and metalness.
fn surface_finish(pixel: vec2i) -> vec2f {
    return unpack4x8unorm(textureLoad(normals_texture, pixel, 0).y).xy;
}
