//! What a surface sends back: the albedo at any point of a scene's triangles.

use glam::{Vec2, Vec3};

use super::bvh::texel;
use crate::scene::{Geometry, Material, Mesh, Texture, TextureEncoding, Vertex, srgb};

/// The albedos of a geometry's triangles: material × texture × vertex colour, linear, each channel
/// brought to 0 to 1, as the renderer stores them.
///
/// A metal's colour stands for its albedo, as it does where the renderer draws no reflections. What
/// shows its colour whatever the light (`unlit`) sends nothing back. Of a texture the nearest texel
/// of its finest level counts; a picture's own filter is the mean of many.
#[derive(Debug)]
pub struct Albedos<'a> {
    geometry: &'a Geometry,
    /// Number of the first triangle of each mesh.
    first: Vec<u32>,
    /// Linear light of each of the 256 levels of sRGB.
    linear: [f32; 256],
}

impl<'a> Albedos<'a> {
    /// Of a geometry.
    #[must_use]
    pub fn of(geometry: &'a Geometry) -> Self {
        let mut count = 0;
        let first = (geometry.meshes.iter())
            .map(|mesh| {
                let first = count;
                count += (mesh.indices.len() / 3) as u32;
                first
            })
            .collect();
        Self {
            geometry,
            first,
            linear: std::array::from_fn(|level| srgb::decode(level as f32 / 255.0)),
        }
    }

    /// Linear RGB, 0 to 1, at a point of a triangle, metres; the triangle is numbered as in
    /// [`Hit::triangle`](super::bvh::Hit::triangle). Black where there is no such triangle.
    #[must_use]
    pub fn at(&self, triangle: u32, position_m: Vec3) -> Vec3 {
        let Some((mesh, corners)) = self.triangle(triangle) else {
            return Vec3::ZERO;
        };
        let Some(material) = self.geometry.materials.get(mesh.material) else {
            return Vec3::ZERO;
        };
        if material.unlit {
            return Vec3::ZERO;
        }
        let weights = weights(corners.map(|corner| corner.position_m.into()), position_m);
        let mixed = |of: fn(&Vertex) -> Vec3| {
            let parts = corners.iter().zip(weights);
            parts.map(|(corner, weight)| of(corner) * weight).sum()
        };
        let color: Vec3 = mixed(|corner| Vec3::from_slice(&corner.color[..3]));
        let uv: Vec3 = mixed(|corner| Vec2::from(corner.uv).extend(0.0));
        let albedo = Vec3::from(material.albedo) * color * self.texture(material, uv.truncate());
        albedo.clamp(Vec3::ZERO, Vec3::ONE)
    }

    fn triangle(&self, triangle: u32) -> Option<(&'a Mesh, [&'a Vertex; 3])> {
        // Of meshes without triangles, which begin where the next one does, the last is meant.
        let mesh = self.first.partition_point(|&first| first <= triangle);
        let mesh = mesh.checked_sub(1)?;
        let corner = 3 * (triangle - self.first[mesh]) as usize;
        let mesh = &self.geometry.meshes[mesh];
        let indices = mesh.indices.get(corner..corner + 3)?;
        Some((mesh, [0, 1, 2].map(|k| &mesh.vertices[indices[k] as usize])))
    }

    /// The colour texture's part at the vertex' texture coordinates; white without a texture.
    fn texture(&self, material: &Material, uv: Vec2) -> Vec3 {
        let Some(used) = material.albedo_texture else {
            return Vec3::ONE;
        };
        let texture: &Texture = &self.geometry.textures[used.texture];
        let uv = used.transform.transform_point2(uv);
        let x = texel(uv.x, texture.width_px, texture.wrap[0]) as usize;
        let y = texel(uv.y, texture.height_px, texture.wrap[1]) as usize;
        let at = 4 * (y * texture.width_px as usize + x);
        Vec3::from([0, 1, 2].map(|channel| {
            let level = texture.rgba8[at + channel];
            match texture.encoding {
                TextureEncoding::Srgb => self.linear[usize::from(level)],
                TextureEncoding::Linear => f32::from(level) / 255.0,
            }
        }))
    }
}

/// The weights of a triangle's corners at a point of its plane, brought into the triangle. In double
/// precision: of a thin triangle single precision leaves nothing.
fn weights(corners: [Vec3; 3], position_m: Vec3) -> [f32; 3] {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (u, v, p) = (b - a, c - a, position_m.as_dvec3() - a);
    let normal = u.cross(v);
    let scale = 1.0 / normal.length_squared();
    let second = (p.cross(v).dot(normal) * scale).clamp(0.0, 1.0);
    let third = (u.cross(p).dot(normal) * scale).clamp(0.0, 1.0 - second);
    [1.0 - second - third, second, third].map(|weight| weight as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::primitives::{of_one_material, quad};
    use crate::scene::{TextureUse, Wrap};

    #[test]
    fn weights_are_those_of_the_corners() {
        let corners = [Vec3::ZERO, Vec3::X * 2.0, Vec3::new(0.5, 3.0, 1.0)];
        for wanted in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.25, 0.5, 0.25]] {
            let at = (corners.iter().zip(wanted))
                .map(|(corner, weight)| *corner * weight)
                .sum();
            let found = weights(corners, at);
            let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f32::max) < 1e-6, "{found:?}");
        }
    }

    /// Material, texture and vertex colour multiply; meshes are numbered one after another.
    #[test]
    fn what_makes_a_colour_multiplies() {
        let pane = |x: f32| quad("pane", Vec3::X * x, Vec3::X, Vec3::Y);
        let mut geometry = of_one_material(Material::default(), vec![pane(0.0), pane(5.0)]);
        geometry.textures.push(Texture {
            name: String::from("half"),
            width_px: 2,
            height_px: 1,
            rgba8: vec![255, 0, 0, 255, 0, 188, 0, 255],
            encoding: TextureEncoding::Srgb,
            wrap: [Wrap::Clamp; 2],
        });
        geometry.materials[0].albedo = [0.5, 0.5, 1.0];
        geometry.materials[0].albedo_texture = Some(TextureUse::from(0));
        for vertex in &mut geometry.meshes[1].vertices {
            vertex.color = [0.5, 4.0, 1.0, 1.0];
        }
        let albedos = Albedos::of(&geometry);
        let green = srgb::decode(188.0 / 255.0);
        for (triangle, x, wanted) in [
            (0, 0.4, Vec3::new(0.5, 0.0, 0.0)),
            (0, 0.6, Vec3::new(0.0, 0.5 * green, 0.0)),
            (2, 5.4, Vec3::new(0.25, 0.0, 0.0)),
            (2, 5.6, Vec3::new(0.0, (2.0 * green).min(1.0), 0.0)),
            (9, 5.6, Vec3::ZERO),
        ] {
            let found = albedos.at(triangle, Vec3::new(x, 0.1, 0.0));
            assert!(found.abs_diff_eq(wanted, 1e-6), "{triangle}: {found}");
        }
        geometry.materials[0].unlit = true;
        assert_eq!(Albedos::of(&geometry).at(0, Vec3::ZERO), Vec3::ZERO);
    }
}
