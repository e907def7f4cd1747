//! Images of a file, decoded once for each way they are used.

use std::collections::BTreeMap;

use glam::{Affine2, Mat2, Vec2};
use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::texture::WrappingMode;
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::super::image;
use super::super::uri::{self, Reference};
use super::super::{Loading, check_is_file};
use super::buffers::Region;
use super::document::{Document, look_up};
use crate::scene::modelling::math;
use crate::scene::{Texture, TextureEncoding, TextureUse, Wrap};

/// Textures by image, encoding and wrapping.
#[derive(Default)]
pub(super) struct Textures {
    known: BTreeMap<(usize, bool, [u32; 2]), usize>,
}

/// A texture slot of a material, as the file has it.
pub(super) struct Slot<'a> {
    pub texture: json::Index<json::Texture>,
    pub uv_set: u32,
    pub transform: Option<TextureTransform>,
    pub encoding: TextureEncoding,
    /// `materials[2].normalTexture`, for messages.
    pub place: &'a str,
}

impl Slot<'_> {
    /// The set of texture coordinates it is read at.
    pub fn uv_set(&self) -> u32 {
        let overriding = self.transform.as_ref().and_then(|t| t.tex_coord);
        overriding.unwrap_or(self.uv_set)
    }
}

impl Textures {
    /// The texture of a slot, decoded if it is new.
    pub fn read(
        &mut self,
        document: &Document,
        slot: &Slot,
        loading: &mut Loading,
    ) -> Result<TextureUse, Fault> {
        let root = &document.root;
        let json = look_up(&root.textures, slot.texture, "texture", slot.place)?;
        let place = format!("textures[{}]", slot.texture.value());
        if json.source.value() == u32::MAX as usize {
            let message =
                "has no `source`; PNG and JPEG are read, other formats are not: convert it";
            return Err(Fault::new(place, message));
        }
        look_up(&root.images, json.source, "image", &place)?;
        let wrap = match json.sampler {
            Some(sampler) => {
                let sampler = look_up(&root.samplers, sampler, "sampler", &place)?;
                [wrap(sampler.wrap_s, &place)?, wrap(sampler.wrap_t, &place)?]
            }
            None => [Wrap::Repeat; 2],
        };
        let srgb = slot.encoding == TextureEncoding::Srgb;
        let key = (json.source.value(), srgb, wrap.map(|w| w as u32));
        let texture = match self.known.get(&key) {
            Some(&known) => known,
            None => {
                let texture = decode(document, json.source.value(), slot.encoding, wrap, loading)?;
                loading.geometry.textures.push(texture);
                let index = loading.geometry.textures.len() - 1;
                self.known.insert(key, index);
                index
            }
        };
        let transform = match &slot.transform {
            Some(transform) => affine(transform, slot.place)?,
            None => Affine2::IDENTITY,
        };
        Ok(TextureUse { texture, transform })
    }
}

fn wrap(mode: Checked<WrappingMode>, place: &str) -> Result<Wrap, Fault> {
    match mode {
        Checked::Valid(WrappingMode::Repeat) => Ok(Wrap::Repeat),
        Checked::Valid(WrappingMode::ClampToEdge) => Ok(Wrap::Clamp),
        Checked::Valid(WrappingMode::MirroredRepeat) => Ok(Wrap::Mirror),
        Checked::Invalid => {
            let message = "its sampler's wrapping is none of 10497, 33071 and 33648";
            Err(Fault::new(place, message))
        }
    }
}

fn decode(
    document: &Document,
    index: usize,
    encoding: TextureEncoding,
    wrap: [Wrap; 2],
    loading: &mut Loading,
) -> Result<Texture, Fault> {
    let place = format!("images[{index}]");
    let json = &document.root.images[index];
    let encoded = encoded(document, json, &place)?;
    let picture = image::decode(&encoded, &place, &mut loading.budget)?;
    let name = json
        .name
        .clone()
        .or_else(|| json.uri.clone().filter(|uri| !uri.starts_with("data:")));
    Ok(Texture {
        name: name.unwrap_or(place),
        width_px: picture.width_px,
        height_px: picture.height_px,
        rgba8: picture.rgba8,
        encoding,
        wrap,
    })
}

/// The bytes of the PNG or JPEG.
fn encoded(document: &Document, json: &json::Image, place: &str) -> Result<Vec<u8>, Fault> {
    if let Some(view) = json.buffer_view {
        let region = Region::of_view(&document.root, &document.buffers, view, place)?;
        return region.bytes(&document.buffers, place);
    }
    let Some(uri) = &json.uri else {
        return Err(Fault::new(place, "has neither `bufferView` nor `uri`"));
    };
    match uri::resolve(&document.folder, uri, place)? {
        Reference::Data(data) => uri::decode(data, place),
        Reference::File(path) => {
            let at =
                |fault: Fault| Fault::new(place, format!("{}: {}", path.display(), fault.message));
            check_is_file(&path).map_err(at)?;
            std::fs::read(&path).map_err(|error| at(Fault::unreadable("", &error)))
        }
    }
}

/// The transform of `KHR_texture_transform`: scaled, then turned counter-clockwise as
/// seen on the image (whose v points down), then moved.
pub(super) fn affine(transform: &TextureTransform, place: &str) -> Result<Affine2, Fault> {
    let (sin, cos) = (
        math::sin(transform.rotation.0),
        math::cos(transform.rotation.0),
    );
    let turn = Mat2::from_cols(Vec2::new(cos, -sin), Vec2::new(sin, cos));
    let scale = Mat2::from_diagonal(Vec2::from(transform.scale.0));
    let affine = Affine2::from_mat2_translation(turn * scale, Vec2::from(transform.offset.0));
    if affine.is_finite() {
        Ok(affine)
    } else {
        Err(Fault::new(place, "its KHR_texture_transform is not finite"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn counter-clockwise on an image whose v points down brings what
    /// is at the right to the top.
    #[test]
    fn rotation_is_counter_clockwise_on_the_image() {
        let transform = TextureTransform {
            rotation: gltf::json::extensions::texture::TextureTransformRotation(
                std::f32::consts::FRAC_PI_2,
            ),
            scale: gltf::json::extensions::texture::TextureTransformScale([2.0, 3.0]),
            offset: gltf::json::extensions::texture::TextureTransformOffset([0.25, 0.5]),
            ..TextureTransform::default()
        };
        let affine = affine(&transform, "p").unwrap();
        let found = affine.transform_point2(Vec2::new(1.0, 0.0));
        assert!(
            (found - Vec2::new(0.25, 0.5 - 2.0)).length() < 1e-6,
            "{found}"
        );
        let found = affine.transform_point2(Vec2::new(0.0, 1.0));
        assert!(
            (found - Vec2::new(0.25 + 3.0, 0.5)).length() < 1e-6,
            "{found}"
        );
    }
}
