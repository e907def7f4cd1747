// Light from all round.
//!use fullscreen
//!use radiance

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    return vec4f(stored(occluded_ambient(point_at(texel))), 0.0);
}
