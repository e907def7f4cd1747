// What the scene's lighting variant says.
struct Light {
    // Irradiance in nine spherical-harmonic coefficients, already folded with the cosine.
    irradiance: array<vec4f, 9>,
    // The environment's radiance along +x, -x, +y, -y, +z, -z.
    environment: array<vec4f, 6>,
    constant_ambient: vec4f,
    background: vec4f,
    sun_towards: vec4f,
    sun_irradiance: vec4f,
    // How much an effect counts, 0 or 1. A weight of 0 is how a frame runs an effect that
    // its scene did not ask for.
    occlusion_weight: f32,
    shadow_weight: f32,
    reflection_weight: f32,
    sky_weight: f32,
    shadow_from_world: mat4x4f,
    // Side of a shadow texel in metres; its inverse size; bias in light depth; unused.
    shadow_texel: vec4f,
}

@group(0) @binding(4) var<uniform> light: Light;
