fn material_baked(surface: Surface) -> f32 {
    return 1.0;
}
