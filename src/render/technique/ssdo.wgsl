// Ritschel, Grosch & Seidel 2009: points at random distances over the normal's hemisphere. A point that is hidden
// by what the picture shows there closes its direction: the ambient light from there is lost, and
// what hides it sends a bounce of its own light instead.
//
// Directions are spread by the cosine to the normal, where the paper spreads them evenly and weighs them by
// the cosine: each stands for the same share. What is stored is the change of the ambient light, so
// that where nothing is hidden the shading has no noise at all.
//!use directional
//!use opening
//!use spatial_noise
//!use light
//!use diffuse
//!use irradiance
//!use sun_visibility

// How many radii away a surface may be seen that hides a sample.
const SIGHT: f32 = 4.0;

// Ambient radiance from a direction: constant, or what the irradiance's coefficients were before the
// cosine was folded into them.
fn ambient_from(direction: vec3f) -> vec3f {
    return light.constant_ambient.rgb + harmonics(direction, vec3f(0.31830989, 0.47746483, 1.2732395));
}

struct Hider {
    // What sends light instead: from the point to it, metres, and its texel.
    away_m: vec3f,
    normal: vec3f,
    texel: vec2i,
    hides: bool,
}

// Whether what the picture shows where a sample lies hides it: whether that rises above the sample, both
// measured from the point's own tangent plane. A sample and what is seen at its pixel differ by up
// to half a pixel along the surface; heights do not mind, and a plane never hides itself.
//
// What stands far in front hides the pixel by chance, unless the way to the sample passes through the very
// surface that is seen: a floor at a grazing angle is seen far from where the way enters it.
fn hider_of(ray_m: vec3f, centre_m: vec3f, normal: vec3f) -> Hider {
    var hider: Hider;
    let sample_m = centre_m + ray_m;
    if -sample_m.z < frame.near_m {
        return hider;
    }
    let tap = nearest_pixel(project_px(sample_m));
    let depth_m = depth_at(tap);
    if !is_inside(tap) || depth_m >= frame.far_m {
        return hider;
    }
    let seen_m = view_position(sample_px(tap), depth_m);
    hider.away_m = seen_m - centre_m;
    hider.texel = occlusion_texel(tap);
    hider.normal = view_normal(tap);
    // Seen from below the plane, higher is farther: there depth decides.
    let is_above = dot(seen_m, normal) < 0.0;
    let rises = dot(hider.away_m, normal) > dot(ray_m, normal);
    if !select(depth_m < -sample_m.z, rises, is_above) {
        return hider;
    }
    let distance_m = length(hider.away_m);
    hider.hides = distance_m <= params.radius_m;
    // Heights of the point and of the sample above the plane of what is seen.
    let here_m = -dot(hider.away_m, hider.normal);
    let there_m = here_m + dot(ray_m, hider.normal);
    if here_m > 0.0 && there_m < 0.0 && distance_m <= SIGHT * params.radius_m {
        hider.away_m = ray_m * (here_m / (here_m - there_m));
        hider.hides = true;
    }
    return hider;
}

// Share of the light that a hider sends which arrives, in units of a sample's own: the paper's form factor of
// a disc, one of as many as there are samples that fill the hemisphere's base. A sample's share of the
// light is all that it can send.
fn arriving(hider: Hider, normal: vec3f) -> f32 {
    let distance_2 = max(dot(hider.away_m, hider.away_m), 1e-12);
    let direction = hider.away_m * inverseSqrt(distance_2);
    let cosines = max(dot(direction, normal), 0.0) * max(-dot(direction, hider.normal), 0.0);
    return min(params.radius_m * params.radius_m * cosines / distance_2, 1.0);
}

// What of the sun's light a surface sends on.
fn sunlit(point: Point) -> vec3f {
    let cosine = max(dot(point.normal, light.sun_towards.xyz), 0.0);
    return light.sun_irradiance.rgb * (cosine * sun_visibility(point.texel) / 3.14159265);
}

fn directional(pixel: vec2i, depth_m: f32) -> Directional {
    let centre_m = view_position(sample_px(pixel), depth_m);
    let normal = view_normal(pixel);
    let across = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 0.0, 1.0), abs(normal.x) > 0.7);
    let right = normalize(across - normal * dot(across, normal));
    let up = cross(normal, right);
    let noise = spatial_noise(pixel);
    var closed = 0.0;
    var closed_towards = vec3f(0.0);
    var lost = vec3f(0.0);
    var ambient_bounce = vec3f(0.0);
    var sun_bounce = vec3f(0.0);
    for (var i = 0.0; i < params.samples; i += 1.0) {
        // Malley's method on a spiral; lengths by another irrational step.
        let share = (i + 0.5) / params.samples;
        let angle = 6.2831853 * noise.x + 2.3999632 * i;
        let direction = sqrt(share) * (cos(angle) * right + sin(angle) * up) + sqrt(1.0 - share) * normal;
        let reach_m = params.radius_m * max(fract(noise.y + 0.7548777 * i), 0.05);
        let hider = hider_of(direction * reach_m, centre_m, normal);
        if !hider.hides {
            continue;
        }
        closed += 1.0;
        closed_towards += direction;
        lost += ambient_from((frame.inverse_view * vec4f(direction, 0.0)).xyz);
        let sender = point_at(hider.texel);
        let sent = diffuse_albedo(sender) * arriving(hider, normal);
        ambient_bounce += sent * uncovered_ambient(sender.normal);
        sun_bounce += sent * sunlit(sender);
    }
    var result: Directional;
    result.accessibility = 1.0 - closed / params.samples;
    result.closed = closed_towards / params.samples;
    // A sender of ambient light is taken to be as open as the point it sends to.
    let bounce = params.bounce * (ambient_bounce * result.accessibility + sun_bounce);
    result.change = (bounce - lost) / params.samples;
    return result;
}

fn opening(pixel: vec2i, depth_m: f32) -> Opening {
    let found = directional(pixel, depth_m);
    return Opening(found.accessibility, (frame.inverse_view * vec4f(found.closed, 0.0)).xyz);
}
