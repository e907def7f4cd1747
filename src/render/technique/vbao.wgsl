// Therrien et al. 2023: in each slice 32 sectors of the half circle above the surface, each open or closed.
// Occluders have a thickness, so that light passes behind them.
//!use slices
//!use opening

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

// Where a direction of the slice, to one side (1 or -1), falls among its angles, 0 to 1. What lies below the
// surface is at their end.
fn turn_of(slice: Slice, side: f32, direction: vec2f) -> f32 {
    let height = dot(direction, vec2f(slice.sin_normal, slice.cos_normal));
    let is_low = direction.x * slice.cos_normal < direction.y * slice.sin_normal;
    let turned = coarse_arc_cosine(height) / PI;
    return select(0.5 + select(turned, -turned, is_low), max(side, 0.0), height < 0.0);
}

// The sum of a slice's directions from the eye's to one of 32 even angles, each by its light.
fn moment_before(slice: Slice, sector: u32) -> vec2f {
    let angle = PI * (f32(sector) / 32.0 - 0.5);
    let sine = slice.sin_normal * cos(angle) + slice.cos_normal * sin(angle);
    let cosine = slice.cos_normal * cos(angle) - slice.sin_normal * sin(angle);
    let side = select(1.0, -1.0, sine < 0.0);
    return side * arc_moment(slice, side, clamp(cosine, -1.0, 1.0));
}

// The sum of the directions in sectors of even angle, each by its light: run of sectors by run.
fn moment_in(slice: Slice, mask: u32) -> vec2f {
    var sum = vec2f(0.0);
    var rest = mask;
    while rest != 0u {
        let first = firstTrailingBit(rest);
        let end = first + min(firstTrailingBit(~(rest >> first)), 32u - first);
        sum += moment_before(slice, end) - moment_before(slice, first);
        rest &= ~first_sectors(end);
    }
    return sum;
}

// The sectors that what is seen closes: of even light, and of even angle. The first count light, the
// second, whose bounds are known, say from where it comes.
fn closed_by(seen: Seen, sight: Sight, slice: Slice, shares: Shares, side: f32) -> vec2u {
    // Its back lies behind it on its own line of sight.
    let sightline_m = seen.offset_m - vec2f(0.0, sight.distance_m);
    let behind_m = seen.offset_m + sightline_m * (params.thickness_m * inverseSqrt(dot(sightline_m, sightline_m)));
    let to_front = seen.offset_m * seen.per_m;
    let to_back = behind_m * inverseSqrt(max(dot(behind_m, behind_m), 1e-30));
    let front = share_of(shares, slice, side, to_front);
    let back = share_of(shares, slice, side, to_back);
    let counts = seen.is_there && seen.distance_2 <= params.radius_m * params.radius_m;
    let turns = sectors(turn_of(slice, side, to_front), turn_of(slice, side, to_back));
    let closed = vec2u(sectors(front, back), turns);
    return select(vec2u(0u), closed, counts);
}

fn opening(pixel: vec2i, depth_m: f32) -> Opening {
    let sight = sight_of(pixel, depth_m);
    let noise = spatial_noise(pixel);
    var open = 0.0;
    var whole = 0.0;
    var moment = vec3f(0.0);
    for (var i = 0.0; i < params.slices; i += 1.0) {
        let angle = PI * (i + noise.x) / params.slices;
        let turn = vec2f(cos(angle), sin(angle));
        let slice = slice_at(sight, turn, params.radius_m);
        let shares = shares_of(slice);
        var closed = vec2u(0u);
        for (var k = 0.0; k < params.steps; k += 1.0) {
            let length_px = step_px(slice, (k + noise.y) / params.steps, params.step_power);
            closed |= closed_by(seen_at(sight, slice, 1.0, length_px), sight, slice, shares, 1.0);
            closed |= closed_by(seen_at(sight, slice, -1.0, length_px), sight, slice, shares, -1.0);
        }
        let light = slice.weight * slice.light;
        open += light * (1.0 - f32(countOneBits(closed.x)) / 32.0);
        whole += light;
        let below = moment_in(slice, closed.y);
        moment += slice.weight * vec3f(below.x * turn, below.y);
    }
    let all = max(whole, 1e-6);
    return Opening(open / all, in_world(pixel, depth_m, moment / all));
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    return opening(pixel, depth_m).share;
}
