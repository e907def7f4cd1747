// Mittring 2007; Kajalin 2009 (ShaderX7); thesis 4.3.1 and appendix A.
//
// Depth alone. The eight corners of a cube, once or more, each sample farther out than the
// last, turned by a rotation that is tiled over the picture. Three artefacts belong to the technique
// and stay: bright edges, far things that darken what is behind them, and grey flat walls.
//!use occlusion

fn rotate(quaternion: vec4f, v: vec3f) -> vec3f {
    let t = 2.0 * cross(quaternion.xyz, v);
    return v + quaternion.w * t + cross(quaternion.xyz, t);
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let uv = sample_px(pixel) / frame.size_px;
    let rotation = kernel[tile_index(pixel)];
    let growth = 1.0 + 2.4 / params.samples;
    var reach = params.radius_uv;
    var sum = 0.0;
    for (var i = 0u; i < u32(params.samples); i++) {
        reach *= growth;
        let corner = vec3f(vec3u(i >> 2u, i >> 1u, i) & vec3u(1u)) * 2.0 - 1.0;
        let offset = rotate(rotation, normalize(corner)) * reach;
        // The listing's offsets are fractions of the picture across, and of the depth along.
        let sample_depth_m = depth_m + offset.z * depth_m;
        let surface_m = depth_at(nearest_pixel((uv + offset.xy) * frame.size_px));
        if surface_m >= frame.far_m {
            sum += 1.0;
        } else {
            // On the scale of the whole depth range, as in the listing: next to never out of
            // range, which is why far things occlude.
            let out_of_range = clamp((depth_m - surface_m) / frame.far_m, 0.0, 1.0);
            sum += mix(select(0.0, 1.0, surface_m > sample_depth_m), 0.5, out_of_range);
        }
    }
    let mean = sum / params.samples;
    return mean * mean + mean;
}
