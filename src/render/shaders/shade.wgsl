// Surfaces to the image at once, for a frame that is nothing but ambient light before a colour:
// no target for radiance, no pass that adds to it.
//!use fullscreen
//!use light
//!use radiance
//!use display

@fragment
fn fs_shade(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let first = vec2i(position.xy) * settings.samples;
    var sum = vec3f(0.0);
    for (var y = 0; y < settings.samples; y++) {
        for (var x = 0; x < settings.samples; x++) {
            let texel = first + vec2i(x, y);
            var radiance = light.background.rgb;
            if has_surface(texel) {
                radiance = occluded_ambient(point_at(texel));
            }
            sum += displayed(stored(radiance));
        }
    }
    return vec4f(srgb_encode(sum / f32(settings.samples * settings.samples)), 1.0);
}
