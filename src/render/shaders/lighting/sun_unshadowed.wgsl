fn sun_visibility(texel: vec2i) -> f32 {
    return 1.0;
}
