// The same radiance from everywhere: thesis eq. 5 with pi cancelled, c_amb * L_A.
//!use light
//!use diffuse
fn ambient_radiance(point: Point) -> vec3f {
    return diffuse_albedo(point) * light.constant_ambient.rgb;
}
