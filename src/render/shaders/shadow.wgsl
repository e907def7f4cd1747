// Depth seen from the light.
//!use frame
@vertex
fn vs_geometry(@location(0) position_m: vec3f) -> @builtin(position) vec4f {
    return frame.view_projection * vec4f(position_m, 1.0);
}
