// Shading, thesis eq. 5: ambient term k_A c_amb L_A, plus visibility * BRDF * E * cos for the
// light. Occlusion stands in the ambient term and nowhere else.
//
// The parts named below differ by what the scene calls for; a part that is not called for is a
// constant, and its inputs are not bound.
//!use frame
//!use fullscreen
//!use normals
//!use light
//!use occlusion_factor
//!use ambient
//!use sun
//!use background
@group(0) @binding(1) var depth_texture: texture_2d<f32>;
@group(0) @binding(3) var albedo_texture: texture_2d<f32>;

struct Point {
    pixel: vec2i,
    view_m: vec3f,
    world_m: vec3f,
    normal: vec3f,
    geometric_normal: vec3f,
    // Unit vector towards the eye.
    to_eye: vec3f,
    albedo: vec3f,
    specular: f32,
    roughness: f32,
    metallic: f32,
}

@fragment
fn fs_lighting(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let depth_m = textureLoad(depth_texture, pixel, 0).x;
    let ray = (frame.inverse_view * vec4f(view_position(position.xy, 1.0), 0.0)).xyz;
    if depth_m >= frame.far_m {
        return vec4f(background_radiance(normalize(ray)), 1.0);
    }
    let stored = textureLoad(albedo_texture, pixel, 0);
    let finish = surface_finish(pixel);
    var point: Point;
    point.pixel = pixel;
    point.view_m = view_position(position.xy, depth_m);
    point.world_m = frame.eye_m + ray * depth_m;
    point.normal = world_normal(pixel);
    point.geometric_normal = geometric_normal(pixel);
    point.to_eye = -normalize(ray);
    point.albedo = stored.rgb;
    point.specular = stored.a;
    point.roughness = finish.x;
    point.metallic = finish.y;
    let ambient = occlusion_factor(point) * ambient_radiance(point);
    return vec4f(ambient + sun_radiance(point), 1.0);
}
