// What blizzard and ray-march share: the offsets and the falloff of thesis 4.3.2.
//!use occlusion

// A kernel point, reflected through the tiled unit vector and turned into the normal's hemisphere.
fn hemisphere_offset(point: vec3f, mirror: vec3f, normal: vec3f) -> vec3f {
    let offset = reflect(point, mirror);
    return select(offset, -offset, dot(offset, normal) < 0.0);
}

// Filion & McNaughton 2008, whose falloff the thesis changed.
fn is_filion() -> bool {
    return params.mode > 0.5;
}

// How far a surface stands in front, metres, 0 where it does not: in front of the pixel in the thesis
// (figure 16; appendix B subtracts the other way round, which is right only for a stored depth
// that falls with distance), of the sample itself in its source.
fn in_front_m(sample_m: vec3f, pixel_m: f32, surface_m: f32) -> f32 {
    return max(select(pixel_m, -sample_m.z, is_filion()) - surface_m, 0.0);
}

// Whether a surface so far in front ends a walk.
fn blocks(delta_m: f32) -> bool {
    return select(delta_m >= params.near_threshold_m, delta_m > 0.0, is_filion());
}

// How open a sample is.
fn openness(delta_m: f32) -> f32 {
    if is_filion() {
        if delta_m <= 0.0 {
            return 1.0;
        }
        let range_m = max(params.far_threshold_m - params.near_threshold_m, 1e-20);
        let beyond = clamp((delta_m - params.near_threshold_m) / range_m, 0.0, 1.0);
        return pow(max(beyond, 1e-20), params.power);
    }
    if delta_m < params.near_threshold_m || delta_m > params.far_threshold_m {
        return 1.0;
    }
    let scaled = params.distance_scale_per_m * delta_m;
    return pow(1.0 / (1.0 + scaled * scaled), params.power);
}
