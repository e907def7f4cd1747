// k_A of the point, from the occlusion target, whose pixels may be larger than those shaded
// here. The four nearest count by their bilinear weight and by how well they lie on the point's
// own plane, so that an edge keeps its own side's occlusion.
//!use light
//!use point
@group(0) @binding(5) var occlusion_texture: texture_2d<f32>;

fn computed_occlusion(point: Point) -> f32 {
    let normal = (frame.view * vec4f(point.geometric_normal, 0.0)).xyz;
    let at = (vec2f(point.texel) + 0.5) / f32(frame.samples) - occlusion_sample();
    let corner = vec2i(floor(at));
    let part = at - floor(at);
    let last = vec2i(frame.image_px) - 1;
    // A plane distance of a twentieth of a per cent of the depth is what two pixels of one
    // curved surface may differ by.
    let plane_scale = 1.0 / (0.002 * max(-point.view_m.z, 1e-4));
    var sum = 0.0;
    var total = 0.0;
    for (var i = 0; i < 4; i++) {
        let step = vec2i(i & 1, i >> 1);
        let pixel = clamp(corner + step, vec2i(0), last);
        let bilinear = mix(1.0 - part, part, vec2f(step));
        let texel = occlusion_texel(pixel);
        let tap_m = view_ray(texel) * textureLoad(depth_texture, texel, 0).x;
        let off_plane = abs(dot(tap_m - point.view_m, normal)) * plane_scale;
        // The small constants keep a defined answer where no tap lies on the plane.
        let weight = (bilinear.x * bilinear.y + 1e-3) / (1e-3 + off_plane * off_plane);
        sum += weight * textureLoad(occlusion_texture, pixel, 0).x;
        total += weight;
    }
    return 1.0 + light.occlusion_weight * (sum / total - 1.0);
}
