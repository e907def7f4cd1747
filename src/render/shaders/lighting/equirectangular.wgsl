// Where a unit direction lies in the environment's map: the middle is -Z, its right half +X, rows
// run from up to down.
//!use light
@group(0) @binding(13) var environment_sampler: sampler;

fn environment_uv(towards: vec3f) -> vec2f {
    let horizontal = length(towards.xz);
    // At a pole the azimuth means nothing, but it must be a number.
    let ahead = select(-towards.z, 1.0, horizontal < 1e-7);
    let u = 0.5 + atan2(towards.x, ahead) / 6.2831853;
    return vec2f(u + light.environment_turn, atan2(horizontal, towards.y) / 3.14159265);
}
