// Bavoil, Sainz and Dimitrov 2008: along each direction the rise of the horizon above the surface, each rise
// counted by how near it is.
//!use slices
struct Params {
    directions: f32,
    steps: f32,
    radius_m: f32,
    bias_deg: f32,
    step_power: f32,
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let noise = spatial_noise(pixel);
    var closed = 0.0;
    for (var i = 0.0; i < params.directions; i += 1.0) {
        let slice = slice_at(centre_m, normal, 2.0 * PI * (i + noise.x) / params.directions);
        // Elevations above the plane across the line of sight.
        var highest = sin(clamp(radians(params.bias_deg) - slice.normal_angle, -0.5 * PI, 0.5 * PI));
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let step = step_px(slice, 1.0, params.radius_m, k + noise.y, params.steps, params.step_power);
            let seen = seen_at(slice, 1.0, centre_m, pixel, step);
            if !seen.is_there || seen.distance_m > params.radius_m {
                continue;
            }
            let elevation = cos(angle_of(seen.offset_m, 1.0));
            if elevation > highest {
                let far = seen.distance_m / params.radius_m;
                closed += (1.0 - far * far) * (elevation - highest);
                highest = elevation;
            }
        }
    }
    return 1.0 - closed / params.directions;
}
