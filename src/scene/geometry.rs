//! Triangles and what they are made of.

use glam::Vec3;

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

/// An 8-bit RGBA image, rows from the top, that repeats in both directions.
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
}

/// How a surface answers light: metallic-roughness, as in glTF 2.0.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// For messages.
    pub name: String,
    /// Linear diffuse colour, multiplied by the texture and the vertex colour.
    pub albedo: [f32; 3],
    /// Index of an sRGB texture in [`Geometry::textures`].
    pub albedo_texture: Option<usize>,
    /// Index of a linear tangent-space normal map (+Y along the bitangent, "GL").
    pub normal_texture: Option<usize>,
    /// Perceptual roughness, 0 to 1, multiplied by the texture's green channel.
    pub roughness: f32,
    /// Index of a linear texture whose green channel is roughness.
    pub roughness_texture: Option<usize>,
    /// 0 (dielectric) or 1 (metal), multiplied by the roughness texture's blue channel.
    pub metallic: f32,
    /// Specular reflectance at normal incidence of a dielectric (0.04 is common).
    pub specular: f32,
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
            roughness: 0.9,
            roughness_texture: None,
            metallic: 0.0,
            specular: 0.04,
            double_sided: false,
        }
    }
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
