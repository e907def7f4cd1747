// A frame in which nothing depends on normals: everything faces up.
fn world_normal(pixel: vec2i) -> vec3f {
    return vec3f(0.0, 1.0, 0.0);
}

fn geometric_normal(pixel: vec2i) -> vec3f {
    return vec3f(0.0, 1.0, 0.0);
}

fn surface_finish(pixel: vec2i) -> vec2f {
    return vec2f(1.0, 0.0);
}
