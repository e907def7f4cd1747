//! Lighting variants: what a variant extends is filled in, what it asks for is there.

use glam::Vec3;

use super::file::{
    AmbientFile, BackgroundFile, Colour, EnvironmentFile, Light, LightFactor, LightingFile,
    SceneFile, Stops, SunFile,
};
use super::{Source, point};
use crate::config::ConfigError;
use crate::scene::Environment;
use crate::scene::lighting::{Ambient, Background, Lighting, Sun, ToneMap};

/// A variant with everything it extends filled in.
pub(super) fn resolve(
    file: &SceneFile,
    name: &str,
    source: Source<'_>,
) -> Result<Lighting, ConfigError> {
    let merged = merge_chain(file, name, source)?;
    let field = |key: &str| format!("lighting.{name}.{key}");
    let missing = |key: &str| {
        let message = "missing, here and in what this variant extends";
        ConfigError::at(source.path, source.text, None, &field(key), message)
    };
    let environment = file.environment.as_ref().map(environment);
    let needs_environment = |span: std::ops::Range<usize>, key: &str| match &environment {
        Some(_) => Ok(()),
        None => Err(source.error(
            span,
            &field(key),
            "asks for the environment, but the scene has no [environment]",
        )),
    };
    let ambient = merged.ambient.ok_or_else(|| missing("ambient"))?;
    let background = merged.background.ok_or_else(|| missing("background"))?;
    let ambient = match ambient.get_ref() {
        AmbientFile::Constant(radiance) => Ambient::Constant(colour(radiance)),
        AmbientFile::Environment => {
            needs_environment(ambient.span(), "ambient")?;
            Ambient::Environment
        }
    };
    let background = match background.get_ref() {
        BackgroundFile::Colour(radiance) => Background::Colour(colour(radiance)),
        BackgroundFile::Environment => {
            needs_environment(background.span(), "background")?;
            Background::Environment
        }
    };
    let reflections = match &merged.reflections {
        Some(asked) if *asked.get_ref() => {
            needs_environment(asked.span(), "reflections")?;
            true
        }
        _ => false,
    };
    Ok(Lighting {
        reflections,
        sun: merged
            .sun
            .map(|file| sun(&file, &field("sun"), source))
            .transpose()?,
        points: Vec::new(),
        model_lights: merged.model_lights.map(LightFactor::get),
        environment: environment.filter(|_| {
            reflections || ambient == Ambient::Environment || background == Background::Environment
        }),
        ambient,
        background,
        exposure_ev: merged.exposure_ev.map_or(0.0, Stops::get),
        tone_map: merged.tone_map.map_or(ToneMap::None, ToneMap::from),
    })
}

fn merge_chain(
    file: &SceneFile,
    name: &str,
    source: Source<'_>,
) -> Result<LightingFile, ConfigError> {
    let mut merged = LightingFile::default();
    let mut visited = vec![name];
    let mut current = &file.lighting[name];
    loop {
        merged.ambient = merged.ambient.or_else(|| current.ambient.clone());
        merged.background = merged.background.or_else(|| current.background.clone());
        merged.reflections = merged.reflections.or_else(|| current.reflections.clone());
        merged.sun = merged.sun.or_else(|| current.sun.clone());
        merged.model_lights = merged.model_lights.or(current.model_lights);
        merged.exposure_ev = merged.exposure_ev.or(current.exposure_ev);
        merged.tone_map = merged.tone_map.or(current.tone_map);
        let Some(parent) = &current.extends else {
            return Ok(merged);
        };
        let field = format!("lighting.{}.extends", visited.last().unwrap_or(&name));
        if visited.contains(&parent.get_ref().as_str()) {
            let message = format!(
                "\"{}\" extends itself, directly or by others",
                parent.get_ref()
            );
            return Err(source.error(parent.span(), &field, &message));
        }
        current = file.lighting.get(parent.get_ref()).ok_or_else(|| {
            let message = format!("there is no lighting variant \"{}\"", parent.get_ref());
            source.error(parent.span(), &field, &message)
        })?;
        visited.push(parent.get_ref());
    }
}

fn sun(file: &SunFile, field: &str, source: Source<'_>) -> Result<Sun, ConfigError> {
    let towards = point(file.towards.get_ref());
    if towards.length() < 1e-6 {
        let message = "found a vector of length 0, a direction is needed";
        return Err(source.error(file.towards.span(), &format!("{field}.towards"), message));
    }
    Ok(Sun {
        towards: towards.normalize(),
        irradiance: colour(&file.irradiance),
        casts_shadows: file.casts_shadows,
    })
}

fn environment(file: &EnvironmentFile) -> Environment {
    Environment {
        axes: [
            &file.right,
            &file.left,
            &file.up,
            &file.down,
            &file.back,
            &file.front,
        ]
        .map(colour),
    }
}

fn colour(components: &Colour) -> Vec3 {
    Vec3::from(components.map(Light::get))
}
