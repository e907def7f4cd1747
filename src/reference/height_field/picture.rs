//! Pictures as numbers: what heights and albedos are read from.

use std::path::Path;

use image::{DynamicImage, ImageFormat, ImageReader, Limits};

use crate::scene::srgb;

/// Planes of numbers, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Picture {
    pub width: usize,
    pub height: usize,
    /// One plane of grey, or red, green and blue.
    pub planes: Vec<Vec<f32>>,
    /// Whether the numbers are light, rather than levels of a display.
    pub is_linear: bool,
}

/// A picture that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path} cannot be read: {message}")]
pub struct PictureError {
    /// The file.
    pub path: String,
    /// What is wrong, what is allowed.
    pub message: String,
}

impl PictureError {
    pub(super) fn new(path: &Path, message: impl ToString) -> Self {
        Self {
            path: path.display().to_string(),
            message: message.to_string(),
        }
    }
}

/// Columns and rows of a picture, from its first bytes.
pub(super) fn size_of(path: &Path) -> Result<(usize, usize), PictureError> {
    let reader = open(path)?;
    if reader.format() == Some(ImageFormat::OpenExr) {
        // Any channels will do, where the image crate wants colours.
        let meta = exr::meta::MetaData::read_from_file(path, false)
            .map_err(|error| PictureError::new(path, error))?;
        let layer = meta.headers.first();
        let layer = layer.ok_or_else(|| PictureError::new(path, "it has no layer"))?;
        return Ok((layer.layer_size.x(), layer.layer_size.y()));
    }
    let (width, height) = reader
        .into_dimensions()
        .map_err(|error| PictureError::new(path, error))?;
    Ok((width as usize, height as usize))
}

fn open(path: &Path) -> Result<ImageReader<std::io::BufReader<std::fs::File>>, PictureError> {
    ImageReader::open(path)
        .and_then(ImageReader::with_guessed_format)
        .map_err(|error| PictureError::new(path, error))
}

impl Picture {
    /// Reads PNG and JPEG of 8 or 16 bits, Radiance `.hdr`, and OpenEXR with a grey channel or with
    /// R, G and B. Whoever calls has asked for the size before and allows it.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        let mut reader = open(path)?;
        let picture = match reader.format() {
            Some(ImageFormat::OpenExr) => Self::of_exr(path)?,
            _ => {
                reader.limits(Limits::no_limits());
                Self::of_image(
                    reader
                        .decode()
                        .map_err(|error| PictureError::new(path, error))?,
                )
            }
        };
        picture.check(path)
    }

    fn of_image(image: DynamicImage) -> Self {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let is_linear = matches!(
            image,
            DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)
        );
        let planes = if image.color().has_color() {
            let rgb = image.into_rgb32f().into_raw();
            let pixels = rgb.as_chunks::<3>().0;
            (0..3)
                .map(|channel| pixels.iter().map(|pixel| pixel[channel]).collect())
                .collect()
        } else {
            // All 16 bits of a 16-bit grey.
            let grey = image.into_luma16().into_raw();
            vec![
                grey.into_iter()
                    .map(|level| f32::from(level) / 65535.0)
                    .collect(),
            ]
        };
        Self {
            width,
            height,
            planes,
            is_linear,
        }
    }

    fn of_exr(path: &Path) -> Result<Self, PictureError> {
        let image = exr::prelude::read_first_flat_layer_from_file(path)
            .map_err(|error| PictureError::new(path, error))?;
        let layer = image.layer_data;
        let channels = &layer.channel_data.list;
        let plane = |name: &str| {
            let mut named = channels.iter();
            let channel = named.find(|channel| channel.name == *name)?;
            Some(channel.sample_data.values_as_f32().collect::<Vec<f32>>())
        };
        let colours: Option<Vec<_>> = ["R", "G", "B"].into_iter().map(plane).collect();
        let grey = || {
            ["Y", "V", "Z", "height", "displacement"]
                .into_iter()
                .find_map(plane)
        };
        let only = || match channels.as_slice() {
            [channel] => Some(channel.sample_data.values_as_f32().collect()),
            _ => None,
        };
        let planes = colours.or_else(|| grey().or_else(only).map(|plane| vec![plane]));
        let Some(planes) = planes else {
            let found: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
            let message = format!(
                "its channels are {}; R, G and B are needed, or one grey channel such as Y",
                found.join(", ")
            );
            return Err(PictureError::new(path, message));
        };
        Ok(Self {
            width: layer.size.x(),
            height: layer.size.y(),
            planes,
            is_linear: true,
        })
    }

    /// Refuses what is no number: nothing can be said of the light there.
    fn check(self, path: &Path) -> Result<Self, PictureError> {
        for plane in &self.planes {
            if let Some(at) = plane.iter().position(|value| !value.is_finite()) {
                let message = format!(
                    "column {}, row {} is {}; every pixel must be a finite number: paint over it in an image editor",
                    at % self.width,
                    at / self.width,
                    plane[at]
                );
                return Err(PictureError::new(path, message));
            }
        }
        Ok(self)
    }

    /// The mean of the planes: a height. Levels are taken as the numbers they are.
    pub fn into_grey(self) -> Vec<f32> {
        let count = self.planes.len() as f32;
        let mut planes = self.planes.into_iter();
        let first = planes.next().unwrap_or_default();
        let mut sum = planes.fold(first, |mut sum, plane| {
            for (sum, value) in sum.iter_mut().zip(plane) {
                *sum += value;
            }
            sum
        });
        for value in &mut sum {
            *value /= count;
        }
        sum
    }

    /// Red, green and blue as linear light.
    pub fn into_light(self) -> [Vec<f32>; 3] {
        let is_linear = self.is_linear;
        let mut planes: Vec<Vec<f32>> = self.planes;
        if !is_linear {
            for value in planes.iter_mut().flatten() {
                *value = srgb::decode(*value);
            }
        }
        let mut planes = planes.into_iter();
        let red = planes.next().unwrap_or_default();
        match (planes.next(), planes.next()) {
            (Some(green), Some(blue)) => [red, green, blue],
            _ => [red.clone(), red.clone(), red],
        }
    }
}
