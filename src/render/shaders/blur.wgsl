// Edge-aware blur of the occlusion, one direction a pass.
//
// A tap counts by its distance in pixels (Gaussian), by how far it lies from the plane through
// the centre, and by how far its normal turns away. The plane distance keeps the blur whole
// on floors seen at a grazing angle, where plain depth differences would cut it to pieces.
//!use frame
//!use fullscreen
//!use normals
struct Blur {
    direction: vec2i,
    radius_px: i32,
    plane_m: f32,
}

@group(0) @binding(1) var depth_texture: texture_2d<f32>;
@group(0) @binding(3) var occlusion_texture: texture_2d<f32>;
@group(0) @binding(4) var<uniform> blur: Blur;

@fragment
fn fs_blur(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let centre = vec2i(position.xy);
    let centre_value = textureLoad(occlusion_texture, centre, 0);
    let centre_depth_m = textureLoad(depth_texture, occlusion_texel(centre), 0).x;
    if centre_depth_m >= frame.far_m {
        return centre_value;
    }
    let centre_m = view_position(vec2f(centre) + occlusion_sample(), centre_depth_m);
    let world = world_normal(occlusion_texel(centre));
    let normal = (frame.view * vec4f(world, 0.0)).xyz;
    // Two standard deviations reach the last tap.
    let falloff = 2.0 / f32(blur.radius_px * blur.radius_px);
    var sum = centre_value;
    var total = 1.0;
    for (var step = -blur.radius_px; step <= blur.radius_px; step++) {
        let tap = centre + blur.direction * step;
        if step == 0 || !is_inside(tap) {
            continue;
        }
        let texel = occlusion_texel(tap);
        let depth_m = textureLoad(depth_texture, texel, 0).x;
        let tap_m = view_position(vec2f(tap) + occlusion_sample(), depth_m);
        let off_plane = dot(tap_m - centre_m, normal) / blur.plane_m;
        let turned = max(dot(world, world_normal(texel)), 0.0);
        let weight = exp(-f32(step * step) * falloff - off_plane * off_plane) * turned * turned;
        sum += weight * textureLoad(occlusion_texture, tap, 0);
        total += weight;
    }
    return sum / total;
}
