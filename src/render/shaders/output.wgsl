// Radiance to display: exposure, tone map, average of a pixel's samples, sRGB.
//
// The tone map comes before the average: a sample far above white would else outweigh all
// others and bring the staircase back at every bright edge.
//!use fullscreen
//!use tone_map
struct Output {
    exposure: f32,
    white: f32,
    // Samples along one side of a pixel.
    samples: i32,
    unused: f32,
}

@group(0) @binding(0) var<uniform> settings: Output;
@group(0) @binding(1) var radiance_texture: texture_2d<f32>;

// IEC 61966-2-1.
fn srgb_encode(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

@fragment
fn fs_output(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let first = vec2i(position.xy) * settings.samples;
    var sum = vec3f(0.0);
    for (var y = 0; y < settings.samples; y++) {
        for (var x = 0; x < settings.samples; x++) {
            let radiance = textureLoad(radiance_texture, first + vec2i(x, y), 0).rgb;
            sum += clamp(tone_map(radiance * settings.exposure), vec3f(0.0), vec3f(1.0));
        }
    }
    return vec4f(srgb_encode(sum / f32(settings.samples * settings.samples)), 1.0);
}
