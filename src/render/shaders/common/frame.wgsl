// The camera and the target of the pass at hand.
//
// View space: metres, +X right, +Y up, the camera looks along -Z. Linear depth is -z:
// positive, metres. A pixel without a surface has depth frame.far_m.

struct Frame {
    view: mat4x4f,
    view_projection: mat4x4f,
    inverse_view: mat4x4f,
    eye_m: vec3f,
    near_m: f32,
    // Half width and height of the picture at depth 1 m, metres.
    half_extent: vec2f,
    far_m: f32,
    exposure: f32,
    // Size of this pass' target.
    size_px: vec2f,
    // Size of the occlusion targets.
    occlusion_size_px: vec2f,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// View-space position of a point of the target (pixel centres are at .5) at a linear depth.
fn view_position(target_px: vec2f, depth_m: f32) -> vec3f {
    let ndc = vec2f(2.0, -2.0) * target_px / frame.size_px + vec2f(-1.0, 1.0);
    return vec3f(ndc * frame.half_extent * depth_m, -depth_m);
}

// Where a view-space point lies on the target, in pixels. Only for points in front of the eye.
fn project_px(position_m: vec3f) -> vec2f {
    let ndc = position_m.xy / (frame.half_extent * -position_m.z);
    return (ndc * vec2f(0.5, -0.5) + 0.5) * frame.size_px;
}

fn is_inside(pixel: vec2i) -> bool {
    return all(pixel >= vec2i(0)) && all(pixel < vec2i(frame.size_px));
}
