//! Materials: metallic-roughness, with the extensions that are drawn.

use std::collections::BTreeMap;

use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::super::{Loading, plain_material};
use super::document::{Document, look_up};
use super::texture::{Slot, Textures};
use crate::scene::{Material, TextureEncoding, TextureUse};

/// The alpha below which a blended surface is not drawn: nothing here is half there.
const BLEND_CUTOFF: f32 = 0.5;

/// Brightest emission, linear radiance: what a config allows.
const BRIGHTEST: f32 = 10_000.0;

/// The materials in use, read when a primitive first asks for them.
pub(super) struct Materials<'a> {
    document: &'a Document,
    textures: Textures,
    known: BTreeMap<Option<usize>, Used>,
}

/// A material of the geometry, and what it wants of vertices.
#[derive(Debug, Clone, Copy)]
pub(super) struct Used {
    /// Index into the geometry's materials.
    pub index: usize,
    /// The set of texture coordinates it is read at; `None` without textures.
    pub uv_set: Option<u32>,
}

impl<'a> Materials<'a> {
    pub fn new(document: &'a Document) -> Self {
        Self {
            document,
            textures: Textures::default(),
            known: BTreeMap::new(),
        }
    }

    /// The material a primitive names; `place` is the primitive.
    pub fn get(
        &mut self,
        material: Option<json::Index<json::Material>>,
        place: &str,
        loading: &mut Loading,
    ) -> Result<Used, Fault> {
        let key = material.map(|index| index.value());
        if let Some(&used) = self.known.get(&key) {
            return Ok(used);
        }
        let (material, uv_set) = match material {
            None => {
                loading.warnings.say(
                    "there are surfaces without a material: they are drawn matt grey (`albedo` and \
                     `roughness` change it)",
                );
                (plain_material(loading.options), None)
            }
            Some(index) => {
                let materials = &self.document.root.materials;
                let json = look_up(materials, index, "material", place)?;
                self.read(json, index.value(), loading)?
            }
        };
        loading.geometry.materials.push(material);
        let used = Used {
            index: loading.geometry.materials.len() - 1,
            uv_set,
        };
        self.known.insert(key, used);
        Ok(used)
    }

    fn read(
        &mut self,
        json: &json::Material,
        index: usize,
        loading: &mut Loading,
    ) -> Result<(Material, Option<u32>), Fault> {
        let place = format!("materials[{index}]");
        let pbr = &json.pbr_metallic_roughness;
        let extensions = json.extensions.as_ref();
        let [r, g, b, alpha] = pbr.base_color_factor.0.map(|c| c.clamp(0.0, 1.0));
        let mut slots = Slots {
            materials: self,
            loading,
            place: &place,
            uv_set: None,
        };
        let (linear, srgb) = (TextureEncoding::Linear, TextureEncoding::Srgb);
        let material = Material {
            name: json.name.clone().unwrap_or_else(|| place.clone()),
            albedo: [r, g, b],
            albedo_texture: slots.info(
                "baseColorTexture",
                pbr.base_color_texture.as_ref(),
                srgb,
            )?,
            normal_texture: slots.normal(json.normal_texture.as_ref())?,
            normal_scale: json
                .normal_texture
                .as_ref()
                .map_or(1.0, |t| finite_or_1(t.scale)),
            roughness: pbr.roughness_factor.0.clamp(0.0, 1.0),
            roughness_texture: slots.info(
                "metallicRoughnessTexture",
                pbr.metallic_roughness_texture.as_ref(),
                linear,
            )?,
            metallic: pbr.metallic_factor.0.clamp(0.0, 1.0),
            emission: emission(json),
            emission_texture: slots.info(
                "emissiveTexture",
                json.emissive_texture.as_ref(),
                srgb,
            )?,
            occlusion_texture: slots.occlusion(json.occlusion_texture.as_ref())?,
            occlusion_strength: json
                .occlusion_texture
                .as_ref()
                .map_or(1.0, |t| t.strength.0.clamp(0.0, 1.0)),
            alpha_cutoff: slots.alpha_cutoff(json)?,
            alpha,
            unlit: extensions.is_some_and(|e| e.unlit.is_some()),
            double_sided: json.double_sided,
            ..Material::default()
        };
        Ok((material, slots.uv_set))
    }
}

