fn occlusion_factor(point: Point) -> f32 {
    return 1.0;
}
