// Depth seen from the light.
@group(0) @binding(0) var<uniform> light_from_world: mat4x4f;

@vertex
fn vs_shadow(@location(0) position_m: vec3f) -> @builtin(position) vec4f {
    return light_from_world * vec4f(position_m, 1.0);
}
