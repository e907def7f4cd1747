//! A texture's halvings.

use crate::scene::{Texture, TextureEncoding, srgb};

/// The texture and its halvings down to one pixel; colours are averaged as light, not as
/// sRGB numbers.
pub(super) fn mip_chain(texture: &Texture) -> Vec<Vec<u8>> {
    let decode: Vec<f32> = (0..=255_u8)
        .map(|byte| match texture.encoding {
            TextureEncoding::Linear => f32::from(byte) / 255.0,
            TextureEncoding::Srgb => srgb::decode(f32::from(byte) / 255.0),
        })
        .collect();
    let encode = |value: f32| match texture.encoding {
        TextureEncoding::Linear => (value * 255.0).round() as u8,
        TextureEncoding::Srgb => (srgb::encode(value) * 255.0).round() as u8,
    };
    let (mut width, mut height) = (texture.width_px as usize, texture.height_px as usize);
    let mut level: Vec<[f32; 4]> = texture
        .rgba8
        .chunks_exact(4)
        .map(|p| {
            let [r, g, b] = [p[0], p[1], p[2]].map(|byte| decode[byte as usize]);
            [r, g, b, f32::from(p[3]) / 255.0]
        })
        .collect();
    let mut levels = vec![texture.rgba8.clone()];
    while width > 1 || height > 1 {
        let (next_width, next_height) = ((width / 2).max(1), (height / 2).max(1));
        level = halve(&level, (width, height), (next_width, next_height));
        (width, height) = (next_width, next_height);
        levels.push(
            level
                .iter()
                .flat_map(|p| {
                    [
                        encode(p[0]),
                        encode(p[1]),
                        encode(p[2]),
                        (p[3] * 255.0).round() as u8,
                    ]
                })
                .collect(),
        );
    }
    levels
}

fn halve(
    level: &[[f32; 4]],
    (width, height): (usize, usize),
    (next_width, next_height): (usize, usize),
) -> Vec<[f32; 4]> {
    let at = |x: usize, y: usize| level[y.min(height - 1) * width + x.min(width - 1)];
    let mut halved = Vec::with_capacity(next_width * next_height);
    for y in 0..next_height {
        for x in 0..next_width {
            let texels = [
                at(2 * x, 2 * y),
                at(2 * x + 1, 2 * y),
                at(2 * x, 2 * y + 1),
                at(2 * x + 1, 2 * y + 1),
            ];
            halved.push(std::array::from_fn(|c| {
                texels.iter().map(|t| t[c]).sum::<f32>() / 4.0
            }));
        }
    }
    halved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Wrap;

    #[test]
    fn mips_average_light_not_numbers() {
        let texture = Texture {
            name: String::from("checks"),
            width_px: 2,
            height_px: 2,
            rgba8: [[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]].concat(),
            encoding: TextureEncoding::Srgb,
            wrap: [Wrap::Repeat; 2],
        };
        let levels = mip_chain(&texture);
        assert_eq!(levels.len(), 2);
        // Half the light of white is sRGB 188 (0.7354 · 255 = 187.5).
        assert!(
            (i16::from(levels[1][0]) - 188).abs() <= 1,
            "{}",
            levels[1][0]
        );
        let linear = mip_chain(&Texture {
            encoding: TextureEncoding::Linear,
            ..texture
        });
        assert!((i16::from(linear[1][0]) - 128).abs() <= 1);
    }

    #[test]
    fn odd_sizes_end_at_one_pixel() {
        let texture = Texture {
            name: String::from("odd"),
            width_px: 5,
            height_px: 3,
            rgba8: vec![200; 60],
            encoding: TextureEncoding::Linear,
            wrap: [Wrap::Repeat; 2],
        };
        let sizes: Vec<usize> = mip_chain(&texture).iter().map(Vec::len).collect();
        assert_eq!(sizes, [60, 8, 4]);
        assert!(
            mip_chain(&texture)
                .iter()
                .flatten()
                .all(|&byte| byte == 200)
        );
    }
}
