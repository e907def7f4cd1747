// A shaded sample, read back from the surfaces.
//!use place
//!use normals
@group(0) @binding(3) var albedo_texture: texture_2d<f32>;

struct Point {
    texel: vec2i,
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

fn point_at(texel: vec2i) -> Point {
    let depth_m = textureLoad(depth_texture, texel, 0).x;
    let ray = world_ray(texel);
    let stored = textureLoad(albedo_texture, texel, 0);
    let finish = surface_finish(texel);
    var point: Point;
    point.texel = texel;
    point.view_m = view_ray(texel) * depth_m;
    point.world_m = frame.eye_m + ray * depth_m;
    point.normal = world_normal(texel);
    point.geometric_normal = geometric_normal(texel);
    point.to_eye = -normalize(ray);
    point.albedo = stored.rgb;
    point.specular = stored.a;
    point.roughness = finish.x;
    point.metallic = finish.y;
    return point;
}
