// The environment in the mirror of a surface, occluded like all light from all round.
//!use fullscreen
//!use brdf
//!use computed_occlusion
//!use baked_occlusion
//!use environment_radiance

// Share of the environment that a surface reflects: Karis 2014, "Physically Based Shading on
// Mobile", a fit of the split-sum integral of GGX.
fn environment_brdf(f0: vec3f, roughness: f32, n_dot_v: f32) -> vec3f {
    let r = roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    let scale_bias = vec2f(-1.04, 1.04) * a + r.zw;
    return f0 * scale_bias.x + scale_bias.y;
}

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    let point = point_at(texel);
    let n_dot_v = max(dot(point.normal, point.to_eye), 1e-3);
    let mirrored = reflect(-point.to_eye, point.normal);
    let share = environment_brdf(reflectance_at_normal(point), point.roughness, n_dot_v);
    let occlusion = computed_occlusion(point) * baked_occlusion(point);
    return vec4f(light.reflection_weight * occlusion * share * environment_radiance(mirrored), 0.0);
}
