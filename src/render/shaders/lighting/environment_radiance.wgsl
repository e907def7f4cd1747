// The environment's radiance from a unit direction.
//!use light
fn environment_radiance(towards: vec3f) -> vec3f {
    let weight = towards * towards;
    let x = select(light.environment[0], light.environment[1], towards.x < 0.0).rgb;
    let y = select(light.environment[2], light.environment[3], towards.y < 0.0).rgb;
    let z = select(light.environment[4], light.environment[5], towards.z < 0.0).rgb;
    return x * weight.x + y * weight.y + z * weight.z;
}
