// Roughness and metalness.
fn material_finish(surface: Surface) -> vec2f {
    return vec2f(material.roughness, material.metallic);
}
