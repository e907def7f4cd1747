// The ambient term of a point, thesis eq. 5: k_A c_amb L_A. Occlusion stands here, before
// what comes from all round, and nowhere else.
//!use point
//!use computed_occlusion
//!use baked_occlusion
//!use ambient_term

fn occluded_ambient(point: Point) -> vec3f {
    return computed_occlusion(point) * baked_occlusion(point) * ambient_radiance(point);
}

// To the half floats that radiance is stored in, so that shading at once and shading by
// passes give the same bytes.
fn stored(radiance: vec3f) -> vec3f {
    let xy = unpack2x16float(pack2x16float(radiance.xy));
    return vec3f(xy, unpack2x16float(pack2x16float(vec2f(radiance.z, 0.0))).x);
}
