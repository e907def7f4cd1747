// Two numbers in [0, 1) a pixel, well spread over every patch of pixels: the R2 sequence (Roberts
// 2018) along a Hilbert curve that fills squares of 64 x 64 pixels. Whole-number arithmetic, so
// that every adapter draws the same.

fn hilbert_index(pixel: vec2i) -> u32 {
    var cell = vec2u(pixel) & vec2u(63u);
    var index = 0u;
    for (var level = 6u; level > 0u; level--) {
        let quarter = (cell >> vec2u(level - 1u)) & vec2u(1u);
        index = 4u * index + ((3u * quarter.x) ^ quarter.y);
        if quarter.y == 0u {
            cell = select(cell, 63u - cell, quarter.x == 1u).yx;
        }
    }
    return index;
}

// kernel[0].xy is the seed's own shift.
fn spatial_noise(pixel: vec2i) -> vec2f {
    // 2^32 over the plastic number and its square.
    let steps = hilbert_index(pixel) * vec2u(3242174889u, 2447445414u);
    return fract(vec2f(steps >> vec2u(8u)) / 16777216.0 + kernel[0].xy);
}
