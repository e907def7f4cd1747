@group(0) @binding(8) var visibility_texture: texture_2d<f32>;

fn sun_visibility(texel: vec2i) -> f32 {
    return 1.0 + light.shadow_weight * (textureLoad(visibility_texture, texel, 0).x - 1.0);
}
