fn computed_occlusion(point: Point) -> f32 {
    return 1.0;
}
