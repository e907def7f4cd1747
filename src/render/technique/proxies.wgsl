// Spheres in place of the scene's triangles: world-space centre, radius, metres. At least one, of radius
// 0 where there is nothing to stand for.
@group(0) @binding(23) var<storage, read> proxy_spheres: array<vec4f>;
