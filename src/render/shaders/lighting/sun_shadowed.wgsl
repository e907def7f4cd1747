// Shadow map with percentage-closer filtering (Reeves et al. 1987) over 5 x 5 bilinear taps.
//
// The point is moved along the triangle's normal by the width of the filter times the sine of
// the light's angle: the least that keeps a slope from shadowing itself, and next to nothing
// on a surface that faces the light, so that contacts stay closed.
@group(0) @binding(8) var shadow_texture: texture_depth_2d;
@group(0) @binding(9) var shadow_sampler: sampler_comparison;

fn sun_visibility(point: Point) -> f32 {
    let cosine = dot(point.geometric_normal, light.sun_towards.xyz);
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let moved = point.world_m + point.geometric_normal * (light.shadow_texel.x * (0.5 + 2.5 * sine));
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
