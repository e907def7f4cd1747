// The environment in the mirror of a surface, occluded like all light from all round: the split
// sum of Karis 2013. The map's mip levels are its blur by roughness.
//!use fullscreen
//!use brdf
//!use computed_occlusion
//!use baked_occlusion
//!use equirectangular
@group(0) @binding(12) var environment_texture: texture_2d<f32>;
// Scale and offset of the reflectance at normal incidence, by cosine and roughness.
@group(0) @binding(14) var share_texture: texture_2d<f32>;

fn reflected_share(f0: vec3f, n_dot_v: f32, roughness: f32) -> vec3f {
    // The table's first and last entries are for the ends of both ranges.
    let side = vec2f(textureDimensions(share_texture));
    let uv = (vec2f(n_dot_v, roughness) * (side - 1.0) + 0.5) / side;
    let share = textureSampleLevel(share_texture, environment_sampler, uv, 0.0).xy;
    return f0 * share.x + share.y;
}

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    let point = point_at(texel);
    let n_dot_v = clamp(dot(point.normal, point.to_eye), 0.0, 1.0);
    let uv = environment_uv(reflect(-point.to_eye, point.normal));
    let level = point.roughness * f32(textureNumLevels(environment_texture) - 1u);
    let radiance = textureSampleLevel(environment_texture, environment_sampler, uv, level).rgb;
    let share = reflected_share(reflectance_at_normal(point), n_dot_v, point.roughness);
    let occlusion = computed_occlusion(point) * baked_occlusion(point);
    return vec4f(light.reflection_weight * light.environment_intensity * occlusion * share * radiance, 0.0);
}
