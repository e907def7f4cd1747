// The directional light: Lambert plus GGX (Walter et al. 2007) with Smith's height-correlated
// masking in Heitz 2014's form and Schlick's Fresnel term.
//!use light
//!use sun_visibility

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

fn sun_radiance(point: Point) -> vec3f {
    let to_light = light.sun_towards.xyz;
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
    let f0 = mix(vec3f(point.specular), point.albedo, point.metallic);
    let diffuse = point.albedo * (1.0 - point.metallic) / 3.14159265;
    let specular = ggx_specular(f0, point.roughness, n_dot_h, n_dot_v, n_dot_l, v_dot_h);
    return sun_visibility(point) * (diffuse + specular) * light.sun_irradiance.rgb * n_dot_l;
}
