// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a rational fit, a channel at a time.
fn tone_map(radiance: vec3f) -> vec3f {
    let x = radiance;
    return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}
