// What a surface point has of a target of occlusion whose pixels may be larger than those shaded here:
// `stride` texels of the surfaces a side. The four nearest count by their bilinear weight and by
// how well they lie on the point's own plane, so that an edge keeps its own side's occlusion.
//!use place

fn gathered(
    target_texture: texture_2d<f32>, texel: vec2i, view_m: vec3f, normal: vec3f, stride: i32, last: vec2i,
) -> vec4f {
    let size = f32(stride);
    let at = (vec2f(texel) - f32(stride / 2)) / size;
    let corner = vec2i(floor(at));
    let part = at - floor(at);
    // A plane distance of a twentieth of a per cent of the depth is what two pixels of one
    // curved surface may differ by.
    let plane_scale = 1.0 / (0.002 * max(-view_m.z, 1e-4));
    var sum = vec4f(0.0);
    var total = 0.0;
    for (var i = 0; i < 4; i++) {
        let step = vec2i(i & 1, i >> 1);
        let pixel = clamp(corner + step, vec2i(0), last);
        let bilinear = mix(1.0 - part, part, vec2f(step));
        let tap = pixel * stride + stride / 2;
        let tap_m = view_ray(tap) * textureLoad(depth_texture, tap, 0).x;
        let off_plane = abs(dot(tap_m - view_m, normal)) * plane_scale;
        // The small constants keep a defined answer where no tap lies on the plane.
        let weight = (bilinear.x * bilinear.y + 1e-3) / (1e-3 + off_plane * off_plane);
        sum += weight * textureLoad(target_texture, pixel, 0);
        total += weight;
    }
    return sum / total;
}
