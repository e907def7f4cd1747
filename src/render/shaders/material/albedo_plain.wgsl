fn material_albedo(surface: Surface) -> vec4f {
    return material.albedo * surface.color;
}
