// A technique whose answer differs by direction and colour. It defines
//     fn directional(pixel: vec2i, depth_m: f32) -> Directional
//!use screen
//!use bounded

struct Directional {
    // 1 is open and 0 is closed.
    accessibility: f32,
    // By how much the ambient radiance of a white matte surface differs from that of an open one:
    // less what occluders hide, more what they send.
    change: vec3f,
    // The mean of all directions, the open ones counted as nought; view space.
    closed: vec3f,
}

struct Written {
    @location(0) accessibility: vec4f,
    @location(1) change: vec4f,
}

@fragment
fn fs_occlusion(@builtin(position) position: vec4f) -> Written {
    let pixel = vec2i(position.xy);
    let depth_m = depth_at(pixel);
    if depth_m >= frame.far_m {
        return Written(vec4f(1.0), vec4f(0.0));
    }
    let found = directional(pixel, depth_m);
    return Written(vec4f(bounded(found.accessibility)), vec4f(found.change, 0.0));
}
