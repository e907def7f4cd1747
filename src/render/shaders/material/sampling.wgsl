// Textures filtered by the same rule on every adapter.
//
// How an adapter picks the level of detail, and how it filters anisotropically, is its own affair;
// two of them differ by several levels in a tenth of a brick wall's pixels. Here both follow from
// the footprint of the sample in the texture: four taps along its longer side, each filtered
// trilinearly at the level where a tap is as wide as the shorter side, or a quarter of the longer.

const TAPS: f32 = 4.0;

fn sample_map(map: texture_2d<f32>, map_sampler: sampler, uv: vec2f) -> vec4f {
    let size = vec2f(textureDimensions(map));
    let across = dpdxFine(uv);
    let along = dpdyFine(uv);
    let across_texels = length(across * size);
    let along_texels = length(along * size);
    let longer = max(across_texels, along_texels);
    let tap_texels = max(min(across_texels, along_texels), longer / TAPS);
    let level = log2(max(tap_texels, 1.0));
    let step = select(along, across, across_texels > along_texels) / TAPS;
    var sum = vec4f(0.0);
    for (var tap = 0.5 - 0.5 * TAPS; tap < 0.5 * TAPS; tap += 1.0) {
        sum += textureSampleLevel(map, map_sampler, uv + step * tap, level);
    }
    return sum / TAPS;
}
