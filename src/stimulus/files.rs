//! Writing files so that nobody ever sees half of one: to a neighbour first, then renamed.

use std::io::Write;
use std::path::Path;

use image::ImageEncoder;

use super::manifest::{Picture, StimulusError};

/// A picture as the bytes of a PNG: 8-bit RGB, the same bytes for the same picture.
///
/// # Errors
/// [`StimulusError::Image`] if the picture does not have the pixels it says.
pub fn encode_png(path: &Path, picture: &Picture) -> Result<Vec<u8>, StimulusError> {
    let rgb: Vec<u8> = picture
        .rgba8
        .chunks_exact(4)
        .flat_map(|p| [p[0], p[1], p[2]])
        .collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(
            &rgb,
            picture.width_px,
            picture.height_px,
            image::ExtendedColorType::Rgb8,
        )
        .map_err(|error| StimulusError::Image {
            path: path.to_owned(),
            message: format!("cannot be encoded: {error}"),
        })?;
    Ok(bytes)
}

/// Occlusion as the bytes of a 16-bit grey PNG, linear: 0 closed, 65535 open.
///
/// # Errors
/// [`StimulusError::Image`] if there are not as many values as the size says.
pub fn encode_occlusion(
    path: &Path,
    occlusion: &[f32],
    (width_px, height_px): (u32, u32),
) -> Result<Vec<u8>, StimulusError> {
    let grey: Vec<u8> = occlusion
        .iter()
        .flat_map(|value| ((value.clamp(0.0, 1.0) * 65535.0).round() as u16).to_ne_bytes())
        .collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(&grey, width_px, height_px, image::ExtendedColorType::L16)
        .map_err(|error| StimulusError::Image {
            path: path.to_owned(),
            message: format!("cannot be encoded: {error}"),
        })?;
    Ok(bytes)
}

/// Writes a file whole or not at all.
///
/// # Errors
/// [`StimulusError::Unwritable`]; what was written so far is removed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StimulusError> {
    let mut neighbour = path.as_os_str().to_owned();
    neighbour.push(".partial");
    let neighbour = Path::new(&neighbour);
    let written = std::fs::File::create(neighbour)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(neighbour, path));
    written.map_err(|source| {
        // Already failing; a leftover that cannot be removed is the lesser trouble.
        let _ = std::fs::remove_file(neighbour);
        StimulusError::Unwritable {
            path: path.to_owned(),
            source,
        }
    })
}

/// Writes several files into a folder, each whole or not at all, and makes the folders they need.
/// Paths are relative, with `/` between the parts. How many were written.
///
/// # Errors
/// [`StimulusError::Unwritable`] at the first that cannot be; those before it stand.
pub fn write_all(
    folder: &Path,
    files: impl IntoIterator<Item = (String, Vec<u8>)>,
) -> Result<usize, StimulusError> {
    let mut written = 0;
    for (name, bytes) in files {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(|source| StimulusError::Unwritable {
                path: parent.to_owned(),
                source,
            })?;
        }
        write_whole(&path, &bytes)?;
        written += 1;
    }
    Ok(written)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_decodes_to_the_same_pixels() {
        let picture = Picture {
            width_px: 3,
            height_px: 2,
            rgba8: (0..6_u8).flat_map(|i| [i * 40, 255 - i, 7, 255]).collect(),
        };
        let bytes = encode_png(Path::new("x.png"), &picture).unwrap();
        let decoded = image::load_from_memory(&bytes).unwrap().to_rgba8();
        assert_eq!(decoded.into_raw(), picture.rgba8);
    }

    #[test]
    fn a_failed_write_leaves_nothing() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join("taken");
        std::fs::create_dir_all(target.join("inside")).unwrap();
        assert!(write_whole(&target, b"x").is_err());
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}
