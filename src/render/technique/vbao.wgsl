// Therrien et al. 2023: in each slice 32 sectors of the half circle above the surface, each open or closed.
// Occluders have a thickness, so that light passes behind them.
//!use slices
struct Params {
    slices: f32,
    steps: f32,
    radius_m: f32,
    thickness_m: f32,
    step_power: f32,
}

// Where an angle falls among the slice's light, 0 to 1. The paper counts sectors of equal angle;
// these are of equal cosine-weighted light, so that counting them is the integral.
fn share_of(angle: f32, slice: Slice) -> f32 {
    let n = slice.normal_angle;
    let low = arc(n - 0.5 * PI, n);
    let whole = low + arc(n + 0.5 * PI, n);
    let clamped = clamp(angle, n - 0.5 * PI, n + 0.5 * PI);
    let part = arc(clamped, n);
    return clamp((low + select(part, -part, clamped < 0.0)) / max(whole, 1e-6), 0.0, 1.0);
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

fn closed_sectors(slice: Slice, centre_m: vec3f, pixel: vec2i, side: f32, jitter: f32) -> u32 {
    var closed = 0u;
    for (var i = 0.0; i < params.steps; i += 1.0) {
        let step = step_px(slice, side, params.radius_m, i + jitter, params.steps, params.step_power);
        let seen = seen_at(slice, side, centre_m, pixel, step);
        if !seen.is_there || seen.distance_m > params.radius_m {
            continue;
        }
        let behind_m = seen.position_m + normalize(seen.position_m) * params.thickness_m - centre_m;
        let front = share_of(angle_of(seen.offset_m, side), slice);
        let back = share_of(angle_of(into_slice(slice, behind_m), side), slice);
        closed |= sectors(front, back);
    }
    return closed;
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let noise = spatial_noise(pixel);
    var open = 0.0;
    var whole = 0.0;
    for (var i = 0.0; i < params.slices; i += 1.0) {
        let slice = slice_at(centre_m, normal, PI * (i + noise.x) / params.slices);
        let closed = closed_sectors(slice, centre_m, pixel, 1.0, noise.y)
            | closed_sectors(slice, centre_m, pixel, -1.0, noise.y);
        let n = slice.normal_angle;
        let light = slice.weight * (arc(n - 0.5 * PI, n) + arc(n + 0.5 * PI, n));
        open += light * (1.0 - f32(countOneBits(closed)) / 32.0);
        whole += light;
    }
    return open / max(whole, 1e-6);
}
