// Below the cutoff there is no surface.
fn mask(alpha: f32) {
    if alpha < material.alpha_cutoff {
        discard;
    }
}
