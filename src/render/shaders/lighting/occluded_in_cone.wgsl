// The environment's light comes in through the bent cone, not from all round. What is constant, and what
// surfaces send back, is the same through any cone.
//!use light
//!use point
//!use gather
//!use diffuse
//!use bent_cone
//!use computed_occlusion
//!use baked_occlusion
//!use received
//!use ambient_term
@group(0) @binding(15) var cone_texture: texture_2d<f32>;

fn occluded_ambient(point: Point) -> vec3f {
    let normal = (frame.view * vec4f(point.geometric_normal, 0.0)).xyz;
    let last = vec2i(frame.image_px) - 1;
    let closed = gathered(cone_texture, point.texel, point.view_m, normal, frame.samples, last).xyz;
    let moment = point.normal * (2.0 / 3.0) - light.occlusion_weight * closed;
    let open = computed_occlusion(point);
    let bent = irradiance_within(open, moment) - open * environment_irradiance(point.normal);
    let ambient = received(point, open) * ambient_radiance(point) + diffuse_albedo(point) * (bent / 3.14159265);
    return baked_occlusion(point) * max(ambient, vec3f(0.0));
}