/// The texture slots of one material, which share one set of texture coordinates:
/// a vertex has no second.
struct Slots<'m, 'd, 'l, 'o> {
    materials: &'m mut Materials<'d>,
    loading: &'l mut Loading<'o>,
    place: &'m str,
    uv_set: Option<u32>,
}

impl Slots<'_, '_, '_, '_> {
    fn info(
        &mut self,
        name: &str,
        info: Option<&Info>,
        encoding: TextureEncoding,
    ) -> Result<Option<TextureUse>, Fault> {
        let Some(info) = info else { return Ok(None) };
        let extensions = info.extensions.as_ref();
        self.read(Slot {
            texture: info.index,
            uv_set: info.tex_coord,
            transform: extensions.and_then(|e| e.texture_transform.clone()),
            encoding,
            place: &format!("{}.{name}", self.place),
        })
    }

    fn normal(
        &mut self,
        json: Option<&json::material::NormalTexture>,
    ) -> Result<Option<TextureUse>, Fault> {
        let Some(json) = json else { return Ok(None) };
        let place = format!("{}.normalTexture", self.place);
        let others = json.extensions.as_ref().map(|e| &e.others);
        self.read(Slot {
            texture: json.index,
            uv_set: json.tex_coord,
            transform: transform(others.and_then(|o| o.get(TRANSFORM)), &place)?,
            encoding: TextureEncoding::Linear,
            place: &place,
        })
    }

    fn occlusion(
        &mut self,
        json: Option<&json::material::OcclusionTexture>,
    ) -> Result<Option<TextureUse>, Fault> {
        let Some(json) = json else { return Ok(None) };
        let place = format!("{}.occlusionTexture", self.place);
        let others = json.extensions.as_ref().map(|e| &e.others);
        self.read(Slot {
            texture: json.index,
            uv_set: json.tex_coord,
            transform: transform(others.and_then(|o| o.get(TRANSFORM)), &place)?,
            encoding: TextureEncoding::Linear,
            place: &place,
        })
    }

    fn read(&mut self, slot: Slot) -> Result<Option<TextureUse>, Fault> {
        let uv_set = slot.uv_set();
        if *self.uv_set.get_or_insert(uv_set) != uv_set {
            self.loading.warnings.say(format!(
                "{} uses a second set of texture coordinates; it is drawn with the first one",
                slot.place
            ));
        }
        let document = self.materials.document;
        let textures = &mut self.materials.textures;
        textures.read(document, &slot, self.loading).map(Some)
    }

    fn alpha_cutoff(&mut self, json: &json::Material) -> Result<Option<f32>, Fault> {
        match json.alpha_mode {
            Checked::Valid(AlphaMode::Opaque) => Ok(None),
            Checked::Valid(AlphaMode::Mask) => {
                let cutoff = json.alpha_cutoff.unwrap_or_default().0;
                Ok(Some(cutoff.clamp(0.0, 1.0)))
            }
            Checked::Valid(AlphaMode::Blend) => {
                self.loading.warnings.say(format!(
                    "{} is transparent; it is drawn where its alpha is {BLEND_CUTOFF} or more, \
                     opaque",
                    self.place
                ));
                Ok(Some(BLEND_CUTOFF))
            }
            Checked::Invalid => {
                let message = "is none of OPAQUE, MASK and BLEND";
                Err(Fault::new(format!("{}.alphaMode", self.place), message))
            }
        }
    }
}

/// Linear radiance that the surface sends out.
fn emission(json: &json::Material) -> [f32; 3] {
    let extensions = json.extensions.as_ref();
    let strength = extensions
        .and_then(|e| e.emissive_strength.as_ref())
        .map_or(1.0, |e| e.emissive_strength.0);
    let factor = json.emissive_factor.0;
    factor.map(|c| (c * strength).clamp(0.0, BRIGHTEST))
}

const TRANSFORM: &str = "KHR_texture_transform";

/// The extension where the `gltf` crate has it as plain JSON only.
fn transform(json: Option<&json::Value>, place: &str) -> Result<Option<TextureTransform>, Fault> {
    let parse = |value: &json::Value| {
        json::deserialize::from_value(value.clone()).map_err(|error| {
            Fault::new(format!("{place}.extensions.{TRANSFORM}"), error.to_string())
        })
    };
    json.map(parse).transpose()
}

fn finite_or_1(x: f32) -> f32 {
    if x.is_finite() { x } else { 1.0 }
}
