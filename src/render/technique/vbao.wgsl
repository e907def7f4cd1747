// Therrien et al. 2023: in each slice 32 sectors of the half circle above the surface, each open or closed.
// Occluders have a thickness, so that light passes behind them.
//!use slices

// What a slice's angles and its light have to do with each other.
struct Shares {
    // The share on the side of -1, and what the square of a sine and an arc count by.
    low: f32,
    by_square: f32,
    by_arc: f32,
}

fn shares_of(slice: Slice) -> Shares {
    let scale = 0.5 / slice.light;
    return Shares(slice.low / slice.light, scale * slice.cos_normal, scale * slice.sin_normal);
}

// The angle of a cosine to 7e-5 (Abramowitz & Stegun 1964, 4.4.45): a thousandth of a sector, twice a sample.
fn coarse_arc_cosine(cosine: f32) -> f32 {
    let x = abs(cosine);
    let sum = fma(fma(fma(-0.0187293, x, 0.0742610), x, -0.2121144), x, 1.5707288);
    let angle = sqrt(max(1.0 - x, 0.0)) * sum;
    return select(angle, PI - angle, cosine < 0.0);
}

// Where a direction of the slice, to one side (1 or -1), falls among its light, 0 to 1 but for 1e-4. The
// paper counts sectors of equal angle; these are of equal cosine-weighted light, so that counting them is the
// integral. What lies below the surface is at the light's end.
fn share_of(shares: Shares, slice: Slice, side: f32, direction: vec2f) -> f32 {
    let sine = side * direction.x;
    let turned = coarse_arc_cosine(direction.y) - sine * direction.y;
    let share = shares.low + side * shares.by_square * sine * sine + shares.by_arc * turned;
    let is_below = dot(direction, vec2f(slice.sin_normal, slice.cos_normal)) < 0.0;
    return select(share, max(side, 0.0), is_below);
}

// How many sectors of 32 lie before a share, each in or out by its middle. Whole numbers of a float that large
// are its last bits: rounded, without a conversion.
fn sectors_before(share: f32) -> u32 {
    return bitcast<u32>(32.0 * share + 8388608.0) & 63u;
}

// The first sectors, 0 to 32 of them.
fn first_sectors(count: u32) -> u32 {
    // A shift by 32 would be undefined.
    return select((1u << (count & 31u)) - 1u, 0xffffffffu, count > 31u);
}

fn sectors(from_share: f32, to_share: f32) -> u32 {
    return first_sectors(sectors_before(from_share)) ^ first_sectors(sectors_before(to_share));
}

// The sectors that what is seen closes.
fn closed_by(seen: Seen, sight: Sight, slice: Slice, shares: Shares, side: f32) -> u32 {
    // Its back lies behind it on its own line of sight.
    let sightline_m = seen.offset_m - vec2f(0.0, sight.distance_m);
    let behind_m = seen.offset_m + sightline_m * (params.thickness_m * inverseSqrt(dot(sightline_m, sightline_m)));
    let front = share_of(shares, slice, side, seen.offset_m * seen.per_m);
    let back = share_of(shares, slice, side, behind_m * inverseSqrt(max(dot(behind_m, behind_m), 1e-30)));
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
        let shares = shares_of(slice);
        var closed = 0u;
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let length_px = step_px(slice, (k + noise.y) / params.steps, params.step_power);
            closed |= closed_by(seen_at(sight, slice, 1.0, length_px), sight, slice, shares, 1.0);
            closed |= closed_by(seen_at(sight, slice, -1.0, length_px), sight, slice, shares, -1.0);
        }
        let light = slice.weight * slice.light;
        open += light * (1.0 - f32(countOneBits(closed)) / 32.0);
        whole += light;
    }
    return open / max(whole, 1e-6);
}
