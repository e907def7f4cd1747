// A technique that knows which way its open directions lie. It defines
//     fn opening(pixel: vec2i, depth_m: f32) -> Opening
// and the frame has its bent cone by drawing fs_opening, not fs_occlusion.
//!use screen
//!use bounded

struct Opening {
    // k_A: 1 is open and 0 is closed.
    share: f32,
    // The mean of all directions by the cosine, the open ones counted as nought; world space. What is open
    // is the rest of the hemisphere, which the shading has from its own normal: so there is no noise
    // where nothing is closed, and no blur of a normal map.
    closed: vec3f,
}

struct WrittenOpening {
    @location(0) share: vec4f,
    @location(1) closed: vec4f,
}

@fragment
fn fs_opening(@builtin(position) position: vec4f) -> WrittenOpening {
    let pixel = vec2i(position.xy);
    let depth_m = depth_at(pixel);
    if depth_m >= frame.far_m {
        return WrittenOpening(vec4f(1.0), vec4f(0.0));
    }
    let found = opening(pixel, depth_m);
    return WrittenOpening(vec4f(bounded(found.share)), vec4f(found.closed, 0.0));
}
