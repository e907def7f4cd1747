// How a surface answers light from one direction: Lambert plus GGX (Walter et al. 2007) with
// Smith's height-correlated masking in Heitz 2014's form and Schlick's Fresnel term.
//!use point

fn reflectance_at_normal(point: Point) -> vec3f {
    return mix(vec3f(point.specular), point.albedo, point.metallic);
}

fn ggx_specular(f0: vec3f, roughness: f32, n_dot_h: f32, n_dot_v: f32, n_dot_l: f32, v_dot_h: f32) -> vec3f {
    // Below 0.05 the lobe is narrower than a pixel and only aliases.
    let alpha = max(roughness, 0.05) * max(roughness, 0.05);
    let alpha2 = alpha * alpha;
    let lobe = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;
    let distribution = alpha2 / (3.14159265 * lobe * lobe);
    let masking_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2);
    let masking_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2);
    let fresnel = f0 + (1.0 - f0) * pow(1.0 - v_dot_h, 5.0);
    return fresnel * distribution * (0.5 / max(masking_v + masking_l, 1e-6));
}

// Radiance towards the eye of a light that gives `irradiance` to a surface facing it.
fn lit_by(point: Point, to_light: vec3f, irradiance: vec3f) -> vec3f {
    let n_dot_l = dot(point.normal, to_light);
    // The triangle's own normal decides what the light can reach: a normal map must not light
    // a wall from behind.
    if n_dot_l <= 0.0 || dot(point.geometric_normal, to_light) <= 0.0 {
        return vec3f(0.0);
    }
    let half_way = normalize(to_light + point.to_eye);
    let n_dot_v = max(dot(point.normal, point.to_eye), 1e-3);
    let n_dot_h = clamp(dot(point.normal, half_way), 0.0, 1.0);
    let v_dot_h = clamp(dot(point.to_eye, half_way), 0.0, 1.0);
    let diffuse = point.albedo * (1.0 - point.metallic) / 3.14159265;
    let specular = ggx_specular(
        reflectance_at_normal(point), point.roughness, n_dot_h, n_dot_v, n_dot_l, v_dot_h);
    return (diffuse + specular) * irradiance * n_dot_l;
}
