// From radiance to a display's numbers: exposure, tone map, sRGB.
//!use tone_map
struct Display {
    exposure: f32,
    white: f32,
    // Samples along one side of a pixel.
    samples: i32,
    unused: f32,
}

@group(0) @binding(11) var<uniform> settings: Display;

// One sample's share of its pixel, linear, 0 to 1. The tone map comes before the average:
// a sample far above white would else outweigh all others and bring the staircase back at
// every bright edge.
fn displayed(radiance: vec3f) -> vec3f {
    return clamp(tone_map(radiance * settings.exposure), vec3f(0.0), vec3f(1.0));
}

// IEC 61966-2-1.
fn srgb_encode(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}
