// Ambient light before anything hides it.
//!use light

// The environment's nine coefficients in a direction, each band times a factor of its own.
fn harmonics(n: vec3f, band: vec3f) -> vec3f {
    return light.irradiance[0].rgb * (0.2820948 * band.x)
        + (light.irradiance[1].rgb * n.y + light.irradiance[2].rgb * n.z + light.irradiance[3].rgb * n.x)
            * (0.4886025 * band.y)
        + (light.irradiance[4].rgb * (n.x * n.y) + light.irradiance[5].rgb * (n.y * n.z)
            + light.irradiance[7].rgb * (n.x * n.z)) * (1.0925484 * band.z)
        + light.irradiance[6].rgb * (0.31539157 * band.z * (3.0 * n.z * n.z - 1.0))
        + light.irradiance[8].rgb * (0.5462742 * band.z * (n.x * n.x - n.y * n.y));
}

// Irradiance of the environment on a surface that faces `normal`.
fn environment_irradiance(normal: vec3f) -> vec3f {
    return max(harmonics(normal, vec3f(1.0)), vec3f(0.0));
}

// The ambient radiance of a white matte surface that faces `normal`, with nothing before it.
fn uncovered_ambient(normal: vec3f) -> vec3f {
    return light.constant_ambient.rgb + environment_irradiance(normal) / 3.14159265;
}
