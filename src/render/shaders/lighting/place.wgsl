// Where the surface of a texel is.
//!use frame
@group(0) @binding(1) var depth_texture: texture_2d<f32>;

fn has_surface(texel: vec2i) -> bool {
    return textureLoad(depth_texture, texel, 0).x < frame.far_m;
}

// View-space direction through a texel's centre, of length 1 along the view's axis.
fn view_ray(texel: vec2i) -> vec3f {
    let size = frame.image_px * f32(frame.samples);
    let ndc = vec2f(2.0, -2.0) * (vec2f(texel) + 0.5) / size + vec2f(-1.0, 1.0);
    return vec3f(ndc * frame.half_extent, -1.0);
}

fn world_ray(texel: vec2i) -> vec3f {
    return (frame.inverse_view * vec4f(view_ray(texel), 0.0)).xyz;
}
