// Reinhard et al. 2002, eq. 4, on luminance (Rec. 709), so that hues stay.
fn tone_map(radiance: vec3f) -> vec3f {
    let luminance = dot(radiance, vec3f(0.2126, 0.7152, 0.0722));
    let scale = (1.0 + luminance / (settings.white * settings.white)) / (1.0 + luminance);
    return radiance * scale;
}
