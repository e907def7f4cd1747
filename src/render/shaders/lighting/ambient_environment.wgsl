// Irradiance of the environment on the normal, over pi, and what is constant beside it.
//!use light
//!use diffuse
//!use irradiance
fn ambient_radiance(point: Point) -> vec3f {
    let albedo = diffuse_albedo(point);
    return albedo * light.constant_ambient.rgb + albedo * environment_irradiance(point.normal) / 3.14159265;
}
