// Shanmugam & Arikan 2007: every occluder is a sphere. Near ones are the pixels round about, each as large as
// what it shows; far ones are fitted to the whole scene, whether it is seen or not. One window divides
// the distances between the bands, so that nothing counts in both.
//
// The paper's occlusion by a sphere is its solid angle times the cosine to its centre. Here stands the
// integral itself, sin(a)^2 cos: the same for a small half angle a, and exact for any sphere above
// the tangent plane.
//!use occlusion
//!use spatial_noise
//!use proxies

// A surface point's two normals. A bump of the shading normal must not see the plane it is painted on.
struct Facing {
    shading: vec3f,
    geometric: vec3f,
}

// The cosine-weighted share of the hemisphere that a sphere hides. Within the sphere it falls to nothing
// at the centre, so that the answer stays finite and has no jump.
fn hidden_by(facing: Facing, offset_m: vec3f, radius_m: f32) -> f32 {
    let distance_m = max(max(length(offset_m), radius_m), 1e-6);
    let direction = offset_m / distance_m;
    let height = min(dot(direction, facing.shading), dot(direction, facing.geometric));
    let cosine = max(height - params.bias, 0.0) / max(1.0 - params.bias, 1e-6);
    let sine = radius_m / distance_m;
    return sine * sine * cosine;
}

// 1 up to half a distance, 0 from the whole of it on.
fn window(distance_m: f32, end_m: f32) -> f32 {
    let part = clamp(2.0 - 2.0 * distance_m / max(end_m, 1e-6), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

// Spheres of the pixels round about. Samples lie on a spiral whose radii grow by equal factors, from one
// pixel to all within reach: as the share that a sphere hides falls with the square of its distance,
// each sample then stands for about as much.
fn hidden_near(pixel: vec2i, depth_m: f32, facing: Facing) -> f32 {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let noise = spatial_noise(pixel);
    let px_per_m = 0.5 * frame.size_px.y / (frame.half_extent.y * depth_m);
    let reach_px = min(px_per_m * params.radius_m, length(frame.size_px));
    if !(reach_px > 1.0) {
        return 0.0;
    }
    var hidden = 0.0;
    for (var i = 0.0; i < params.samples; i += 1.0) {
        let from_px = pow(reach_px, (i + noise.x) / params.samples);
        let angle = 6.2831853 * noise.y + 2.3999632 * i;
        let tap = nearest_pixel(sample_px(pixel) + from_px * vec2f(cos(angle), sin(angle)));
        if !is_inside(tap) || all(tap == pixel) {
            continue;
        }
        let tap_depth_m = depth_at(tap);
        if tap_depth_m >= frame.far_m {
            continue;
        }
        let offset_m = view_position(sample_px(tap), tap_depth_m) - centre_m;
        // A sphere as large as its pixel, and how many pixels it stands for.
        let radius_m = 2.0 * frame.half_extent.y * tap_depth_m / frame.size_px.y / sqrt(3.14159265);
        let pixels = 6.2831853 * from_px * from_px * log(reach_px) / params.samples;
        hidden += pixels * window(length(offset_m), params.radius_m) * hidden_by(facing, offset_m, radius_m);
    }
    return hidden;
}

fn accessibility(pixel: vec2i, depth_m: f32) -> f32 {
    let texel = occlusion_texel(pixel);
    let facing = Facing(view_normal(pixel), (frame.view * vec4f(geometric_normal(texel), 0.0)).xyz);
    var hidden = hidden_near(pixel, depth_m, facing);
    var open = 1.0 - min(hidden, 1.0);
    let world = Facing(world_normal(texel), geometric_normal(texel));
    let centre_m = (frame.inverse_view * vec4f(view_position(sample_px(pixel), depth_m), 1.0)).xyz;
    for (var i = 0u; i < arrayLength(&proxy_spheres); i++) {
        let offset_m = proxy_spheres[i].xyz - centre_m;
        let distance_m = length(offset_m);
        let counts = window(distance_m, params.reach_m) * (1.0 - window(distance_m, params.radius_m));
        let share = counts * hidden_by(world, offset_m, proxy_spheres[i].w);
        hidden += share;
        open *= 1.0 - share;
    }
    return select(open, 1.0 - hidden, params.overlap > 0.5);
}
