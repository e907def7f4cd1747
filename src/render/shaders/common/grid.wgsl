// Corners on the grid that every adapter can rasterise on.
//!use frame

// Adapters round a corner's place to 1/16 of a pixel (all that Vulkan asks for,
// subPixelPrecisionBits ≥ 4) or finer, each its own way; edges then fall on different pixels.
// Corners that are on the coarsest grid already stay where they are on all of them.
fn on_grid(clip: vec4f) -> vec4f {
    if clip.w < frame.near_m {
        // Behind the eye: what is left of the triangle is cut off by the near plane.
        return clip;
    }
    let grid = frame.size_px * 8.0;
    // A hair past the step, for adapters that cut off instead of rounding.
    let steps = round(clip.xy / clip.w * grid) + 1.0 / 64.0;
    return vec4f(steps / grid * clip.w, clip.zw);
}
