//! Where heights come from: a file, or a map that is made.

use std::path::Path;

use super::procedural;

/// Heights of 0 to 1, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width · height` of them.
    pub heights: Vec<f32>,
}

/// A height map that cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum HeightMapError {
    /// The file.
    #[error("{path} cannot be read as a height map: {message}")]
    File {
        /// The file.
        path: String,
        /// What is wrong.
        message: String,
    },
    /// Neither a file nor a name.
    #[error("there is no file {wanted}, and no height map of that name; there are {known}")]
    NoSuchMap {
        /// What was asked for.
        wanted: String,
        /// The names there are.
        known: String,
    },
}

impl HeightMap {
    /// The map of that name, `size` × `size`, or the file: an 8- or 16-bit image, whose
    /// brightness is the height.
    ///
    /// # Errors
    /// [`HeightMapError`].
    pub fn open(name: &str, size: usize, seed: u64) -> Result<Self, HeightMapError> {
        if let Some(map) = procedural::find(name) {
            return Ok(Self {
                width: size,
                height: size,
                heights: (map.heights)(size, seed),
            });
        }
        let path = Path::new(name);
        if !path.exists() {
            let known: Vec<&str> = procedural::MAPS.iter().map(|map| map.name).collect();
            return Err(HeightMapError::NoSuchMap {
                wanted: name.to_owned(),
                known: known.join(", "),
            });
        }
        Self::load(path)
    }

    fn load(path: &Path) -> Result<Self, HeightMapError> {
        let said = |message: String| HeightMapError::File {
            path: path.display().to_string(),
            message,
        };
        let picture = image::open(path).map_err(|error| said(error.to_string()))?;
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let heights = match picture {
            // Heights are numbers and no light: a 16-bit grey is taken as it is.
            image::DynamicImage::ImageLuma8(_) | image::DynamicImage::ImageLuma16(_) => picture
                .into_luma16()
                .into_raw()
                .into_iter()
                .map(|level| f32::from(level) / 65535.0)
                .collect(),
            other => {
                let rgb = other.into_rgb32f().into_raw();
                let pixels = rgb.as_chunks::<3>().0.iter();
                pixels
                    .map(|[red, green, blue]| (red + green + blue) / 3.0)
                    .collect()
            }
        };
        Ok(Self {
            width,
            height,
            heights,
        })
    }

    /// Whether all heights are one.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.heights.windows(2).all(|two| two[0] == two[1])
    }
}
