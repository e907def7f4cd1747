// One coefficient for light from every direction: thesis eq. 5, k_A c_amb L_A.
//!use point
//!use computed_occlusion
//!use baked_occlusion
//!use ambient_term
fn occluded_ambient(point: Point) -> vec3f {
    return computed_occlusion(point) * baked_occlusion(point) * ambient_radiance(point);
}
