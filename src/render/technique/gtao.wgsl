// Jimenez et al. 2016: in each slice the horizon to both sides, and the cosine-weighted light between them by
// a closed form.
//!use slices
struct Params {
    slices: f32,
    steps: f32,
    radius_m: f32,
    falloff: f32,
    step_power: f32,
}

// Cosine of the angle to the horizon on one side of the slice.
fn horizon(slice: Slice, centre_m: vec3f, pixel: vec2i, side: f32, jitter: f32) -> f32 {
    let lowest = cos(slice.normal_angle + side * 0.5 * PI);
    var highest = lowest;
    for (var i = 0.0; i < params.steps; i += 1.0) {
        let step = step_px(slice, side, params.radius_m, i + jitter, params.steps, params.step_power);
        let seen = seen_at(slice, side, centre_m, pixel, step);
        if !seen.is_there {
            continue;
        }
        // What is farther off counts less, and what is out of reach not at all.
        let near = clamp((params.radius_m - seen.distance_m) / max(params.falloff * params.radius_m, 1e-20), 0.0, 1.0);
        highest = max(highest, mix(lowest, cos(angle_of(seen.offset_m, side)), near));
    }
    return clamp(highest, -1.0, 1.0);
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let noise = spatial_noise(pixel);
    var open = 0.0;
    var whole = 0.0;
    for (var i = 0.0; i < params.slices; i += 1.0) {
        let slice = slice_at(centre_m, normal, PI * (i + noise.x) / params.slices);
        let n = slice.normal_angle;
        let right = min(acos(horizon(slice, centre_m, pixel, 1.0, noise.y)), n + 0.5 * PI);
        let left = max(-acos(horizon(slice, centre_m, pixel, -1.0, noise.y)), n - 0.5 * PI);
        open += slice.weight * (arc(left, n) + arc(right, n));
        whole += slice.weight * (arc(n - 0.5 * PI, n) + arc(n + 0.5 * PI, n));
    }
    // By what the same slices would let in if all were open: an open plane is exactly 1.
    return open / max(whole, 1e-6);
}
