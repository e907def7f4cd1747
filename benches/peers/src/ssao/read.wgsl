// Bevy's textures, which may be bound but not copied, to numbers: planes of one number a pixel.
@group(0) @binding(0) var before_denoising: texture_2d<f32>;
@group(1) @binding(0) var<storage, read_write> found: array<f32>;
@group(1) @binding(1) var denoised: texture_2d<f32>;
@group(1) @binding(2) var depth: texture_depth_2d;
@group(1) @binding(3) var normals: texture_2d<f32>;

fn put(plane: u32, pixel: vec2u, size: vec2u, value: f32) {
    found[(plane * size.y + pixel.y) * size.x + pixel.x] = value;
}

// Plane 0: the occlusion before denoising.
@compute @workgroup_size(8, 8)
fn read_before_denoising(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(before_denoising);
    if all(id.xy < size) {
        put(0u, id.xy, size, textureLoad(before_denoising, id.xy, 0).x);
    }
}

// Planes 1 to 5: after denoising, depth in clip space, world-space normal.
@compute @workgroup_size(8, 8)
fn read_others(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(denoised);
    if all(id.xy < size) {
        put(1u, id.xy, size, textureLoad(denoised, id.xy, 0).x);
        put(2u, id.xy, size, textureLoad(depth, id.xy, 0));
        let normal = textureLoad(normals, id.xy, 0).xyz * 2.0 - 1.0;
        put(3u, id.xy, size, normal.x);
        put(4u, id.xy, size, normal.y);
        put(5u, id.xy, size, normal.z);
    }
}
