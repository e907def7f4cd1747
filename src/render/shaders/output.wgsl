// Radiance to the image: each sample displayed, a pixel's samples averaged, sRGB.
//!use fullscreen
//!use display
@group(0) @binding(1) var radiance_texture: texture_2d<f32>;

@fragment
fn fs_output(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let first = vec2i(position.xy) * settings.samples;
    var sum = vec3f(0.0);
    for (var y = 0; y < settings.samples; y++) {
        for (var x = 0; x < settings.samples; x++) {
            sum += displayed(textureLoad(radiance_texture, first + vec2i(x, y), 0).rgb);
        }
    }
    return vec4f(srgb_encode(sum / f32(settings.samples * settings.samples)), 1.0);
}
