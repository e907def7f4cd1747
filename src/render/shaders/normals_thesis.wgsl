// Surface record as in the thesis' table 1: eight bits a component, and no room for the
// triangle's own normal or for metalness.
alias SurfaceRecord = vec4f;

@group(0) @binding(2) var normals_texture: texture_2d<f32>;

fn pack_surface(normal: vec3f, geometric_normal: vec3f, roughness: f32, metallic: f32) -> SurfaceRecord {
    return SurfaceRecord(normal * 0.5 + 0.5, roughness);
}

fn world_normal(pixel: vec2i) -> vec3f {
    let stored = textureLoad(normals_texture, pixel, 0).xyz * 2.0 - 1.0;
    // 127.5 cannot be stored: a zero component comes back as 0.004, so the length is never 0.
    return normalize(stored);
}

fn geometric_normal(pixel: vec2i) -> vec3f {
    return world_normal(pixel);
}

fn surface_finish(pixel: vec2i) -> vec2f {
    return vec2f(textureLoad(normals_texture, pixel, 0).w, 0.0);
}
