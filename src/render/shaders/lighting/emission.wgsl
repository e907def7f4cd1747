// What surfaces send out by themselves.
//!use fullscreen
//!use place
@group(0) @binding(10) var emission_texture: texture_2d<f32>;

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    return vec4f(textureLoad(emission_texture, texel, 0).rgb, 0.0);
}
