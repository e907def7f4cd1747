// Light that surfaces send to and fro: how open the point is and its own colour say how much of the
// light in the open it gets, channel by channel.
//!use point
//!use diffuse
//!use computed_occlusion
//!use baked_occlusion
//!use inter_reflection
//!use ambient_term
fn occluded_ambient(point: Point) -> vec3f {
    let openness = computed_occlusion(point);
    let albedo = diffuse_albedo(point);
    let received = vec3f(
        inter_reflected(openness, albedo.r),
        inter_reflected(openness, albedo.g),
        inter_reflected(openness, albedo.b),
    );
    return baked_occlusion(point) * received * ambient_radiance(point);
}
