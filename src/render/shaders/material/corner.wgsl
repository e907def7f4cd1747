// A corner of a triangle, and what becomes of it over the triangle.
//!use frame
//!use grid
//!use material
struct Corner {
    @location(0) position_m: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec2f,
    @location(4) color: vec4f,
}

struct Surface {
    @builtin(position) position: vec4f,
    @location(0) normal: vec3f,
    @location(1) tangent: vec4f,
    @location(2) uv: vec2f,
    @location(3) color: vec4f,
    @location(4) depth_m: f32,
}

@vertex
fn vs_geometry(corner: Corner) -> Surface {
    var surface: Surface;
    let world = vec4f(corner.position_m, 1.0);
    surface.position = on_grid(frame.view_projection * world);
    surface.normal = corner.normal;
    surface.tangent = corner.tangent;
    surface.uv = corner.uv;
    surface.color = corner.color;
    surface.depth_m = -(frame.view * world).z;
    return surface;
}
