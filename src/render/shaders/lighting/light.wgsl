// What the scene's lighting variant says.
struct Light {
    // Irradiance in nine spherical-harmonic coefficients, already folded with the cosine.
    irradiance: array<vec4f, 9>,
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
    // By which part of a turn the environment's map is seen from further right, and what its
    // radiance is multiplied by.
    environment_turn: f32,
    environment_intensity: f32,
    unused: vec2f,
    shadow_from_world: mat4x4f,
    // Unit vectors to the shadow map's right and up; w: its texture coordinates a metre.
    shadow_right: vec4f,
    shadow_up: vec4f,
    // Depth a metre; side of a texel in metres; tangent of the sun's radius; side of the map.
    shadow_depth: vec4f,
}

@group(0) @binding(4) var<uniform> light: Light;
