//! Occlusion as files: 16-bit grey PNG to look at, EXR to compute with.

use std::io::Cursor;
use std::path::Path;

use super::super::files::{encode_occlusion, write_whole};
use super::super::manifest::StimulusError;
use crate::reference::Estimates;
use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, Image, ReadChannels, ReadLayers, SpecificChannels, Vec2,
    WritableImage,
};

/// The occlusion as a 16-bit grey PNG: 0 closed, 65535 open, linear.
pub(super) fn png(
    path: &Path,
    estimates: &Estimates,
    size_px: (u32, u32),
) -> Result<Vec<u8>, StimulusError> {
    encode_occlusion(path, &estimates.occlusion, size_px)
}

/// The occlusion and its standard error as 32-bit float channels `occlusion` and
/// `standard_error` of an EXR.
pub(super) fn exr(
    path: &Path,
    estimates: &Estimates,
    (width, height): (u32, u32),
) -> Result<Vec<u8>, StimulusError> {
    let width = width as usize;
    let channels = SpecificChannels::build()
        .with_channel("occlusion")
        .with_channel("standard_error")
        .with_pixel_fn(|at| {
            let pixel = at.y() * width + at.x();
            (estimates.occlusion[pixel], estimates.standard_error[pixel])
        });
    let mut bytes = Cursor::new(Vec::new());
    Image::from_channels((width, height as usize), channels)
        .write()
        .to_buffered(&mut bytes)
        .map_err(|error| not_encoded(path, &error))?;
    Ok(bytes.into_inner())
}

/// Writes what was found, whole or not at all.
///
/// # Errors
/// [`StimulusError`] of the file.
pub fn write_exr(
    path: &Path,
    estimates: &Estimates,
    size_px: (u32, u32),
) -> Result<(), StimulusError> {
    write_whole(path, &exr(path, estimates, size_px)?)
}

/// Writes named channels of 32-bit floats as an EXR, whole or not at all.
///
/// # Errors
/// [`StimulusError`] of the file, also where a channel does not have a value a pixel.
pub fn write_channels(
    path: &Path,
    channels: Vec<(String, Vec<f32>)>,
    (width, height): (u32, u32),
) -> Result<(), StimulusError> {
    let size = Vec2(width as usize, height as usize);
    if let Some((name, _)) = (channels.iter()).find(|(_, values)| values.len() != size.area()) {
        return Err(not_encoded(path, &format!("\"{name}\" is of another size")));
    }
    let channels = (channels.into_iter())
        .map(|(name, values)| AnyChannel::new(name.as_str(), FlatSamples::F32(values)));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_channels(size, AnyChannels::sort(channels.collect()))
        .write()
        .to_buffered(&mut bytes)
        .map_err(|error| not_encoded(path, &error))?;
    write_whole(path, &bytes.into_inner())
}

/// What [`write_exr`] has written, without its count of rays; `None` where there is no such file
/// of this size.
#[must_use]
pub fn read_exr(path: &Path, (width, height): (u32, u32)) -> Option<Estimates> {
    let (width, height) = (width as usize, height as usize);
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .ok()?;
    let layer = image.layer_data;
    if (layer.size.x(), layer.size.y()) != (width, height) {
        return None;
    }
    let channel = |name: &str| {
        let mut channels = layer.channel_data.list.iter();
        let channel = channels.find(|channel| channel.name == *name)?;
        Some(channel.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let (occlusion, standard_error) = (channel("occlusion")?, channel("standard_error")?);
    Some(Estimates {
        // Where there is no surface there is no error either, and nowhere else.
        surfaces: standard_error.iter().filter(|error| **error > 0.0).count() as u64,
        occlusion,
        standard_error,
        rays: 0,
    })
}

fn not_encoded(path: &Path, error: &dyn std::fmt::Display) -> StimulusError {
    StimulusError::Image {
        path: path.to_owned(),
        message: format!("cannot be encoded: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels, ReadLayers};

    use super::*;

    #[test]
    fn both_files_hold_what_was_found() {
        let estimates = Estimates {
            occlusion: vec![0.0, 0.25, 0.5, 1.0, 0.75, 0.125],
            standard_error: vec![0.0, 0.001, 0.002, 0.0, 0.5, 0.25],
            rays: 1,
            surfaces: 1,
        };
        let path = Path::new("x");
        let grey = image::load_from_memory(&png(path, &estimates, (3, 2)).unwrap()).unwrap();
        assert_eq!(grey.color(), image::ColorType::L16);
        assert_eq!(grey.to_luma16().as_raw()[1], 16384);
        let bytes = exr(path, &estimates, (3, 2)).unwrap();
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap();
        let channels = &image.layer_data.channel_data.list;
        let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["occlusion", "standard_error"]);
        let values: Vec<f32> = channels[1].sample_data.values_as_f32().collect();
        assert_eq!(values, estimates.standard_error);
    }

    #[test]
    fn named_channels_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.exr");
        let estimates = Estimates {
            occlusion: vec![0.0, 0.25],
            standard_error: vec![0.5, 0.125],
            rays: 0,
            surfaces: 2,
        };
        let channels = [
            ("standard_error", &estimates.standard_error),
            ("occlusion", &estimates.occlusion),
            ("albedo.R", &vec![0.5, 1.0]),
        ];
        let channels = channels.map(|(name, values)| (name.to_owned(), values.clone()));
        write_channels(&path, channels.to_vec(), (2, 1)).unwrap();
        assert_eq!(read_exr(&path, (2, 1)), Some(estimates));
        assert!(write_channels(&path, channels.to_vec(), (2, 2)).is_err());
    }
}
