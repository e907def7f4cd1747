// What every occlusion technique shares. A technique defines
//     struct Params { ... }                      its parameters, in the order it declares them
//     fn accessibility(pixel: vec2i, depth_m: f32) -> f32
// where 1 is open and 0 is closed.
//!use frame
//!use fullscreen
//!use normals
@group(0) @binding(1) var depth_texture: texture_2d<f32>;
@group(0) @binding(3) var<uniform> params: Params;
// The technique's own seeded points or rotations.
@group(0) @binding(4) var<storage, read> kernel: array<vec4f>;
// 4 x 4 seeded unit vectors, tiled over the picture.
@group(0) @binding(5) var<uniform> noise: array<vec4f, 16>;

// Linear depth of a pixel, metres. Beyond the picture's edge the edge goes on, as with a clamped
// sampler: calling it open would draw a bright frame round every image.
fn depth_at(pixel: vec2i) -> f32 {
    let inside = clamp(pixel, vec2i(0), vec2i(frame.size_px) - 1);
    return textureLoad(depth_texture, occlusion_texel(inside), 0).x;
}

// Where on the target a pixel's surface was sampled.
fn sample_px(pixel: vec2i) -> vec2f {
    return vec2f(pixel) + occlusion_sample();
}

// The pixel whose sample is nearest to a point of the target.
fn nearest_pixel(target_px: vec2f) -> vec2i {
    return vec2i(floor(target_px - occlusion_sample() + 0.5));
}

fn tile_index(pixel: vec2i) -> u32 {
    let cell = vec2u(pixel) % vec2u(4u);
    return cell.y * 4u + cell.x;
}

fn view_normal(pixel: vec2i) -> vec3f {
    return (frame.view * vec4f(world_normal(occlusion_texel(pixel)), 0.0)).xyz;
}

// Linear depth of the surface that hides or is hidden by a view-space point. A point that is not
// in front of the near plane is seen by no pixel, and nothing is known of it: it counts as open.
fn surface_depth_at(position_m: vec3f) -> f32 {
    if -position_m.z < frame.near_m {
        return frame.far_m;
    }
    return depth_at(nearest_pixel(project_px(position_m)));
}

@fragment
fn fs_occlusion(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let depth_m = depth_at(pixel);
    if depth_m >= frame.far_m {
        return vec4f(1.0);
    }
    return vec4f(clamp(accessibility(pixel, depth_m), 0.0, 1.0));
}
