fn mask(alpha: f32) {
}
