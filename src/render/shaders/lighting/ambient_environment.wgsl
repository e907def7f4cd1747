// Irradiance of the environment on the normal, over pi, and what is constant beside it.
//!use light
//!use diffuse
fn ambient_radiance(point: Point) -> vec3f {
    let n = point.normal;
    let e = light.irradiance[0].rgb * 0.2820948
        + (light.irradiance[1].rgb * n.y + light.irradiance[2].rgb * n.z + light.irradiance[3].rgb * n.x) * 0.4886025
        + (light.irradiance[4].rgb * (n.x * n.y) + light.irradiance[5].rgb * (n.y * n.z)
            + light.irradiance[7].rgb * (n.x * n.z)) * 1.0925484
        + light.irradiance[6].rgb * (0.31539157 * (3.0 * n.z * n.z - 1.0))
        + light.irradiance[8].rgb * (0.5462742 * (n.x * n.x - n.y * n.y));
    let albedo = diffuse_albedo(point);
    return albedo * light.constant_ambient.rgb + albedo * max(e, vec3f(0.0)) / 3.14159265;
}
