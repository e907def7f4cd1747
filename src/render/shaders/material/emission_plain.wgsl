fn material_emission(surface: Surface) -> vec3f {
    return material.emission;
}
