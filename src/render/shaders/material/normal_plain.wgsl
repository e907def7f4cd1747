fn material_normal(surface: Surface, geometric: vec3f) -> vec3f {
    return geometric;
}
