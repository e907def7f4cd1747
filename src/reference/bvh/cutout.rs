//! Materials with holes: where a triangle's alpha is below its cutoff, there is no surface.

use glam::{Vec2, Vec4};

use crate::scene::{Geometry, Material, Texture, Wrap};

/// A triangle that may let rays through.
#[derive(Debug, Clone)]
pub(super) struct Cutout {
    uv: [Vec2; 3],
    /// The corners' alpha times the material's.
    alpha: [f32; 3],
    material: usize,
}

/// The cutouts of a geometry.
#[derive(Debug, Default)]
pub(super) struct Cutouts {
    triangles: Vec<Cutout>,
    /// Cutoff and texture of each material.
    materials: Vec<(f32, Option<AlphaTexture>)>,
}

#[derive(Debug)]
struct AlphaTexture {
    transform: glam::Affine2,
    size_px: [u32; 2],
    wrap: [Wrap; 2],
    alpha: Vec<u8>,
}

impl Cutouts {
    pub fn of(geometry: &Geometry) -> Self {
        Self {
            triangles: Vec::new(),
            materials: geometry
                .materials
                .iter()
                .map(|material| {
                    let cutoff = material.alpha_cutoff.unwrap_or(0.0);
                    (cutoff, alpha_texture(material, geometry))
                })
                .collect(),
        }
    }

    /// Adds a triangle of a material with a cutoff; its number here.
    pub fn add(&mut self, uv: [Vec2; 3], alpha: [f32; 3], material: usize) -> u32 {
        self.triangles.push(Cutout {
            uv,
            alpha,
            material,
        });
        self.triangles.len() as u32 - 1
    }

    /// Whether there is a surface at a point of a triangle, given the weights of its corners 1
    /// and 2. The texture's nearest texel decides: the picture filters its textures, so an edge
    /// may be off by part of a texel.
    pub fn is_solid(&self, triangle: u32, weights: [f32; 2]) -> bool {
        let cutout = &self.triangles[triangle as usize];
        let [w1, w2] = weights;
        let w0 = 1.0 - w1 - w2;
        let uv = cutout.uv[0] * w0 + cutout.uv[1] * w1 + cutout.uv[2] * w2;
        let own = cutout.alpha[0] * w0 + cutout.alpha[1] * w1 + cutout.alpha[2] * w2;
        let (cutoff, texture) = &self.materials[cutout.material];
        let texel = texture.as_ref().map_or(1.0, |texture| texture.at(uv));
        own * texel >= *cutoff
    }
}

/// The alpha of a material's colour texture, if it can be cut out and its texture has any.
fn alpha_texture(material: &Material, geometry: &Geometry) -> Option<AlphaTexture> {
    material.alpha_cutoff?;
    let used = material.albedo_texture?;
    let texture: &Texture = &geometry.textures[used.texture];
    Some(AlphaTexture {
        transform: used.transform,
        size_px: [texture.width_px, texture.height_px],
        wrap: texture.wrap,
        alpha: texture
            .rgba8
            .chunks_exact(4)
            .map(|texel| texel[3])
            .collect(),
    })
}

impl AlphaTexture {
    fn at(&self, uv: Vec2) -> f32 {
        let uv = self.transform.transform_point2(uv);
        let [x, y] = [0, 1].map(|axis| texel(uv[axis], self.size_px[axis], self.wrap[axis]));
        f32::from(self.alpha[(y * self.size_px[0] + x) as usize]) / 255.0
    }
}

/// The texel at a texture coordinate along one axis.
pub(in crate::reference) fn texel(coordinate: f32, size_px: u32, wrap: Wrap) -> u32 {
    let within = match wrap {
        Wrap::Repeat => coordinate.rem_euclid(1.0),
        Wrap::Clamp => coordinate.clamp(0.0, 1.0),
        Wrap::Mirror => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
    };
    // No number becomes 0.
    ((within * size_px as f32) as u32).min(size_px - 1)
}

/// What a vertex brings to its triangle's alpha.
pub(super) fn vertex_alpha(color: [f32; 4], material: &Material) -> f32 {
    Vec4::from(color).w * material.alpha
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_go_on_beyond_their_edges() {
        let texels = |wrap| [-0.25, 0.125, 0.875, 1.125, 1.75].map(|at| texel(at, 10, wrap));
        assert_eq!(texels(Wrap::Repeat), [7, 1, 8, 1, 7]);
        assert_eq!(texels(Wrap::Clamp), [0, 1, 8, 9, 9]);
        assert_eq!(texels(Wrap::Mirror), [2, 1, 8, 8, 2]);
        assert_eq!(texel(f32::NAN, 10, Wrap::Repeat), 0);
        assert_eq!(texel(1.0, 10, Wrap::Mirror), 9);
    }
}
