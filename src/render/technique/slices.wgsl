// What techniques share that look along slices: planes through the eye and the point, in which
// angles are measured from the direction to the eye.
//
// All is reckoned in three axes at the point: right and up, across the line of sight, and towards
// the eye. A pixel's place in them is linear in its depth and in its step from the point's own.
//!use occlusion
//!use spatial_noise
const PI: f32 = 3.14159265358979;

// A point and the line of sight to it.
struct Sight {
    pixel: vec2i,
    depth_m: f32,
    // From the eye to the point, metres.
    distance_m: f32,
    // What a step of one pixel along rows and along columns adds at a depth of 1 m.
    right: vec2f,
    up: vec2f,
    view: vec2f,
    // The unit normal.
    normal: vec3f,
    // A metre to the right, and up, in pixels at the point.
    right_px: vec2f,
    up_px: vec2f,
    // One over the depth.
    per_depth: f32,
    // What samples need of the frame, read once.
    size_px: vec2u,
    diagonal_px: f32,
    at_px: vec2f,
    per_px: vec2f,
    far_m: f32,
}

fn sight_of(pixel: vec2i, depth_m: f32) -> Sight {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    var sight: Sight;
    sight.pixel = pixel;
    sight.depth_m = depth_m;
    sight.distance_m = length(centre_m);
    let view = centre_m / -sight.distance_m;
    // The line of sight never lies along the picture's rows.
    let right = normalize(vec3f(1.0, 0.0, 0.0) - view * view.x);
    let up = cross(view, right);
    let px_m = vec2f(2.0, -2.0) * frame.half_extent / frame.size_px;
    sight.right = px_m * right.xy;
    sight.up = px_m * up.xy;
    sight.view = px_m * view.xy;
    sight.normal = vec3f(dot(normal, right), dot(normal, up), dot(normal, view));
    let to_px = 1.0 / (px_m * depth_m);
    let slope = centre_m.xy / depth_m;
    sight.right_px = (right.xy + slope * right.z) * to_px;
    sight.up_px = (up.xy + slope * up.z) * to_px;
    sight.per_depth = 1.0 / depth_m;
    sight.size_px = vec2u(frame.size_px);
    sight.diagonal_px = length(frame.size_px);
    sight.at_px = sample_px(pixel);
    sight.per_px = 1.0 / frame.size_px;
    sight.far_m = frame.far_m;
    return sight;
}

// A plane that holds the line of sight.
struct Slice {
    // What a step of one pixel adds across the line of sight, and out of the slice, at 1 m.
    across: vec2f,
    out: vec2f,
    // What a metre out of the slice becomes once brought back into it: across, and towards the eye.
    drag: vec2f,
    // Sine and cosine of the angle from the eye to the normal's part within the slice, and that part's length.
    sin_normal: f32,
    cos_normal: f32,
    weight: f32,
    // All its cosine-weighted light, and the part of it on the side of -1.
    light: f32,
    low: f32,
    // Direction on the picture, and how far the radius reaches there, pixels.
    direction: vec2f,
    reach_px: f32,
}

// The slice at an angle about the line of sight, given by its cosine and sine. Slices at even angles stand
// evenly about it everywhere in the picture, which slices at even angles on the screen do not.
fn slice_at(sight: Sight, turn: vec2f, radius_m: f32) -> Slice {
    var slice: Slice;
    slice.across = turn.x * sight.right + turn.y * sight.up;
    slice.out = turn.y * sight.right - turn.x * sight.up;
    let along = dot(turn, sight.normal.xy);
    let beside = turn.y * sight.normal.x - turn.x * sight.normal.y;
    // What lies beside the slice is brought into it along the surface, which keeps its height above
    // the surface: so a plane never hides itself, however a sample is rounded to a pixel.
    slice.drag = vec2f(along, sight.normal.z) * (beside / max(1.0 - beside * beside, 1e-6));
    slice.weight = sqrt(along * along + sight.normal.z * sight.normal.z);
    // A normal map may turn the normal away from the eye: then it lies across.
    let scale = 1.0 / max(slice.weight, 1e-6);
    slice.sin_normal = select(along * scale, sign(along), sight.normal.z < 0.0);
    slice.cos_normal = max(sight.normal.z * scale, 0.0);
    let metre_px = turn.x * sight.right_px + turn.y * sight.up_px;
    let px_per_m = length(metre_px);
    slice.direction = metre_px / max(px_per_m, 1e-20);
    slice.reach_px = min(px_per_m * radius_m, sight.diagonal_px);
    slice.light = whole_arc(slice);
    slice.low = low_arc(slice);
    return slice;
}

// How far a sample lies from the pixel, in pixels, at a share of the way to the radius: denser near the
// point, at least a pixel, at most to the far end of the picture.
fn step_px(slice: Slice, share: f32, power: f32) -> f32 {
    return max(slice.reach_px * pow(share, power), 1.0);
}

