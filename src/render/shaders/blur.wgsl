// Edge-aware blur of the occlusion, one direction a pass. `blur_settings` are the constants
//     direction   one pixel's step
//     radius_px   how many pixels to each side
//     plane_m     distance from the centre's plane at which a tap counts 1/e, metres
//
// A tap counts by its distance in pixels (Gaussian), by how far it lies from the plane through
// the centre, and by how far its normal turns away. The plane distance keeps the blur whole
// on floors seen at a grazing angle, where plain depth differences would cut it to pieces.
//!use frame
//!use fullscreen
//!use normals
//!use blur_settings

@group(0) @binding(1) var depth_texture: texture_2d<f32>;
@group(0) @binding(3) var occlusion_texture: texture_2d<f32>;
// Reads the very middle of texels, faster than a load where reads are software.
@group(0) @binding(4) var nearest: sampler;

@fragment
fn fs_blur(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let centre = vec2i(position.xy);
    let texels = frame.samples;
    let texel = occlusion_texel(centre);
    let size_px = vec2u(frame.size_px);
    let centre_value = textureLoad(occlusion_texture, centre, 0);
    let centre_depth_m = textureLoad(depth_texture, texel, 0).x;
    if centre_depth_m >= frame.far_m {
        return centre_value;
    }
    let world = world_normal(texel);
    let normal = (frame.view * vec4f(world, 0.0)).xyz;
    // The part of a pixel's position along the normal is its depth times what is linear in its step.
    let ray = view_position(vec2f(centre) + occlusion_sample(), 1.0);
    let px_m = vec2f(2.0, -2.0) * frame.half_extent / frame.size_px;
    let along = dot(ray, normal) / plane_m;
    let along_step = dot(vec2f(direction) * px_m, normal.xy) / plane_m;
    let plane = centre_depth_m * along;
    let per_px = 1.0 / frame.size_px;
    var sum = vec4f(0.0);
    var total = 0.0;
    for (var step = -radius_px; step <= radius_px; step++) {
        let tap = centre + direction * step;
        let at = (vec2f(tap) + occlusion_sample()) * per_px;
        let depth_m = textureSampleLevel(depth_texture, nearest, at, 0.0).x;
        let off_plane = depth_m * (along + f32(step) * along_step) - plane;
        let turned = max(dot(world, world_normal(texel + direction * (step * texels))), 0.0);
        // Two standard deviations reach the last tap.
        let distance = f32(step) / f32(max(radius_px, 1));
        let near = exp(-2.0 * distance * distance - off_plane * off_plane);
        let weight = select(0.0, near * turned * turned, all(vec2u(tap) < size_px));
        sum += weight * textureSampleLevel(occlusion_texture, nearest, at, 0.0);
        total += weight;
    }
    return sum / total;
}
