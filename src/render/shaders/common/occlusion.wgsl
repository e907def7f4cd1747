// A technique whose answer is one number. It defines
//     fn accessibility(pixel: vec2i, depth_m: f32) -> f32
// where 1 is open and 0 is closed.
//!use screen
//!use bounded

@fragment
fn fs_occlusion(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let depth_m = depth_at(pixel);
    if depth_m >= frame.far_m {
        return vec4f(1.0);
    }
    return vec4f(bounded(accessibility(pixel, depth_m)));
}
