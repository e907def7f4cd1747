// What a technique sees: the surfaces as the picture shows them, and `params`, its own parameters by
// the names it declares, which are constants of the shader.
//!use params
//!use frame
//!use fullscreen
//!use place
//!use normals
// The technique's own seeded points or rotations.
@group(0) @binding(21) var<storage, read> kernel: array<vec4f>;
// 4 x 4 seeded unit vectors, tiled over the picture.
@group(0) @binding(22) var<uniform> noise: array<vec4f, 16>;

@group(0) @binding(24) var nearest: sampler;

// Linear depth of a pixel of the picture, metres. A sampler that reads the very middle of a texel reads that
// texel, and does so faster than a load where reads are software.
fn seen_depth(pixel: vec2i) -> f32 {
    return textureSampleLevel(depth_texture, nearest, sample_px(pixel) / frame.size_px, 0.0).x;
}

// The same of any pixel. Beyond the picture's edge the edge goes on, as with a clamped
// sampler: calling it open would draw a bright frame round every image.
fn depth_at(pixel: vec2i) -> f32 {
    let inside = clamp(pixel, vec2i(0), vec2i(frame.size_px) - 1);
    return seen_depth(inside);
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
