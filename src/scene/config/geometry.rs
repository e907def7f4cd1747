//! `[geometry]`: a procedural scene, or a model from a file.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::Source;
use crate::config::ConfigError;
use crate::config::quantity::{self, Unit};
use crate::scene::GeometrySource;
use crate::scene::model::{AnimationChoice, Limits, ModelOptions, Up};
use crate::scene::procedural::{self, Generator};

quantity::quantity! {
    /// Metres per unit of a model's file.
    Scale: f32, 0.000_001, 1_000_000.0, "m per unit"
}
quantity::quantity! {
    /// A moment of an animation.
    Seconds: f32, 0.0, 100_000.0, "s"
}
quantity::quantity! {
    /// An angle between two faces.
    Crease: f32, 0.0, 180.0, "degrees"
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GeometryFile {
    generator: Option<Spanned<String>>,
    file: Option<Spanned<PathBuf>>,
    scale: Option<Spanned<Scale>>,
    up: Option<Spanned<Up>>,
    ground: Option<Spanned<bool>>,
    animation: Option<Spanned<AnimationChoice>>,
    time_s: Option<Spanned<Seconds>>,
    crease_deg: Option<Spanned<Crease>>,
    albedo: Option<Spanned<[Unit; 3]>>,
    roughness: Option<Spanned<Unit>>,
}

/// What the table asks for; `seed` is the scene's.
pub(super) fn resolve(
    file: GeometryFile,
    seed: u64,
    source: Source<'_>,
) -> Result<GeometrySource, ConfigError> {
    match (&file.generator, &file.file) {
        (Some(generator), None) => {
            refuse_model_keys(&file, source)?;
            Ok(GeometrySource::Generated {
                generator: find_generator(generator, source)?,
                seed,
            })
        }
        (None, Some(model)) => {
            let path = source
                .path
                .parent()
                .unwrap_or(Path::new(""))
                .join(model.get_ref());
            if !path.is_file() {
                let message = format!("there is no file {}", path.display());
                return Err(source.error(model.span(), "geometry.file", &message));
            }
            Ok(GeometrySource::File {
                path,
                options: options(file),
            })
        }
        (Some(_), Some(model)) => {
            let message = "found `file` and `generator`; allowed is one of them";
            Err(source.error(model.span(), "geometry.file", message))
        }
        (None, None) => {
            let message = "found neither `generator` nor `file`; one of them is needed";
            Err(ConfigError::at(
                source.path,
                source.text,
                None,
                "geometry",
                message,
            ))
        }
    }
}

fn options(file: GeometryFile) -> ModelOptions {
    let default = ModelOptions::default();
    ModelOptions {
        scale: file.scale.map_or(default.scale, |s| s.get_ref().get()),
        up: file.up.map_or(default.up, Spanned::into_inner),
        ground: file.ground.map_or(default.ground, Spanned::into_inner),
        animation: file.animation.map(Spanned::into_inner),
        time_s: file.time_s.map_or(default.time_s, |t| t.get_ref().get()),
        crease_rad: file.crease_deg.map(|c| c.get_ref().get().to_radians()),
        albedo: file.albedo.map(|a| a.into_inner().map(Unit::get)),
        roughness: file.roughness.map(|r| r.get_ref().get()),
        limits: Limits::default(),
    }
}

/// A key that would do nothing is a mistake.
fn refuse_model_keys(file: &GeometryFile, source: Source<'_>) -> Result<(), ConfigError> {
    let spans = [
        ("scale", file.scale.as_ref().map(Spanned::span)),
        ("up", file.up.as_ref().map(Spanned::span)),
        ("ground", file.ground.as_ref().map(Spanned::span)),
        ("animation", file.animation.as_ref().map(Spanned::span)),
        ("time_s", file.time_s.as_ref().map(Spanned::span)),
        ("crease_deg", file.crease_deg.as_ref().map(Spanned::span)),
        ("albedo", file.albedo.as_ref().map(Spanned::span)),
        ("roughness", file.roughness.as_ref().map(Spanned::span)),
    ];
    for (key, span) in spans {
        if let Some(span) = span {
            let message = "is for a model from a `file`, not for a generator; leave it out";
            return Err(source.error(span, &format!("geometry.{key}"), message));
        }
    }
    Ok(())
}

fn find_generator(
    name: &Spanned<String>,
    source: Source<'_>,
) -> Result<&'static Generator, ConfigError> {
    procedural::find(name.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = procedural::GENERATORS.iter().map(|g| g.name).collect();
        source.error(
            name.span(),
            "geometry.generator",
            &format!(
                "found \"{}\", allowed are: {}",
                name.get_ref(),
                known.join(", ")
            ),
        )
    })
}
