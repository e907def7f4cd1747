// Lights from points: inverse-square, in a cone where one is given (KHR_lights_punctual).
//!use fullscreen
//!use brdf
struct PointLight {
    position_m: vec3f,
    // Cosine to the axis times this, plus the offset, clamped and squared, is the cone's edge.
    cone_scale: f32,
    intensity: vec3f,
    cone_offset: f32,
    // Unit vector from the light along the cone's axis.
    along: vec3f,
    unused: f32,
}

@group(0) @binding(7) var<storage, read> points: array<PointLight>;

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    let point = point_at(texel);
    var lit = vec3f(0.0);
    for (var i = 0u; i < arrayLength(&points); i++) {
        let source = points[i];
        let apart_m = source.position_m - point.world_m;
        // Nearer than a centimetre the inverse square of a point that no lamp is would burn.
        let square = max(dot(apart_m, apart_m), 1e-4);
        let to_light = apart_m * inverseSqrt(square);
        let edge = clamp(dot(-to_light, source.along) * source.cone_scale + source.cone_offset, 0.0, 1.0);
        lit += lit_by(point, to_light, source.intensity * (edge * edge / square));
    }
    return vec4f(lit, 0.0);
}
