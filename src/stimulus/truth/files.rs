//! Occlusion as files: 16-bit grey PNG to look at, EXR to compute with.

use std::io::Cursor;
use std::path::Path;

use super::super::files::encode_occlusion;
use super::super::manifest::StimulusError;
use crate::reference::Estimates;
use exr::prelude::{Image, SpecificChannels, WritableImage};

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
}
