// The environment where no surface is.
//!use fullscreen
//!use place
//!use environment_radiance

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if has_surface(texel) {
        discard;
    }
    return vec4f(light.sky_weight * environment_radiance(normalize(world_ray(texel))), 0.0);
}
