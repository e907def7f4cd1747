// A target of occlusion of half resolution to every pixel.
//!use frame
//!use fullscreen
//!use normals
//!use gather
@group(0) @binding(4) var occlusion_texture: texture_2d<f32>;

@fragment
fn fs_upsample(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = occlusion_texel(vec2i(position.xy));
    let depth_m = textureLoad(depth_texture, texel, 0).x;
    if depth_m >= frame.far_m {
        return vec4f(1.0);
    }
    let normal = (frame.view * vec4f(geometric_normal(texel), 0.0)).xyz;
    let last = vec2i(textureDimensions(occlusion_texture)) - 1;
    return gathered(occlusion_texture, texel, view_ray(texel) * depth_m, normal, 2 * frame.samples, last);
}
