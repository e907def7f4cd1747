// How much of the sun's disc a point sees: percentage-closer soft shadows (Fernando 2005).
//
// The texels about the point say how far away what shades it is; a disc-shaped sun makes an edge
// that far away as wide as the filter then is. No shadow is sharper than a texel and a half.
//
// A depth in the map is compared not with the point's depth but with that of the plane through the
// point at the texel's own centre: a slope then needs no bias, however grazing the light and
// wide the filter. What is left of a bias is a part of a texel along the normal, for surfaces that
// are not quite the plane that their normal says.
//!use fullscreen
//!use light
//!use place
//!use normals
@group(0) @binding(8) var shadow_texture: texture_depth_2d;
@group(0) @binding(9) var shadow_sampler: sampler;

const SEARCHES: i32 = 16;
const TAPS: i32 = 24;

struct Receiver {
    uv: vec2f,
    depth: f32,
    // Depth of the point's plane a unit of uv.
    slope: vec2f,
}

fn receiver_of(world_m: vec3f, normal: vec3f) -> Receiver {
    // At 3 degrees of grazing light, where the slope is cut off, a surface gets a twentieth.
    let cosine = max(dot(normal, light.sun_towards.xyz), 0.05);
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let moved = world_m + normal * (light.shadow_depth.y * (0.4 + 0.6 * sine));
    let clip = light.shadow_from_world * vec4f(moved, 1.0);
    let tilt = vec2f(dot(normal, light.shadow_right.xyz), dot(normal, light.shadow_up.xyz)) / cosine;
    var receiver: Receiver;
    receiver.uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
    receiver.depth = clip.z;
    receiver.slope = tilt * light.shadow_depth.x / vec2f(light.shadow_right.w, -light.shadow_up.w);
    return receiver;
}

// Point `index` of `count` spread evenly over the unit disc (Vogel 1979).
fn on_disc(index: i32, count: i32, turn: f32) -> vec2f {
    let angle = 2.3999632 * f32(index) + turn;
    return sqrt((f32(index) + 0.5) / f32(count)) * vec2f(cos(angle), sin(angle));
}

struct Texels {
    // How far in front of the point's plane each of the four lies, as depth; below 0 it does not.
    in_front: vec4f,
    // How much each counts at the place between them.
    weights: vec4f,
}

fn texels_at(receiver: Receiver, uv: vec2f) -> Texels {
    let size = light.shadow_depth.w;
    let corner = floor(uv * size - 0.5);
    let part = uv * size - 0.5 - corner;
    // In the order of a gather: lower left, lower right, upper right, upper left.
    let stored = textureGather(shadow_texture, shadow_sampler, (corner + 1.0) / size);
    let upper_left = receiver.depth + dot((corner + 0.5) / size - receiver.uv, receiver.slope);
    let stride = receiver.slope / size;
    let plane = upper_left + vec4f(stride.y, stride.x + stride.y, stride.x, 0.0);
    let x = vec4f(1.0 - part.x, part.x, part.x, 1.0 - part.x);
    let y = vec4f(part.y, part.y, 1.0 - part.y, 1.0 - part.y);
    return Texels(plane - stored, x * y);
}

// A turn of the disc for each texel, so that few taps make grain and not rings (interleaved
// gradient noise, Jimenez 2014); supersampling averages the grain.
fn turn_at(texel: vec2i) -> f32 {
    return 6.2831853 * fract(52.9829189 * fract(dot(vec2f(texel), vec2f(0.06711056, 0.00583715))));
}

fn visibility(texel: vec2i, world_m: vec3f, normal: vec3f) -> f32 {
    let receiver = receiver_of(world_m, normal);
    if any(receiver.uv < vec2f(0.0)) || any(receiver.uv > vec2f(1.0)) {
        return 1.0;
    }
    let uv_per_m = vec2f(light.shadow_right.w, light.shadow_up.w);
    let depth_per_m = light.shadow_depth.x;
    let narrowest_m = 1.5 * light.shadow_depth.y;
    let turn = turn_at(texel);
    // Nothing that shades the point is farther from it than the map's near side.
    let widest_m = clamp(light.shadow_depth.z * receiver.depth / depth_per_m, narrowest_m, 20.0 * narrowest_m);
    var in_front = 0.0;
    var found = 0.0;
    for (var i = 0; i < SEARCHES; i++) {
        let at = receiver.uv + on_disc(i, SEARCHES, turn) * widest_m * uv_per_m;
        let texels = texels_at(receiver, at);
        let shades = step(vec4f(1e-7), texels.in_front);
        in_front += dot(shades, texels.in_front);
        found += dot(shades, vec4f(1.0));
    }
    if found == 0.0 {
        return 1.0;
    }
    if found == 4.0 * f32(SEARCHES) {
        return 0.0;
    }
    let apart_m = in_front / found / depth_per_m;
    let radius_m = clamp(light.shadow_depth.z * apart_m, narrowest_m, widest_m);
    var lit = 0.0;
    for (var i = 0; i < TAPS; i++) {
        let at = receiver.uv + on_disc(i, TAPS, turn) * radius_m * uv_per_m;
        let texels = texels_at(receiver, at);
        lit += 1.0 - dot(step(vec4f(1e-7), texels.in_front), texels.weights);
    }
    return lit / f32(TAPS);
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
    return vec4f(visibility(texel, frame.eye_m + world_ray(texel) * depth_m, normal));
}
