// McGuire et al. 2011: points of a spiral about the pixel, each closing by how high it stands above the
// surface and how near it is.
//!use occlusion
//!use spatial_noise

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let noise = spatial_noise(pixel);
    let px_per_m = 0.5 * frame.size_px.y / (frame.half_extent.y * depth_m);
    let reach_px = min(px_per_m * params.radius_m, length(frame.size_px));
    var sum = 0.0;
    for (var i = 0.0; i < params.samples; i += 1.0) {
        // Even over the disc; the golden angle keeps any number of points apart.
        let share = (i + noise.x) / params.samples;
        let angle = 6.2831853 * noise.y + 2.3999632 * i;
        let tap = nearest_pixel(sample_px(pixel) + reach_px * sqrt(share) * vec2f(cos(angle), sin(angle)));
        let tap_depth_m = select(frame.far_m, depth_at(tap), is_inside(tap));
        let offset_m = view_position(sample_px(tap), tap_depth_m) - centre_m;
        let distance_2 = dot(offset_m, offset_m);
        if all(tap == pixel) || tap_depth_m >= frame.far_m || distance_2 > params.radius_m * params.radius_m {
            continue;
        }
        let height_m = max(dot(offset_m, normal) - params.bias * depth_m, 0.0);
        sum += height_m / (distance_2 + params.softening_m * params.softening_m + 1e-20);
    }
    let open = max(1.0 - 2.0 * params.intensity_m * sum / params.samples, 0.0);
    return pow(max(open, 1e-6), params.contrast);
}
