//! Lighting variants: what a variant extends is filled in, what it asks for is there.

use std::ops::Range;

use glam::Vec3;
use toml::Spanned;

use super::file::SceneFile;
use super::light_file::{
    AmbientFile, BackgroundFile, Colour, Factor, Light, LightingFile, PointFile, Stops, SunFile,
    Towards,
};
use super::{Source, point};
use crate::config::ConfigError;
use crate::scene::Environment;
use crate::scene::lighting::{Ambient, Background, Cone, Lighting, PointLight, Sun, ToneMap};

/// A variant with everything it extends filled in; `environment` is the scene's.
pub(super) fn resolve(
    file: &SceneFile,
    name: &str,
    environment: Option<&Environment>,
    source: Source<'_>,
) -> Result<Lighting, ConfigError> {
    let merged = merge_chain(file, name, source)?;
    let variant = Variant {
        name,
        environment: environment.map(|environment| {
            let change = merged.environment.as_ref();
            let turn_deg = change.and_then(|c| c.rotation_deg).map_or(0.0, |d| d.get());
            environment
                .turned(turn_deg.to_radians())
                .scaled(change.and_then(|c| c.intensity).map_or(1.0, Factor::get))
        }),
        source,
    };
    let ambient = variant.ambient(merged.ambient)?;
    let background = variant.background(merged.background)?;
    let reflections = variant.reflections(merged.reflections.as_ref())?;
    let sun = merged.sun.map(|sun| variant.sun(&sun)).transpose()?;
    let points = merged.point.unwrap_or_default();
    let points = points.iter().enumerate();
    Ok(Lighting {
        reflections,
        sun,
        points: points
            .map(|(index, light)| variant.point(index, light))
            .collect::<Result<_, _>>()?,
        model_lights: merged.model_lights.map(Factor::get),
        environment: variant.environment.filter(|_| {
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
        merged = merged.or(current);
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

/// One variant while its keys are checked.
struct Variant<'a> {
    name: &'a str,
    environment: Option<Environment>,
    source: Source<'a>,
}

impl Variant<'_> {
    fn error(&self, span: Range<usize>, key: &str, message: &str) -> ConfigError {
        self.source
            .error(span, &format!("lighting.{}.{key}", self.name), message)
    }

    fn missing(&self, key: &str) -> ConfigError {
        let field = format!("lighting.{}.{key}", self.name);
        let message = "missing, here and in what this variant extends";
        ConfigError::at(self.source.path, self.source.text, None, &field, message)
    }

    fn environment(&self, span: Range<usize>, key: &str) -> Result<&Environment, ConfigError> {
        self.environment.as_ref().ok_or_else(|| {
            let message = "asks for the environment, but the scene has no [environment]";
            self.error(span, key, message)
        })
    }

    fn ambient(&self, file: Option<Spanned<AmbientFile>>) -> Result<Ambient, ConfigError> {
        let file = file.ok_or_else(|| self.missing("ambient"))?;
        match file.get_ref() {
            AmbientFile::Constant(radiance) => Ok(Ambient::Constant(colour(radiance))),
            AmbientFile::Environment => {
                self.environment(file.span(), "ambient")?;
                Ok(Ambient::Environment)
            }
        }
    }

    fn background(&self, file: Option<Spanned<BackgroundFile>>) -> Result<Background, ConfigError> {
        let file = file.ok_or_else(|| self.missing("background"))?;
        match file.get_ref() {
            BackgroundFile::Colour(radiance) => Ok(Background::Colour(colour(radiance))),
            BackgroundFile::Environment => {
                self.environment(file.span(), "background")?;
                Ok(Background::Environment)
            }
        }
    }

    fn reflections(&self, asked: Option<&Spanned<bool>>) -> Result<bool, ConfigError> {
        match asked {
            Some(asked) if *asked.get_ref() => {
                self.environment(asked.span(), "reflections")?;
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    fn sun(&self, spanned: &Spanned<SunFile>) -> Result<Sun, ConfigError> {
        let file = spanned.get_ref();
        let towards_span = file.towards.span();
        let (towards, irradiance) = match *file.towards.get_ref() {
            Towards::Vector(vector) => (Vec3::from(vector), None),
            Towards::Sky => {
                let environment = self.environment(towards_span.clone(), "sun.towards")?;
                let sun = environment.sun().ok_or_else(|| {
                    let message = "\"sky\" needs `sky` in [environment]; with a file or six axes say where the sun \
                                   is, as [x, y, z]";
                    self.error(towards_span.clone(), "sun.towards", message)
                })?;
                (sun.towards, Some(sun.irradiance))
            }
        };
        if towards.length() < 1e-6 {
            let message = "found a vector of length 0, a direction is needed";
            return Err(self.error(towards_span, "sun.towards", message));
        }
        let irradiance = file.irradiance.as_ref().map(colour).or(irradiance);
        Ok(Sun {
            towards: towards.normalize(),
            irradiance: irradiance.ok_or_else(|| {
                let message = "missing; only with towards = \"sky\" is it known";
                self.error(spanned.span(), "sun.irradiance", message)
            })?,
            casts_shadows: file.casts_shadows,
        })
    }

    fn point(&self, index: usize, file: &PointFile) -> Result<PointLight, ConfigError> {
        let position_m = point(&file.position_m);
        let cone = file.cone.as_ref().map(|cone| {
            let error = |key: &str, message: &str| {
                self.error(cone.span(), &format!("point[{index}].cone.{key}"), message)
            };
            let cone = cone.get_ref();
            let along = point(&cone.target_m) - position_m;
            if along.length() < 1e-6 {
                return Err(error(
                    "target_m",
                    "the light shines at its own position; move the target",
                ));
            }
            let inner_deg = cone.inner_deg.map_or(0.0, |angle| angle.get());
            let outer_deg = cone.outer_deg.get();
            if inner_deg >= outer_deg {
                let message =
                    format!("found {outer_deg}, must be more than inner_deg = {inner_deg}");
                return Err(error("outer_deg", &message));
            }
            Ok(Cone {
                along: along.normalize(),
                inner_rad: inner_deg.to_radians(),
                outer_rad: outer_deg.to_radians(),
            })
        });
        Ok(PointLight {
            position_m,
            intensity: colour(&file.intensity),
            cone: cone.transpose()?,
        })
    }
}

pub(super) fn colour(components: &Colour) -> Vec3 {
    Vec3::from(components.map(Light::get))
}
