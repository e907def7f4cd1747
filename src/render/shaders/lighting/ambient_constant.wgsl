// The same radiance from everywhere: thesis eq. 5 with pi cancelled, c_amb * L_A.
fn ambient_radiance(point: Point) -> vec3f {
    return point.albedo * light.constant_ambient.rgb;
}
