//! `[environment]`: a file, a sky, or six axes.

use glam::Vec3;
use toml::Spanned;

use super::Source;
use super::light_file::{EnvironmentFile, Factor, SkyFile};
use super::lighting::colour;
use crate::config::ConfigError;
use crate::config::quantity::Unit;
use crate::scene::environment::{self, Environment, Sky};

/// The environment that a scene config describes. A file is read here, so that a config whose file is
/// missing or damaged fails where its line is known; all else waits until it is used.
pub(super) fn environment(
    spanned: &Spanned<EnvironmentFile>,
    source: Source<'_>,
) -> Result<Environment, ConfigError> {
    let file = spanned.get_ref();
    let error = |message: &str| source.error(spanned.span(), "environment", message);
    let axes = [
        ("right", &file.right),
        ("left", &file.left),
        ("up", &file.up),
        ("down", &file.down),
        ("back", &file.back),
        ("front", &file.front),
    ];
    let said: Vec<&str> = axes
        .iter()
        .filter(|(_, axis)| axis.is_some())
        .map(|(name, _)| *name)
        .collect();
    let kinds = [file.file.is_some(), file.sky.is_some(), !said.is_empty()];
    if kinds.iter().filter(|&&kind| kind).count() != 1 {
        return Err(error(
            "say exactly one of: `file`, `sky`, or the six axes `right`, `left`, `up`, `down`, `front`, `back`",
        ));
    }
    let made = if let Some(path) = &file.file {
        from_file(path, source)?
    } else if let Some(sky) = &file.sky {
        Environment::sky(self::sky(sky))
    } else {
        let missing: Vec<&str> = axes
            .iter()
            .filter(|(_, axis)| axis.is_none())
            .map(|(name, _)| *name)
            .collect();
        if !missing.is_empty() {
            return Err(error(&format!(
                "of the six axes, {} is missing",
                missing.join(", ")
            )));
        }
        Environment::from_axes(axes.map(|(_, axis)| axis.as_ref().map_or(Vec3::ZERO, colour)))
    };
    let rotation_deg = file.rotation_deg.map_or(0.0, |angle| angle.get());
    Ok(made
        .turned(rotation_deg.to_radians())
        .scaled(file.intensity.map_or(1.0, Factor::get)))
}

fn from_file(
    path: &Spanned<std::path::PathBuf>,
    source: Source<'_>,
) -> Result<Environment, ConfigError> {
    let folder = source.path.parent().unwrap_or(source.path);
    let full = folder.join(path.get_ref());
    environment::file::load(&full)
        .map(Environment::from_file)
        .map_err(|error| {
            let message = format!("{} {error}", full.display());
            source.error(path.span(), "environment.file", &message)
        })
}

fn sky(file: &SkyFile) -> Sky {
    let default = Sky::default();
    Sky {
        sun_elevation_rad: file.sun_elevation_deg.get().to_radians(),
        sun_azimuth_rad: file.sun_azimuth_deg.get().to_radians(),
        turbidity: file.turbidity.map_or(default.turbidity, |t| t.get()),
        ground: file
            .ground
            .map_or(default.ground, |albedo| Vec3::from(albedo.map(Unit::get))),
        clouds: file.clouds.map_or(default.clouds, Unit::get),
        seed: file.seed.unwrap_or(default.seed),
    }
}
