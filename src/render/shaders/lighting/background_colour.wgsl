fn background_radiance(towards: vec3f) -> vec3f {
    return light.background.rgb;
}
