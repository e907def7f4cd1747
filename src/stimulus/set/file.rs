//! A set as it is written: the tables and their keys, each value in its range.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;
use serde::de::{Error as _, MapAccess, Visitor};
use toml::Spanned;

use crate::config::{ParameterValue, quantity};
use crate::render::Precision;
use crate::scene::config::{Stops, ToneMapFile};
use crate::stimulus::loaded::ColourSpace;

quantity::quantity! {
    /// Width or height of an image.
    Pixels: u32, 1, 8192, "px"
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SetFile {
    pub id: Spanned<String>,
    pub title: String,
    pub seed: Option<u64>,
    pub width_px: Option<Pixels>,
    pub height_px: Option<Pixels>,
    #[serde(default)]
    pub precision: Precision,
    pub condition: Vec<ConditionFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConditionFile {
    pub id: Spanned<String>,
    /// A scene config's path, or for images made elsewhere a name.
    pub scene: Spanned<String>,
    pub lighting: Option<Spanned<String>>,
    pub validity: Option<String>,
    #[serde(default)]
    pub hypothesis: String,
    pub first: Spanned<ImageFile>,
    pub second: Spanned<ImageFile>,
}

/// How one image of a condition comes to be.
#[derive(Debug)]
pub(super) enum ImageFile {
    Rendered(TechniqueFile),
    Loaded(LoadedFile),
}

/// `"blizzard24"`, or `{ technique = "blizzard24", label = "blizzard24-wide", radius_m = 2 }`.
#[derive(Debug)]
pub(super) struct TechniqueFile {
    pub technique: String,
    pub label: Option<String>,
    pub parameters: BTreeMap<String, Spanned<ParameterValue>>,
}

/// `{ file = "hall.png", technique = "path-traced" }`, with what is to be known of it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LoadedFile {
    pub file: Spanned<PathBuf>,
    /// The label in trial rows; any name.
    pub technique: String,
    pub colour_space: Option<ColourSpace>,
    pub exposure_ev: Option<Stops>,
    pub tone_map: Option<ToneMapFile>,
    #[serde(default)]
    pub metadata: BTreeMap<String, String>,
}

impl<'de> Deserialize<'de> for ImageFile {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ImageVisitor)
    }
}

struct ImageVisitor;

/// The keys of both tables, since `file` may come after the others.
#[derive(Default)]
struct Keys {
    technique: Option<String>,
    label: Option<String>,
    parameters: BTreeMap<String, Spanned<ParameterValue>>,
    file: Option<Spanned<PathBuf>>,
    colour_space: Option<ColourSpace>,
    exposure_ev: Option<Stops>,
    tone_map: Option<ToneMapFile>,
    metadata: Option<BTreeMap<String, String>>,
}

impl<'de> Visitor<'de> for ImageVisitor {
    type Value = ImageFile;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(
            "a technique such as \"blizzard24\", a table with `technique` and parameters, \
             or a table with `file` and `technique` for an image made elsewhere",
        )
    }

    fn visit_str<E>(self, label: &str) -> Result<ImageFile, E> {
        Ok(ImageFile::Rendered(TechniqueFile {
            technique: label.to_owned(),
            label: None,
            parameters: BTreeMap::new(),
        }))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ImageFile, A::Error> {
        let mut keys = Keys::default();
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "technique" => keys.technique = Some(map.next_value()?),
                "label" => keys.label = Some(map.next_value()?),
                "file" => keys.file = Some(map.next_value()?),
                "colour_space" => keys.colour_space = Some(map.next_value()?),
                "exposure_ev" => keys.exposure_ev = Some(map.next_value()?),
                "tone_map" => keys.tone_map = Some(map.next_value()?),
                "metadata" => keys.metadata = Some(map.next_value()?),
                _ => {
                    keys.parameters.insert(key, map.next_value()?);
                }
            }
        }
        keys.sort().map_err(A::Error::custom)
    }
}

impl Keys {
    fn sort(self) -> Result<ImageFile, String> {
        let technique = self.technique.ok_or("missing field `technique`")?;
        let Some(file) = self.file else {
            let is_loaded = self.colour_space.is_some()
                || self.exposure_ev.is_some()
                || self.tone_map.is_some()
                || self.metadata.is_some();
            return if is_loaded {
                Err(String::from(
                    "colour_space, exposure_ev, tone_map and metadata belong to an image made elsewhere: name its `file`, or leave them out",
                ))
            } else {
                Ok(ImageFile::Rendered(TechniqueFile {
                    technique,
                    label: self.label,
                    parameters: self.parameters,
                }))
            };
        };
        let unknown = self.parameters.keys().map(String::as_str);
        if let Some(unknown) = unknown.chain(self.label.as_ref().map(|_| "label")).next() {
            return Err(format!(
                "unknown field `{unknown}` for an image made elsewhere; allowed are file, technique (its label), colour_space, \
                 exposure_ev, tone_map, and anything else as text under metadata"
            ));
        }
        Ok(ImageFile::Loaded(LoadedFile {
            file,
            technique,
            colour_space: self.colour_space,
            exposure_ev: self.exposure_ev,
            tone_map: self.tone_map,
            metadata: self.metadata.unwrap_or_default(),
        }))
    }
}
