//! Textures painted by formula: a recipe says what a point of a surface is like, and
//! albedo, normal map and roughness follow from the same heights.

pub mod cloth;
pub mod masonry;
pub mod plain;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::geometry::{Geometry, Material, Texture, TextureEncoding, Wrap};
use super::srgb::decode as decode_srgb;

/// What a surface is like at one point.
#[derive(Debug, Clone, Copy)]
pub struct Texel {
    /// Linear diffuse colour.
    pub albedo: Vec3,
    /// Height above the mean surface, metres.
    pub height_m: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
}

/// How to paint a material's textures.
pub struct Recipe {
    /// What it shows.
    pub name: &'static str,
    /// Columns and rows.
    pub size_px: u32,
    /// Metres that one repeat covers.
    pub tile_m: f32,
    /// The surface at (u, v) in [0, 1)², v downwards; must repeat.
    pub texel: Box<dyn Fn(Vec2) -> Texel + Send + Sync>,
}

/// A material in a [`Geometry`], and the size of its pattern.
#[derive(Debug, Clone, Copy)]
pub struct Finish {
    /// Index into [`Geometry::materials`].
    pub material: usize,
    /// Metres that one repeat of its textures covers.
    pub tile_m: f32,
}

/// The linear colour of an sRGB `0xRRGGBB`.
#[must_use]
pub fn srgb(hex: u32) -> Vec3 {
    let channel = |shift: u32| decode_srgb((hex >> shift & 0xff) as f32 / 255.0);
    Vec3::new(channel(16), channel(8), channel(0))
}

/// Encodes linear values in 8 bits with the sRGB transfer function, by the linear
/// values half way between two codes: 8 comparisons instead of a power.
struct SrgbEncoder {
    thresholds: [f32; 255],
}

impl SrgbEncoder {
    fn new() -> Self {
        let halfway = |code: usize| decode_srgb((code as f32 + 0.5) / 255.0);
        Self {
            thresholds: std::array::from_fn(halfway),
        }
    }

    fn encode(&self, linear: f32) -> u8 {
        let code = self.thresholds.partition_point(|&t| t <= linear);
        u8::try_from(code).unwrap_or(u8::MAX)
    }
}

fn to_byte(x: f32) -> u8 {
    // Saturating: `as` clamps to 0..=255.
    (x * 255.0 + 0.5) as u8
}

impl Recipe {
    /// The texels, row by row from the top.
    fn texels(&self) -> Vec<Texel> {
        let n = self.size_px;
        (0..n * n)
            .into_par_iter()
            .with_min_len(4096)
            .map(|i| {
                let uv = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                (self.texel)(uv)
            })
            .collect()
    }

    /// Paints albedo, normal map and roughness (green), in this order.
    #[must_use]
    pub fn paint(&self) -> [Texture; 3] {
        let texels = self.texels();
        let n = self.size_px as usize;
        let height = |x: usize, y: usize| texels[y % n * n + x % n].height_m;
        let two_texels_m = 2.0 * self.tile_m / n as f32;
        let image = |what: &str, encoding, pixel: &(dyn Fn(usize) -> [u8; 4] + Sync)| Texture {
            name: format!("{} {what}", self.name),
            width_px: self.size_px,
            height_px: self.size_px,
            rgba8: (0..n * n)
                .into_par_iter()
                .with_min_len(4096)
                .flat_map_iter(pixel)
                .collect(),
            encoding,
            wrap: [Wrap::Repeat; 2],
        };
        let encoder = SrgbEncoder::new();
        let albedo = image("albedo", TextureEncoding::Srgb, &|i| {
            let [r, g, b] = texels[i].albedo.to_array().map(|c| encoder.encode(c));
            [r, g, b, 255]
        });
        let normal = image("normal", TextureEncoding::Linear, &|i| {
            let (x, y) = (i % n, i / n);
            // Green points up the image, against the rows.
            let right = height(x + 1, y) - height(x + n - 1, y);
            let up = height(x, y + n - 1) - height(x, y + 1);
            let normal = Vec3::new(-right, -up, two_texels_m).normalize();
            let [r, g, b] = (normal * 0.5 + 0.5).to_array().map(to_byte);
            [r, g, b, 255]
        });
        let roughness = image("roughness", TextureEncoding::Linear, &|i| {
            [0, to_byte(texels[i].roughness), 255, 255]
        });
        [albedo, normal, roughness]
    }
}