struct Seen {
    // From the point to the surface that a sample found, metres: across and towards the eye, brought into
    // the slice.
    offset_m: vec2f,
    // One over its length.
    per_m: f32,
    // Square of its true distance, square metres.
    distance_2: f32,
    // Whether there is one: not off the picture, the sky, the point's own pixel, or beside it.
    is_there: bool,
}

// The sample that far from the pixel, on one side of the slice (1 or -1).
fn seen_at(sight: Sight, slice: Slice, side: f32, length_px: f32) -> Seen {
    var seen: Seen;
    let to_px = slice.direction * (side * length_px);
    // Whole numbers of a float that large are its last bits: rounded, without a conversion.
    let step_px = bitcast<vec2i>(to_px + 12582912.0) - 0x4b400000;
    let step = vec2f(step_px);
    let tap = sight.pixel + step_px;
    let at = (sight.at_px + step) * sight.per_px;
    let depth_m = textureSampleLevel(depth_texture, nearest, at, 0.0).x;
    let true_m = vec3f(
        depth_m * dot(step, slice.across),
        depth_m * dot(step, slice.out),
        depth_m * dot(step, sight.view) + sight.distance_m * ((sight.depth_m - depth_m) * sight.per_depth),
    );
    seen.distance_2 = dot(true_m, true_m);
    seen.offset_m = true_m.xz + true_m.y * slice.drag;
    let offset_2 = dot(seen.offset_m, seen.offset_m);
    seen.per_m = inverseSqrt(max(offset_2, 1e-30));
    // A sample rounded to a pixel may come to lie on the slice's other side, or hardly in the slice
    // at all: on a surface seen at a grazing angle a pixel to the side is far away.
    seen.is_there = all(vec2u(tap) < sight.size_px) && depth_m < sight.far_m
        && seen.offset_m.x * side > 0.0 && 16.0 * offset_2 > seen.distance_2;
    return seen;
}

// The angle of a cosine, 0 to pi: Abramowitz & Stegun 1964, 4.4.46, right to 2e-8 but for rounding.
fn arc_cosine(cosine: f32) -> f32 {
    let x = min(abs(cosine), 1.0);
    var sum = fma(-0.0012624911, x, 0.0066700901);
    sum = fma(sum, x, -0.0170881256);
    sum = fma(sum, x, 0.0308918810);
    sum = fma(sum, x, -0.0501743046);
    sum = fma(sum, x, 0.0889789874);
    sum = fma(sum, x, -0.2145988016);
    sum = fma(sum, x, 1.5707963050);
    let angle = sqrt(1.0 - x) * sum;
    return select(angle, PI - angle, cosine < 0.0);
}

// The part of a slice's cosine-weighted light between the eye's direction and an angle to one side
// (1 or -1), by the angle's cosine: the integral of cos(t - n) |sin t| without sign
// (Jimenez et al. 2016, eq. 10).
fn arc(slice: Slice, side: f32, cosine: f32) -> f32 {
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let turned = arc_cosine(cosine) - sine * cosine;
    return 0.5 * (slice.cos_normal * sine * sine + side * slice.sin_normal * turned);
}

// All of it, from surface to surface.
fn whole_arc(slice: Slice) -> f32 {
    return slice.cos_normal + abs(slice.sin_normal) * arc_cosine(slice.cos_normal);
}

// What of it lies on the side of -1.
fn low_arc(slice: Slice) -> f32 {
    return 0.5 * (slice.cos_normal - slice.sin_normal * arc_cosine(slice.sin_normal));
}

// The sum of directions of a slice between the eye's direction and an angle to one side (1 or -1), by the
// angle's cosine, each by its light: the integral of cos(t - n) |sin t| (sin t, cos t) without sign, across
// and towards the eye (as the bent normal of Jimenez et al. 2016).
fn arc_moment(slice: Slice, side: f32, cosine: f32) -> vec2f {
    let sine_2 = max(1.0 - cosine * cosine, 0.0);
    let sine_3 = sine_2 * sqrt(sine_2);
    let cosine_3 = cosine * cosine * cosine;
    return vec2f(
        side * slice.cos_normal * sine_3 + slice.sin_normal * (2.0 - 3.0 * cosine + cosine_3),
        slice.cos_normal * (1.0 - cosine_3) + side * slice.sin_normal * sine_3,
    ) / 3.0;
}

// A vector in the axes of a point's line of sight, in the world.
fn in_world(pixel: vec2i, depth_m: f32, along: vec3f) -> vec3f {
    let view = -normalize(view_position(sample_px(pixel), depth_m));
    let right = normalize(vec3f(1.0, 0.0, 0.0) - view * view.x);
    let turned = along.x * right + along.y * cross(view, right) + along.z * view;
    return (frame.inverse_view * vec4f(turned, 0.0)).xyz;
}
