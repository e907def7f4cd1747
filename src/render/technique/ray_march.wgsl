// Thesis 4.3.3 and appendix C, after an idea of Bavoil & Sainz 2009: as blizzard, but each
// offset is walked in equal steps, and the first surface found in front ends the walk.
//!use thesis_falloff

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let mirror = noise[tile_index(pixel)].xyz;
    var sum = 0.0;
    for (var i = 0u; i < u32(params.directions); i++) {
        let stride = hemisphere_offset(kernel[i].xyz, mirror, normal) * (params.radius_m / params.steps);
        var delta_m = 0.0;
        for (var step = 1.0; step <= params.steps; step += 1.0) {
            let sample_m = centre_m + stride * step;
            delta_m = in_front_m(sample_m, depth_m, surface_depth_at(sample_m));
            if blocks(delta_m) {
                break;
            }
        }
        sum += openness(delta_m);
    }
    return sum / params.directions;
}
