// One coefficient for light from every direction, and a colour of what surfaces send back.
//!use point
//!use computed_occlusion
//!use baked_occlusion
//!use received
//!use ambient_term
fn occluded_ambient(point: Point) -> vec3f {
    let share = received(point, computed_occlusion(point));
    return baked_occlusion(point) * share * ambient_radiance(point);
}
