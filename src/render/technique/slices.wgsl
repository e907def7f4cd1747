// What techniques share that look along slices: planes through the eye and the point, in which
// angles are measured from the direction to the eye.
//!use occlusion
//!use spatial_noise
const PI: f32 = 3.14159265358979;

struct Slice {
    // Unit vectors that span it: towards the eye, and across.
    view: vec3f,
    across: vec3f,
    // The surface's direction that leads out of the slice, scaled to advance 1 along its axis.
    out: vec3f,
    axis: vec3f,
    // Angle from the eye to the normal's part within the slice, and that part's length.
    normal_angle: f32,
    weight: f32,
    // A metre across, in pixels at the point.
    px_per_m: vec2f,
}

// The slice at an angle about the line of sight. Slices at even angles stand evenly about it
// everywhere in the picture, which slices at even angles on the screen do not.
fn slice_at(centre_m: vec3f, normal: vec3f, angle: f32) -> Slice {
    var slice: Slice;
    slice.view = normalize(-centre_m);
    let right = normalize(vec3f(1.0, 0.0, 0.0) - slice.view * slice.view.x);
    let up = cross(slice.view, right);
    slice.across = cos(angle) * right + sin(angle) * up;
    slice.axis = cross(slice.across, slice.view);
    let beside = dot(normal, slice.axis);
    let within = normal - slice.axis * beside;
    slice.weight = length(within);
    slice.out = (slice.axis - normal * beside) / max(1.0 - beside * beside, 1e-6);
    // A normal map may turn the normal away from the eye.
    slice.normal_angle = clamp(atan2(dot(within, slice.across), dot(within, slice.view)), -0.5 * PI, 0.5 * PI);
    let depth_m = -centre_m.z;
    let drift = slice.across.xy * depth_m + centre_m.xy * slice.across.z;
    slice.px_per_m = drift / (depth_m * depth_m) * frame.size_px * vec2f(0.5, -0.5) / frame.half_extent;
    return slice;
}

struct Seen {
    // From the point to the surface that a sample found, metres, within the slice.
    offset_m: vec2f,
    // Its true distance, metres, and where it lies.
    distance_m: f32,
    position_m: vec3f,
    // Whether there is one: not off the picture, the sky, the point's own pixel, or beside it.
    is_there: bool,
}

// A point of view space in the slice's own axes: x across, y towards the eye. What lies beside
// the slice is brought into it along the surface, which keeps its height above the surface: so
// a plane never hides itself, however a sample is rounded to a pixel.
fn into_slice(slice: Slice, offset_m: vec3f) -> vec2f {
    let inside = offset_m - slice.out * dot(offset_m, slice.axis);
    return vec2f(dot(inside, slice.across), dot(inside, slice.view));
}

// The sample at `step_px` from the pixel, on one side of the slice (1 or -1).
fn seen_at(slice: Slice, side: f32, centre_m: vec3f, pixel: vec2i, step_px: vec2f) -> Seen {
    var seen: Seen;
    let tap = nearest_pixel(sample_px(pixel) + step_px);
    if !is_inside(tap) || all(tap == pixel) {
        return seen;
    }
    let depth_m = depth_at(tap);
    if depth_m >= frame.far_m {
        return seen;
    }
    seen.position_m = view_position(sample_px(tap), depth_m);
    let offset_m = seen.position_m - centre_m;
    seen.distance_m = length(offset_m);
    seen.offset_m = into_slice(slice, offset_m);
    // A sample rounded to a pixel may come to lie on the slice's other side, or hardly in the slice
    // at all: on a surface seen at a grazing angle a pixel to the side is far away.
    seen.is_there = seen.offset_m.x * side > 0.0 && 4.0 * length(seen.offset_m) > seen.distance_m;
    return seen;
}

// The step of that number of `count`, in pixels: denser near the point, at least a pixel long,
// at most to the far end of the picture.
fn step_px(slice: Slice, side: f32, radius_m: f32, number: f32, count: f32, power: f32) -> vec2f {
    let reach_px = length(slice.px_per_m) * radius_m;
    if !(reach_px > 0.0) {
        return vec2f(0.0);
    }
    let direction = slice.px_per_m / length(slice.px_per_m);
    let length_px = min(reach_px, length(frame.size_px)) * pow(number / count, power);
    return direction * side * max(length_px, 1.0);
}

// The angle from the eye of something seen, on one side of the slice (1 or -1).
fn angle_of(offset_m: vec2f, side: f32) -> f32 {
    return side * acos(clamp(offset_m.y / max(length(offset_m), 1e-20), -1.0, 1.0));
}

// The part of a slice's cosine-weighted light between the eye's direction and an angle:
// the integral of cos(t - n) |sin t| from 0 to `angle`, without sign (Jimenez et al. 2016,
// eq. 10).
fn arc(angle: f32, normal_angle: f32) -> f32 {
    return 0.25 * (cos(normal_angle) + 2.0 * angle * sin(normal_angle) - cos(2.0 * angle - normal_angle));
}
