fn sun_visibility(point: Point) -> f32 {
    return 1.0;
}
