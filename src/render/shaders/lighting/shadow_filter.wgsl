// How much of the directional light reaches a point: percentage-closer filtering (Reeves et
// al. 1987) of the shadow map over 5 x 5 bilinear taps.
//
// The point is moved along the triangle's normal by the width of the filter times the sine of
// the light's angle: the least that keeps a slope from shadowing itself, and next to nothing
// on a surface that faces the light, so that contacts stay closed.
//!use fullscreen
//!use light
//!use place
//!use normals
@group(0) @binding(8) var shadow_texture: texture_depth_2d;
@group(0) @binding(9) var shadow_sampler: sampler_comparison;

fn visibility(world_m: vec3f, normal: vec3f) -> f32 {
    let cosine = dot(normal, light.sun_towards.xyz);
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let moved = world_m + normal * (light.shadow_texel.x * (0.5 + 2.5 * sine));
    let clip = light.shadow_from_world * vec4f(moved, 1.0);
    let uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
    if any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) || clip.z > 1.0 {
        return 1.0;
    }
    var lit = 0.0;
    for (var y = -2; y <= 2; y++) {
        for (var x = -2; x <= 2; x++) {
            let tap = uv + vec2f(f32(x), f32(y)) * light.shadow_texel.y;
            lit += textureSampleCompareLevel(shadow_texture, shadow_sampler, tap, clip.z - light.shadow_texel.z);
        }
    }
    return lit / 25.0;
}

@fragment
fn fs_visibility(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        return vec4f(1.0);
    }
    let normal = geometric_normal(texel);
    // A point that faces away is dark whatever the map says.
    if dot(normal, light.sun_towards.xyz) <= 0.0 {
        return vec4f(0.0);
    }
    let depth_m = textureLoad(depth_texture, texel, 0).x;
    return vec4f(visibility(frame.eye_m + world_ray(texel) * depth_m, normal));
}
