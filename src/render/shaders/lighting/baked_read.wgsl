// Occlusion that the model's author baked into a texture, where the scene asks for it.
@group(0) @binding(10) var emission_texture: texture_2d<f32>;

fn baked_occlusion(point: Point) -> f32 {
    return textureLoad(emission_texture, point.texel, 0).a;
}
