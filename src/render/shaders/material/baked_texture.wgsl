//!use sampling
@group(1) @binding(9) var baked_map: texture_2d<f32>;
@group(1) @binding(10) var baked_sampler: sampler;

fn material_baked(surface: Surface) -> f32 {
    let baked = sample_map(baked_map, baked_sampler, slot_uv(surface.uv, 4u)).r;
    return 1.0 + material.baked_strength * (baked - 1.0);
}
