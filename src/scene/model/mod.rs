//! Models from files: glTF 2.0, OBJ and PLY, as plain [`Geometry`].
//!
//! A file is read piece by piece straight into vertices, so that the peak of memory
//! is the finished geometry and not the file beside it. Whatever the bytes are, the
//! answer is a model or a [`ModelError`] that names file and place: every count is
//! checked against the file's length or the [`Limits`] before anything is allocated.

mod error;
mod gltf;
mod image;
mod limits;
mod normals;
mod obj;
mod placing;
mod plain;
mod ply;
mod report;
mod split;
mod tangents;
mod uri;

use std::fs;
use std::path::{Path, PathBuf};

use error::Fault;
pub use error::ModelError;
use limits::Budget;
pub use limits::Limits;
use report::Warnings;
pub use report::{AnimationReport, ModelReport};

use super::{Geometry, Material};
use crate::digest;

/// Which axis of the file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Up {
    /// +X.
    X,
    /// +Y, as glTF has it.
    #[default]
    Y,
    /// +Z, as most scanners and CAD programs have it.
    Z,
}

/// Which animation poses a model.
#[derive(Debug, Clone, PartialEq, Eq, serde::Deserialize)]
#[serde(untagged)]
pub enum AnimationChoice {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its name.
    Name(String),
}

/// How a model is put into a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelOptions {
    /// Metres per unit of the file.
    pub scale: f32,
    /// Which axis of the file points up.
    pub up: Up,
    /// Whether to centre the model on the vertical axis with its lowest point at y = 0.
    pub ground: bool,
    /// The animation that poses it; `None` is the pose the nodes are stored in.
    pub animation: Option<AnimationChoice>,
    /// When in that animation, seconds; held at its ends.
    pub time_s: f32,
    /// Where the file has no normals: the angle between two faces, radians, up to which
    /// they are smoothed into each other. `None` is what the format says: flat for glTF,
    /// smooth for OBJ and PLY.
    pub crease_rad: Option<f32>,
    /// Linear diffuse colour instead of that of a file without materials.
    pub albedo: Option<[f32; 3]>,
    /// Perceptual roughness instead of that of a file without materials.
    pub roughness: Option<f32>,
    /// What the model may take of the machine.
    pub limits: Limits,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self {
            scale: 1.0,
            up: Up::Y,
            ground: false,
            animation: None,
            time_s: 0.0,
            crease_rad: None,
            albedo: None,
            roughness: None,
            limits: Limits::default(),
        }
    }
}

/// A model and what is to be said about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Its surface, materials and lights, in metres with +Y up.
    pub geometry: Geometry,
    /// Size, contents and warnings.
    pub report: ModelReport,
}

/// What a format's reader collects.
struct Loading<'a> {
    options: &'a ModelOptions,
    geometry: Geometry,
    budget: Budget,
    warnings: Warnings,
    skins: usize,
    animations: Vec<AnimationReport>,
}

/// Reads a model (`.gltf`, `.glb`, `.obj`, `.ply`, `.ply.gz`).
///
/// # Errors
/// [`ModelError`] naming the file, the place in it, what is wrong and how to mend it.
pub fn load(path: &Path, options: &ModelOptions) -> Result<Model, ModelError> {
    let mut loading = Loading {
        options,
        geometry: Geometry::default(),
        budget: Budget::new(options.limits),
        warnings: Warnings::default(),
        skins: 0,
        animations: Vec::new(),
    };
    read(path, &mut loading).map_err(|fault| fault.of(path))?;
    let mut report = ModelReport::new(path.to_owned(), &loading.geometry, loading.warnings);
    report.skins = loading.skins;
    report.animations = loading.animations;
    Ok(Model {
        geometry: loading.geometry,
        report,
    })
}

fn read(path: &Path, loading: &mut Loading) -> Result<(), Fault> {
    let format = Format::of(path)?;
    check_is_file(path)?;
    if format != Format::Gltf && loading.options.animation.is_some() {
        return Err(Fault::whole(
            "an animation is asked for, but only glTF files have any; leave `animation` out",
        ));
    }
    match format {
        Format::Gltf => gltf::read(path, loading)?,
        Format::Obj => obj::read(path, loading)?,
        Format::Ply { gzip } => ply::read(path, gzip, loading)?,
    }
    placing::place(&mut loading.geometry, loading.options)
}

/// A directory, pipe or device is no model; reading some of them would never end.
fn check_is_file(path: &Path) -> Result<(), Fault> {
    let metadata = fs::metadata(path).map_err(|error| Fault::unreadable("", &error))?;
    if metadata.is_file() {
        return Ok(());
    }
    Err(Fault::whole("is not a file"))
}

/// What a file without materials is made of.
fn plain_material(options: &ModelOptions) -> Material {
    let default = Material::default();
    Material {
        albedo: options.albedo.unwrap_or(default.albedo),
        roughness: options.roughness.unwrap_or(default.roughness),
        ..default
    }
}

/// SHA-256 of everything a model is read from: the file and what it refers to, so
/// that a changed texture is a changed model.
///
/// # Errors
/// [`ModelError`] for a file that cannot be read.
pub fn sha256(path: &Path) -> Result<String, ModelError> {
    let digests = files(path)?
        .iter()
        .map(|file| {
            digest::sha256_file(file).map_err(|error| Fault::unreadable("", &error).of(file))
        })
        .collect::<Result<Vec<_>, _>>()?;
    Ok(digest::sha256_hex(digests.join("\0").as_bytes()))
}

/// The files a model is read from: itself, then those it names, in its order.
///
/// # Errors
/// [`ModelError`] where they cannot be told.
pub fn files(path: &Path) -> Result<Vec<PathBuf>, ModelError> {
    let others = || -> Result<Vec<PathBuf>, Fault> {
        let format = Format::of(path)?;
        check_is_file(path)?;
        match format {
            Format::Gltf => gltf::files(path),
            Format::Obj => obj::files(path),
            Format::Ply { .. } => Ok(Vec::new()),
        }
    };
    let mut files = vec![path.to_owned()];
    files.extend(others().map_err(|fault| fault.of(path))?);
    Ok(files)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Gltf,
    Obj,
    Ply { gzip: bool },
}

impl Format {
    fn of(path: &Path) -> Result<Self, Fault> {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().to_lowercase())
            .unwrap_or_default();
        let ends = |suffixes: &[&str]| suffixes.iter().any(|s| name.ends_with(s));
        if ends(&[".gltf", ".glb"]) {
            Ok(Self::Gltf)
        } else if ends(&[".obj"]) {
            Ok(Self::Obj)
        } else if ends(&[".ply", ".ply.gz"]) {
            Ok(Self::Ply {
                gzip: ends(&[".gz"]),
            })
        } else {
            Err(Fault::whole(
                "is no model that can be read; allowed are .gltf, .glb, .obj, .ply and .ply.gz",
            ))
        }
    }
}

#[cfg(test)]
mod tests;
