// The directional light.
//!use fullscreen
//!use light
//!use brdf
//!use sun_visibility

@fragment
fn fs_light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2i(position.xy);
    if !has_surface(texel) {
        discard;
    }
    let lit = lit_by(point_at(texel), light.sun_towards.xyz, light.sun_irradiance.rgb);
    return vec4f(lit * sun_visibility(texel), 0.0);
}
