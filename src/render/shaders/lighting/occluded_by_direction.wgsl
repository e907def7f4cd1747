// Ambient light of which occluders take their own directions, and send a bounce: the directional target
// says what a white surface's radiance changes by.
//!use light
//!use point
//!use gather
//!use diffuse
//!use baked_occlusion
//!use ambient_term
@group(0) @binding(6) var directional_texture: texture_2d<f32>;

fn occluded_ambient(point: Point) -> vec3f {
    let normal = (frame.view * vec4f(point.geometric_normal, 0.0)).xyz;
    let last = vec2i(frame.image_px) - 1;
    let change = gathered(directional_texture, point.texel, point.view_m, normal, frame.samples, last).rgb;
    let ambient = ambient_radiance(point) + light.occlusion_weight * diffuse_albedo(point) * change;
    return baked_occlusion(point) * max(ambient, vec3f(0.0));
}
