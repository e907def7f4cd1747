//! Small models, written by hand.

use std::path::Path;

use serde_json::{Value, json};

use crate::scene::Vertex;
use crate::scene::model::{Model, ModelError, ModelOptions, load};

pub const U8: u32 = 5121;
pub const U16: u32 = 5123;
pub const U32: u32 = 5125;
pub const F32: u32 = 5126;

/// A glTF in the making.
#[derive(Clone)]
pub struct Gltf {
    pub json: Value,
    pub bin: Vec<u8>,
}

impl Gltf {
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"},
            "accessors": [], "bufferViews": [], "meshes": [], "nodes": [],
        });
        Self {
            json,
            bin: Vec::new(),
        }
    }

    /// Appends to one of the document's lists; gives the index.
    pub fn push(&mut self, list: &str, item: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let items = self.json[list].as_array_mut().unwrap();
        items.push(item);
        items.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.bin.len().is_multiple_of(4) {
            self.bin.push(0);
        }
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        self.push(
            "bufferViews",
            json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}),
        )
    }

    pub fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count}),
        )
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(kind, F32, values.len() / width, &bytes)
    }

    pub fn indices(&mut self, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor("SCALAR", U16, values.len(), &bytes)
    }

    /// A triangle on the plane z = 0, facing +Z, with normals and texture coordinates;
    /// mesh 0, shown by node 0.
    pub fn triangle() -> Self {
        let mut file = Self::new();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
        // v runs down, as glTF has it.
        let uvs = file.floats("VEC2", &[0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
        let indices = file.indices(&[0, 1, 2]);
        file.push(
            "meshes",
            json!({"name": "tri", "primitives": [{
                "attributes": {"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs},
                "indices": indices,
            }]}),
        );
        file.push("nodes", json!({"mesh": 0}));
        file
    }

    /// The primitive of [`triangle`](Self::triangle).
    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// A 2 × 1 PNG as image, with a texture of it; gives the texture's index.
    pub fn texture(&mut self, sampler: Option<usize>) -> usize {
        let view = self.view(&png());
        let image = self.push(
            "images",
            json!({"bufferView": view, "mimeType": "image/png"}),
        );
        let mut texture = json!({"source": image});
        if let Some(sampler) = sampler {
            texture["sampler"] = json!(sampler);
        }
        self.push("textures", texture)
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bin.is_empty() {
            json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = self.bin.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let mut bytes = b"glTF".to_vec();
        let length = 12 + 8 + text.len() + 8 + bin.len();
        for number in [2, length as u32, text.len() as u32] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(b"JSON");
        bytes.extend(&text);
        bytes.extend((bin.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(&bin);
        bytes
    }

    pub fn load(&self) -> Result<Model, ModelError> {
        self.load_with(&ModelOptions::default())
    }

    pub fn load_with(&self, options: &ModelOptions) -> Result<Model, ModelError> {
        load_bytes("m.glb", &self.glb(), options)
    }

    /// The vertices of the only mesh.
    pub fn vertices(&self) -> Vec<Vertex> {
        let model = self.load().unwrap();
        assert_eq!(model.geometry.meshes.len(), 1);
        model.geometry.meshes[0].vertices.clone()
    }

    pub fn message(&self) -> String {
        self.load().unwrap_err().to_string()
    }
}

/// Loads a file of that name with those bytes.
pub fn load_bytes(name: &str, bytes: &[u8], options: &ModelOptions) -> Result<Model, ModelError> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    load(&path, options)
}

/// Two pixels, red and half-transparent blue.
pub fn png() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let pixels = image::RgbaImage::from_raw(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 128]).unwrap();
    pixels
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

pub fn assert_parts(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in {message:?}");
    }
}

pub fn assert_near(found: &[f32], expected: &[f32]) {
    assert_eq!(found.len(), expected.len());
    for (f, e) in found.iter().zip(expected) {
        assert!(
            (f - e).abs() < 1e-5,
            "found {found:?}, expected {expected:?}"
        );
    }
}

/// What every geometry that leaves the loader must be.
pub fn assert_sound(model: &Model) {
    let geometry = &model.geometry;
    for mesh in &geometry.meshes {
        assert!(mesh.material < geometry.materials.len());
        assert!(mesh.indices.len().is_multiple_of(3) && !mesh.indices.is_empty());
        let count = mesh.vertices.len();
        assert!(mesh.indices.iter().all(|&i| (i as usize) < count));
        for vertex in &mesh.vertices {
            assert!(vertex.position_m.iter().all(|x| x.is_finite()));
            assert!(vertex.uv.iter().chain(&vertex.color).all(|x| x.is_finite()));
            let length = |v: &[f32]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!((length(&vertex.normal) - 1.0).abs() < 1e-3, "{vertex:?}");
            assert!(
                (length(&vertex.tangent[..3]) - 1.0).abs() < 1e-3,
                "{vertex:?}"
            );
            assert_eq!(vertex.tangent[3].abs(), 1.0, "{vertex:?}");
        }
    }
    for slot in geometry.materials.iter().flat_map(|m| m.textures()) {
        assert!(slot.texture < geometry.textures.len());
    }
    for texture in &geometry.textures {
        let pixels = texture.width_px as usize * texture.height_px as usize;
        assert_eq!(texture.rgba8.len(), 4 * pixels);
    }
}

pub fn write(dir: &Path, name: &str, bytes: impl AsRef<[u8]>) -> std::path::PathBuf {
    let path = dir.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}
