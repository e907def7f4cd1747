// The ambient term of a point. Occlusion stands here, before what comes from all round, and nowhere else.
//!use occluded_ambient

// To the half floats that radiance is stored in, so that shading at once and shading by
// passes give the same bytes.
fn stored(radiance: vec3f) -> vec3f {
    let xy = unpack2x16float(pack2x16float(radiance.xy));
    return vec3f(xy, unpack2x16float(pack2x16float(vec2f(radiance.z, 0.0))).x);
}
