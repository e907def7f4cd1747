//! Where heights and albedos come from: a file, or a map that is made.

use std::path::{Path, PathBuf};

use super::picture::{Picture, PictureError, size_of};
use super::procedural::{self, Map};

/// A height map that is named, not yet read or made.
#[derive(Debug, Clone)]
pub enum HeightSource {
    /// Made, as many texels on a side as said.
    Made(&'static Map, usize),
    /// Read.
    File(PathBuf),
}

/// Heights of 0 to 1, the lowest and the highest, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width · height` of them.
    pub heights: Vec<f32>,
}

/// A map that cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MapError {
    /// The file.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// Neither a file nor a name.
    #[error("there is no file {wanted}, and no height map of that name; there are {known}")]
    NoSuchMap {
        /// What was asked for.
        wanted: String,
        /// The names there are.
        known: String,
    },
    /// Albedos of another size.
    #[error(
        "{path} has {found} pixels, the height map {wanted}; scale one of them, so that each height has its colour"
    )]
    Size {
        /// The file of the albedos.
        path: String,
        /// Its size.
        found: String,
        /// The heights' size.
        wanted: String,
    },
    /// An albedo that no surface has.
    #[error(
        "{path}: the albedo at column {x}, row {y} is {found}; allowed is 0 to 1, the share of light that is sent back"
    )]
    Albedo {
        /// The file.
        path: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// What is there.
        found: String,
    },
}

impl HeightSource {
    /// The map of that name, `size` × `size`, or the file.
    ///
    /// # Errors
    /// [`MapError::NoSuchMap`] with the names there are.
    pub fn named(name: &str, size: usize) -> Result<Self, MapError> {
        if let Some(map) = procedural::find(name) {
            return Ok(Self::Made(map, size));
        }
        let path = Path::new(name);
        if path.is_file() {
            return Ok(Self::File(path.to_owned()));
        }
        let known: Vec<&str> = procedural::MAPS.iter().map(|map| map.name).collect();
        Err(MapError::NoSuchMap {
            wanted: name.to_owned(),
            known: known.join(", "),
        })
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Made(map, _) => map.name.to_owned(),
            Self::File(path) => path.file_stem().map_or_else(
                || String::from("map"),
                |stem| stem.to_string_lossy().into_owned(),
            ),
        }
    }

    /// Columns and rows, before anything is made or read.
    ///
    /// # Errors
    /// [`MapError`] of the file.
    pub fn size_px(&self) -> Result<(usize, usize), MapError> {
        match self {
            Self::Made(_, size) => Ok((*size, *size)),
            Self::File(path) => Ok(size_of(path)?),
        }
    }

    /// Makes or reads the heights. A file's are its brightness, or its grey channel, brought to 0 to 1.
    ///
    /// # Errors
    /// [`MapError`] of the file.
    pub fn heights(&self, seed: u64) -> Result<HeightMap, MapError> {
        match self {
            Self::Made(map, size) => Ok(HeightMap {
                width: *size,
                height: *size,
                heights: (map.heights)(*size, seed),
            }),
            Self::File(path) => {
                let picture = Picture::read(path)?;
                Ok(HeightMap {
                    width: picture.width,
                    height: picture.height,
                    heights: procedural::normalised(picture.into_grey()),
                })
            }
        }
    }
}

impl HeightMap {
    /// Whether all heights are one.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.heights.windows(2).all(|two| two[0] == two[1])
    }
}

/// The albedos of a map's texels from a picture, linear red, green and blue.
///
/// # Errors
/// [`MapError`] of the file, of another size than `size_px`, and of an albedo outside 0 to 1.
pub fn albedo_map(path: &Path, size_px: (usize, usize)) -> Result<[Vec<f32>; 3], MapError> {
    let found = size_of(path)?;
    let name = path.display().to_string();
    if found != size_px {
        let said = |(width, height): (usize, usize)| format!("{width}×{height}");
        return Err(MapError::Size {
            path: name,
            found: said(found),
            wanted: said(size_px),
        });
    }
    let planes = Picture::read(path)?.into_light();
    for plane in &planes {
        if let Some(at) = plane.iter().position(|rho| !(0.0..=1.0).contains(rho)) {
            return Err(MapError::Albedo {
                path: name,
                x: at % size_px.0,
                y: at / size_px.0,
                found: plane[at].to_string(),
            });
        }
    }
    Ok(planes)
}
