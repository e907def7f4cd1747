//! Triangles and what they are made of.

use glam::{Affine2, Vec3};

use super::lighting::{PointLight, Sun};

/// One corner of a triangle.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Vertex {
    /// World-space position, metres.
    pub position_m: [f32; 3],
    /// Unit normal, world space.
    pub normal: [f32; 3],
    /// Unit tangent along increasing `uv.x`, and the handedness (±1) of
    /// `bitangent = w · cross(normal, tangent)`, as glTF 2.0 has it.
    pub tangent: [f32; 4],
    /// Texture coordinates; textures repeat.
    pub uv: [f32; 2],
    /// Linear colour that multiplies the material's albedo (1, 1, 1, 1 leaves it).
    pub color: [f32; 4],
}

/// A triangle list of one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// What this part is, for messages and explanations ("columns").
    pub name: String,
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// Three indices into `vertices` a triangle.
    pub indices: Vec<u32>,
    /// Index into [`Geometry::materials`].
    pub material: usize,
}

/// How a texture's red, green and blue are encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextureEncoding {
    /// sRGB transfer function (albedo).
    Srgb,
    /// Numbers as they are (normals, roughness).
    Linear,
}

/// How a texture goes on beyond its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// From the other side.
    #[default]
    Repeat,
    /// With its last row or column.
    Clamp,
    /// Back the way it came.
    Mirror,
}

/// An 8-bit RGBA image, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// What it shows, for messages.
    pub name: String,
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// `4 · width_px · height_px` bytes.
    pub rgba8: Vec<u8>,
    /// Encoding of the colour channels; alpha is always linear.
    pub encoding: TextureEncoding,
    /// Beyond the left and right edges, and beyond the top and bottom.
    pub wrap: [Wrap; 2],
}

/// A texture as one slot of a material uses it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureUse {
    /// Index into [`Geometry::textures`].
    pub texture: usize,
    /// From the vertex' texture coordinates to the texture's (`KHR_texture_transform`).
    pub transform: Affine2,
}

impl From<usize> for TextureUse {
    fn from(texture: usize) -> Self {
        Self {
            texture,
            transform: Affine2::IDENTITY,
        }
    }
}

/// How a surface answers light: metallic-roughness, as in glTF 2.0.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// For messages.
    pub name: String,
    /// Linear diffuse colour, multiplied by the texture and the vertex colour.
    pub albedo: [f32; 3],
    /// An sRGB texture; its alpha is what `alpha_cutoff` is compared with.
    pub albedo_texture: Option<TextureUse>,
    /// A linear tangent-space normal map (+Y along the bitangent, "GL").
    pub normal_texture: Option<TextureUse>,
    /// Multiplies the normal map's x and y.
    pub normal_scale: f32,
    /// Perceptual roughness, 0 to 1, multiplied by the texture's green channel.
    pub roughness: f32,
    /// A linear texture whose green channel is roughness and whose blue is metalness.
    pub roughness_texture: Option<TextureUse>,
    /// 0 (dielectric) or 1 (metal), multiplied by the roughness texture's blue channel.
    pub metallic: f32,
    /// Specular reflectance at normal incidence of a dielectric (0.04 is common).
    pub specular: f32,
    /// Linear radiance the surface sends out by itself, multiplied by the texture.
    pub emission: [f32; 3],
    /// An sRGB texture.
    pub emission_texture: Option<TextureUse>,
    /// A linear texture whose red channel is ambient occlusion baked by the model's
    /// author. It is used only by a scene that asks for it: on top of a computed
    /// occlusion it would count the same shadow twice.
    pub occlusion_texture: Option<TextureUse>,
    /// How much of the baked occlusion counts, 0 to 1.
    pub occlusion_strength: f32,
    /// Alpha, 0 to 1, below which there is no surface; `None` for an opaque material.
    pub alpha_cutoff: Option<f32>,
    /// Opacity, multiplied by the albedo texture's and the vertex' alpha before the
    /// cutoff.
    pub alpha: f32,
    /// Whether the surface shows its albedo as it is, whatever the light
    /// (`KHR_materials_unlit`).
    pub unlit: bool,
    /// Whether both sides are seen (thin cloth); the back's normal is flipped.
    pub double_sided: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::from("grey"),
            albedo: [0.5; 3],
            albedo_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            roughness: 0.9,
            roughness_texture: None,
            metallic: 0.0,
            specular: 0.04,
            emission: [0.0; 3],
            emission_texture: None,
            occlusion_texture: None,
            occlusion_strength: 1.0,
            alpha_cutoff: None,
            alpha: 1.0,
            unlit: false,
            double_sided: false,
        }
    }
}

impl Material {
    /// Every texture the material uses.
    pub fn textures(&self) -> impl Iterator<Item = TextureUse> {
        [
            self.albedo_texture,
            self.normal_texture,
            self.roughness_texture,
            self.emission_texture,
            self.occlusion_texture,
        ]
        .into_iter()
        .flatten()
    }

    /// Whether the surface sends out light of its own.
    #[must_use]
    pub fn emits(&self) -> bool {
        self.unlit || self.emission.iter().any(|&channel| channel > 0.0)
    }
}

/// Lights that came with a model. They shine only where a lighting variant asks for
/// them, in its units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModelLights {
    /// From far away; irradiance in lux.
    pub suns: Vec<Sun>,
    /// From a point; intensity in candela.
    pub points: Vec<PointLight>,
}

/// Everything in a scene that has a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Geometry {
    /// Triangles, by material.
    pub meshes: Vec<Mesh>,
    /// What the meshes point to.
    pub materials: Vec<Material>,
    /// What the materials point to.
    pub textures: Vec<Texture>,
    /// The model's own lights, if its file has any.
    pub lights: ModelLights,
}

impl Geometry {
    /// Number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }

    /// The corners of the axis-aligned box round all vertices, metres; `None`
    /// without any.
    #[must_use]
    pub fn bounds_m(&self) -> Option<(Vec3, Vec3)> {
        self.meshes
            .iter()
            .flat_map(|mesh| &mesh.vertices)
            .map(|vertex| Vec3::from(vertex.position_m))
            .fold(None, |bounds, p| match bounds {
                None => Some((p, p)),
                Some((low, high)) => Some((low.min(p), high.max(p))),
            })
    }

    /// Whether any material has a normal map (and so needs tangents).
    #[must_use]
    pub fn has_normal_maps(&self) -> bool {
        self.materials.iter().any(|m| m.normal_texture.is_some())
    }
}
