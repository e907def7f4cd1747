// Filion & McNaughton 2008; thesis 4.3.2 and appendix B.
//!use thesis_falloff

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let mirror = noise[tile_index(pixel)].xyz;
    var sum = 0.0;
    for (var i = 0u; i < u32(params.samples); i++) {
        let offset = hemisphere_offset(kernel[i].xyz, mirror, normal);
        let sample_m = centre_m + offset * params.radius_m;
        sum += openness(in_front_m(sample_m, depth_m, surface_depth_at(sample_m)));
    }
    return sum / params.samples;
}
