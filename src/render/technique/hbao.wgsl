// Bavoil, Sainz and Dimitrov 2008: along each direction the rise of the horizon above the surface, each rise
// counted by how near it is.
//!use slices

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let sight = sight_of(pixel, depth_m);
    let noise = spatial_noise(pixel);
    let bias = vec2f(cos(radians(params.bias_deg)), sin(radians(params.bias_deg)));
    var closed = 0.0;
    for (var i = 0.0; i < params.directions; i += 1.0) {
        let angle = 2.0 * PI * (i + noise.x) / params.directions;
        let slice = slice_at(sight, vec2f(cos(angle), sin(angle)), params.radius_m);
        // Sine of the elevation above the plane across the line of sight: of the surface itself, the bias
        // added, and at most straight at the eye.
        let surface = vec2f(slice.cos_normal, -slice.sin_normal);
        let cosine = surface.x * bias.x - surface.y * bias.y;
        var highest = select(surface.y * bias.x + surface.x * bias.y, 1.0, cosine < 0.0);
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let length_px = step_px(slice, (k + noise.y) / params.steps, params.step_power);
            let seen = seen_at(sight, slice, 1.0, length_px);
            let elevation = seen.offset_m.y * seen.per_m;
            let far_2 = seen.distance_2 / (params.radius_m * params.radius_m);
            if seen.is_there && far_2 <= 1.0 && elevation > highest {
                closed += (1.0 - far_2) * (elevation - highest);
                highest = elevation;
            }
        }
    }
    return 1.0 - closed / params.directions;
}
