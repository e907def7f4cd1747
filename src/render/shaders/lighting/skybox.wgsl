// The environment where no surface is.
//!use fullscreen
//!use place
//!use equirectangular
@group(0) @binding(12) var environment_texture: texture_2d<f32>;

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if has_surface(texel) {
        discard;
    }
    let uv = environment_uv(normalize(world_ray(texel)));
    let radiance = textureSampleLevel(environment_texture, environment_sampler, uv, 0.0).rgb;
    return vec4f(light.sky_weight * light.environment_intensity * radiance, 0.0);
}
