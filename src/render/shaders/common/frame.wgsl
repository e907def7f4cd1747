// The camera and the target of the pass at hand.
//
// View space: metres, +X right, +Y up, the camera looks along -Z. Linear depth is -z:
// positive, metres. A texel without a surface has depth frame.far_m.
//
// Surfaces are drawn at several samples a pixel. Occlusion is estimated once a pixel, on one of
// its samples: its number of samples a pixel then means what it says, whatever the image's.

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
    // Size of the image.
    image_px: vec2f,
    // Samples of the surfaces along one side of a pixel.
    samples: i32,
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

// The sample of an image pixel that its occlusion belongs to: the texel of the surfaces,
fn occlusion_texel(pixel: vec2i) -> vec2i {
    return pixel * frame.samples + frame.samples / 2;
}

// and where it lies within the pixel, from the pixel's corner.
fn occlusion_sample() -> f32 {
    return (f32(frame.samples / 2) + 0.5) / f32(frame.samples);
}