/// Paints the recipes (side by side on all cores) and adds a material for each.
pub fn add_materials(geometry: &mut Geometry, recipes: &[Recipe]) -> Vec<Finish> {
    let painted: Vec<[Texture; 3]> = recipes.iter().map(Recipe::paint).collect();
    recipes
        .iter()
        .zip(painted)
        .map(|(recipe, textures)| {
            let first = geometry.textures.len();
            geometry.textures.extend(textures);
            geometry.materials.push(Material {
                name: recipe.name.to_owned(),
                albedo: [1.0; 3],
                albedo_texture: Some(first.into()),
                normal_texture: Some((first + 1).into()),
                roughness: 1.0,
                roughness_texture: Some((first + 2).into()),
                ..Material::default()
            });
            Finish {
                material: geometry.materials.len() - 1,
                tile_m: recipe.tile_m,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recipes() -> Vec<Recipe> {
        let mut all = masonry::all(1);
        all.extend(plain::all(1));
        all.extend(cloth::all(1));
        all
    }

    /// Mean absolute difference between two columns (or rows) of texels, all channels.
    fn step(texture: &Texture, a: u32, b: u32, columns: bool) -> f64 {
        let n = texture.width_px;
        let at = |line: u32, i: u32| {
            let (x, y) = if columns { (line, i) } else { (i, line) };
            let k = 4 * (y * n + x) as usize;
            &texture.rgba8[k..k + 3]
        };
        let total: u32 = (0..n)
            .flat_map(|i| at(a, i).iter().zip(at(b, i)))
            .map(|(&p, &q)| u32::from(p.abs_diff(q)))
            .sum();
        f64::from(total) / f64::from(3 * n)
    }

    /// Over the seam the picture changes no more than between neighbours elsewhere.
    #[test]
    fn textures_tile() {
        for recipe in recipes() {
            for texture in recipe.paint() {
                let n = texture.width_px;
                for columns in [true, false] {
                    let seam = step(&texture, n - 1, 0, columns);
                    let largest = (0..n - 1)
                        .map(|i| step(&texture, i, i + 1, columns))
                        .fold(0.0, f64::max);
                    assert!(
                        seam <= 1.1 * largest + 0.5,
                        "{}: {seam} {largest}",
                        texture.name
                    );
                }
            }
        }
    }

    #[test]
    fn textures_are_plausible() {
        for recipe in recipes() {
            for texel in recipe.texels() {
                assert!(texel.albedo.min_element() >= 0.0, "{}", recipe.name);
                assert!(texel.albedo.max_element() <= 0.95, "{}", recipe.name);
                assert!((0.05..=1.0).contains(&texel.roughness), "{}", recipe.name);
                assert!(texel.height_m.abs() < 0.05, "{}", recipe.name);
            }
        }
    }

    #[test]
    fn a_slope_to_the_right_leans_the_normal_left() {
        let recipe = Recipe {
            name: "ramp",
            size_px: 16,
            tile_m: 1.0,
            texel: Box::new(|uv| Texel {
                albedo: Vec3::splat(0.5),
                height_m: uv.x * 0.5,
                roughness: 1.0,
            }),
        };
        let [albedo, normal, _] = recipe.paint();
        let middle = 4 * (8 * 16 + 8);
        assert!(normal.rgba8[middle] < 100 && normal.rgba8[middle + 1] == 128);
        // 0.5 linear is 188 in sRGB.
        assert_eq!(albedo.rgba8[middle], 188);
    }
}
