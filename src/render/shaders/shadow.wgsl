// Depth seen from the light.
//!use frame
//!use grid
@vertex
fn vs_geometry(@location(0) position_m: vec3f) -> @builtin(position) vec4f {
    return on_grid(frame.view_projection * vec4f(position_m, 1.0));
}
