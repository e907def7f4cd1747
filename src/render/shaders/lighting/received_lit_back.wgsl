// Light that surfaces send to and fro: how open the point is and its own colour say how much of the
// light in the open it gets, channel by channel.
//!use point
//!use diffuse
//!use inter_reflection
fn received(point: Point, openness: f32) -> vec3f {
    let albedo = diffuse_albedo(point);
    return vec3f(
        inter_reflected(openness, albedo.r),
        inter_reflected(openness, albedo.g),
        inter_reflected(openness, albedo.b),
    );
}
