// What of the albedo answers light from all round. A metal's colour is its reflection's; where
// no reflections run it stands in for them, or metal would be black.
//!use light
//!use point
fn diffuse_albedo(point: Point) -> vec3f {
    return point.albedo * (1.0 - light.reflection_weight * point.metallic);
}
