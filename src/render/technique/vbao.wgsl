// Therrien et al. 2023: in each slice 32 sectors of the half circle above the surface, each open or closed.
// Occluders have a thickness, so that light passes behind them.
//!use slices

// Where a direction of the slice, to one side (1 or -1), falls among its light, 0 to 1. The paper counts
// sectors of equal angle; these are of equal cosine-weighted light, so that counting them is the
// integral. What lies below the surface is at the light's end.
fn share_of(slice: Slice, side: f32, direction: vec2f) -> f32 {
    let share = (slice.low + side * arc(slice, side, direction.y)) / slice.light;
    let is_below = dot(direction, vec2f(slice.sin_normal, slice.cos_normal)) < 0.0;
    return clamp(select(share, side, is_below), 0.0, 1.0);
}

// The sectors between two shares, each in or out by its middle.
fn sectors(from_share: f32, to_share: f32) -> u32 {
    let first = u32(round(32.0 * min(from_share, to_share)));
    let last = u32(round(32.0 * max(from_share, to_share)));
    // The lowest `count` bits; a shift by 32 would be undefined.
    let count = last - first;
    let ones = select((1u << min(count, 31u)) - 1u, 0xffffffffu, count == 32u);
    return select(ones << min(first, 31u), 0u, count == 0u);
}

// The sectors that what is seen closes.
fn closed_by(seen: Seen, sight: Sight, slice: Slice, side: f32) -> u32 {
    // Its back lies behind it on its own line of sight.
    let sightline_m = seen.offset_m - vec2f(0.0, sight.distance_m);
    let behind_m = seen.offset_m + sightline_m * (params.thickness_m * inverseSqrt(dot(sightline_m, sightline_m)));
    let front = share_of(slice, side, seen.offset_m * seen.per_m);
    let back = share_of(slice, side, behind_m * inverseSqrt(max(dot(behind_m, behind_m), 1e-30)));
    let counts = seen.is_there && seen.distance_2 <= params.radius_m * params.radius_m;
    return select(0u, sectors(front, back), counts);
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let sight = sight_of(pixel, depth_m);
    let noise = spatial_noise(pixel);
    var open = 0.0;
    var whole = 0.0;
    for (var i = 0.0; i < params.slices; i += 1.0) {
        let angle = PI * (i + noise.x) / params.slices;
        let slice = slice_at(sight, vec2f(cos(angle), sin(angle)), params.radius_m);
        var closed = 0u;
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let length_px = step_px(slice, (k + noise.y) / params.steps, params.step_power);
            closed |= closed_by(seen_at(sight, slice, 1.0, length_px), sight, slice, 1.0);
            closed |= closed_by(seen_at(sight, slice, -1.0, length_px), sight, slice, -1.0);
        }
        let light = slice.weight * slice.light;
        open += light * (1.0 - f32(countOneBits(closed)) / 32.0);
        whole += light;
    }
    return open / max(whole, 1e-6);
}
