// What blizzard and ray-march share: the offsets and the falloff of thesis 4.3.2.
//!use occlusion

// A kernel point, reflected through the tiled unit vector and turned into the normal's hemisphere.
fn hemisphere_offset(point: vec3f, mirror: vec3f, normal: vec3f) -> vec3f {
    let offset = reflect(point, mirror);
    return select(offset, -offset, dot(offset, normal) < 0.0);
}

// How open a sample is. delta_m is how far the surface found there stands in front of the pixel
// (0 where it does not). Appendix B subtracts the other way round, which is right only for a
// stored depth that falls with distance; the meaning is the one of figure 16.
fn openness(delta_m: f32) -> f32 {
    if delta_m < params.near_threshold_m || delta_m > params.far_threshold_m {
        return 1.0;
    }
    let scaled = params.distance_scale_per_m * delta_m;
    return pow(1.0 / (1.0 + scaled * scaled), params.power);
}
