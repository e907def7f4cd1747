fn tone_map(radiance: vec3f) -> vec3f {
    return radiance;
}
