// The environment's light through a bent cone: reference/bent_cone.rs has the derivation, and tests hold
// both to the same numbers.
//!use irradiance

// Irradiance through what is open: its share, and the mean of all directions by the cosine, the closed
// ones counted as nought.
fn irradiance_within(share: f32, moment: vec3f) -> vec3f {
    let whole = max(share, 1e-6);
    let length = min(sqrt(dot(moment, moment)), share);
    let direction = moment / max(sqrt(dot(moment, moment)), 1e-20);
    // 1 for an open hemisphere, 1.5 for a line.
    let sharpness = 1.5 * length / whole;
    let beyond = max(sharpness - 1.0, 0.0);
    // Cosine of the half-angle of the cone whose mean is as long.
    let cosine = 0.5 * (beyond + sqrt(beyond * (beyond + 4.0)));
    let fourfold_p2 = (1.0 + 3.0 * cosine * cosine) * min(sharpness * sharpness, 1.0);
    return max(harmonics(direction, vec3f(share, 1.5 * length, share * fourfold_p2)), vec3f(0.0));
}
