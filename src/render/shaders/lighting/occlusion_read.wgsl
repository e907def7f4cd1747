// k_A of the point, from the occlusion target.
//!use light
//!use point
//!use gather
@group(0) @binding(5) var occlusion_texture: texture_2d<f32>;

fn computed_occlusion(point: Point) -> f32 {
    let normal = (frame.view * vec4f(point.geometric_normal, 0.0)).xyz;
    let last = vec2i(frame.image_px) - 1;
    let found = gathered(occlusion_texture, point.texel, point.view_m, normal, frame.samples, last).x;
    return 1.0 + light.occlusion_weight * (found - 1.0);
}
