// Jimenez et al. 2016: in each slice the horizon to both sides, and the cosine-weighted light between them by
// a closed form.
//!use slices
//!use opening

// The higher of two horizons' cosines: the one so far, and that of a sample.
fn raised(highest: f32, lowest: f32, seen: Seen) -> f32 {
    // What is farther off counts less, and what is out of reach not at all.
    let per_m = 1.0 / max(params.falloff * params.radius_m, 1e-20);
    let near = saturate((params.radius_m - sqrt(seen.distance_2)) * per_m);
    let rise = mix(lowest, seen.offset_m.y * seen.per_m, near);
    return select(highest, max(highest, rise), seen.is_there);
}

fn opening(pixel: vec2i, depth_m: f32) -> Opening {
    let sight = sight_of(pixel, depth_m);
    let noise = spatial_noise(pixel);
    var open = 0.0;
    var whole = 0.0;
    var closed = vec3f(0.0);
    for (var i = 0.0; i < params.slices; i += 1.0) {
        let angle = PI * (i + noise.x) / params.slices;
        let turn = vec2f(cos(angle), sin(angle));
        let slice = slice_at(sight, turn, params.radius_m);
        // Cosines of the angles to the horizon to both sides; at first, of the surface itself.
        let lowest = vec2f(-slice.sin_normal, slice.sin_normal);
        var highest = lowest;
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let length_px = step_px(slice, (k + noise.y) / params.steps, params.step_power);
            highest.x = raised(highest.x, lowest.x, seen_at(sight, slice, 1.0, length_px));
            highest.y = raised(highest.y, lowest.y, seen_at(sight, slice, -1.0, length_px));
        }
        open += slice.weight * (arc(slice, 1.0, highest.x) + arc(slice, -1.0, highest.y));
        whole += slice.weight * slice.light;
        let below = arc_moment(slice, 1.0, lowest.x) - arc_moment(slice, 1.0, highest.x)
            + arc_moment(slice, -1.0, lowest.y) - arc_moment(slice, -1.0, highest.y);
        closed += slice.weight * vec3f(below.x * turn, below.y);
    }
    // By what the same slices would let in if all were open: an open plane is exactly 1.
    let all = max(whole, 1e-6);
    return Opening(open / all, in_world(pixel, depth_m, closed / all));
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    return opening(pixel, depth_m).share;
}
