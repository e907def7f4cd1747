//! The files of a comparison: tables, a record, and pictures.

use std::path::Path;

use anyhow::anyhow;
use serde::Serialize;

use super::{PictureInterReflection, Row};
use crate::cli::Failure;
use crate::multi_bounce::{COEFFICIENTS, Coefficients, ModelError, Openness};
use crate::reference::InterReflectionSettings;
use crate::render::{AdapterRecord, Picture};
use crate::report::error_picture::{self, Scale};
use crate::scene::{SceneConfig, srgb};
use crate::stimulus::files::{encode_png, write_whole};
use crate::stimulus::truth::write_channels;

/// Error of E/E₀ at the ends of the scale of the pictures of errors.
const LARGEST_ERROR: f32 = 0.25;

/// What was compared, and where.
pub struct About<'a> {
    /// The scene.
    pub scene: &'a SceneConfig,
    /// What drew its points.
    pub adapter: &'a AdapterRecord,
    /// How light was followed.
    pub settings: &'a InterReflectionSettings,
    /// What was found.
    pub picture: &'a PictureInterReflection,
    /// What the rays took.
    pub seconds: f64,
}

/// The truth in numbers: means over the pixels with a surface and the channels.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Truth {
    /// Pixels with a surface.
    pub pixels: u64,
    /// Of E/E₀.
    pub mean: f64,
    /// Of the part that arrives without a bounce: k_A.
    pub mean_direct: f64,
    /// Of uniform openness α.
    pub mean_uniform_openness: f64,
    /// Of the pixels' own albedo.
    pub mean_albedo: f64,
    /// Mean distance of the drawn albedo from the one that light is followed with.
    pub albedo_apart: f64,
    /// Of E/E₀.
    pub mean_standard_error: f64,
    /// In any pixel and channel.
    pub largest_standard_error: f64,
    /// What the limit of bounces can have lost of E/E₀.
    pub mean_given_up: f64,
    /// In any pixel.
    pub largest_given_up: f64,
    /// Of the pixels with a surface.
    pub paths_per_pixel: f64,
}

impl About<'_> {
    /// What was found, in numbers.
    pub fn truth(&self) -> Truth {
        let (picture, light) = (self.picture, &self.picture.light);
        let of_colours = |colours: &[[f32; 3]]| {
            picture.mean(|pixel| colours[pixel].map(f64::from).iter().sum::<f64>() / 3.0)
        };
        let largest = |values: &mut dyn Iterator<Item = f32>| f64::from(values.fold(0.0, f32::max));
        Truth {
            pixels: light.surfaces,
            mean: of_colours(&light.irradiance),
            mean_direct: picture.mean(|pixel| light.direct[pixel].into()),
            mean_uniform_openness: picture.mean(|pixel| picture.openness.occlusion[pixel].into()),
            mean_albedo: of_colours(&picture.albedo),
            albedo_apart: picture.albedo_apart,
            mean_standard_error: of_colours(&light.standard_error),
            largest_standard_error: largest(&mut light.standard_error.iter().flatten().copied()),
            mean_given_up: picture.mean(|pixel| light.given_up[pixel].into()),
            largest_given_up: largest(&mut light.given_up.iter().copied()),
            paths_per_pixel: light.paths as f64 / (light.surfaces as f64).max(1.0),
        }
    }
}

/// `inter-reflection.json`.
#[derive(Serialize)]
struct Record<'a> {
    schema_version: u32,
    app_version: &'static str,
    scene: &'a str,
    config_sha256: String,
    model_sha256: Option<String>,
    adapter: &'a AdapterRecord,
    size_px: (u32, u32),
    settings: &'a InterReflectionSettings,
    /// Those that the rows named `greyfield` are of.
    greyfield_coefficients: Coefficients,
    truth: Truth,
    models: Vec<Line<'a>>,
    seconds: f64,
}

/// A row of `inter-reflection.json`.
#[derive(Serialize)]
struct Line<'a> {
    model: &'a str,
    given: Openness,
    #[serde(flatten)]
    error: ModelError,
}

/// Writes everything, the record last: where it is, all is.
///
/// # Errors
/// The disk's, and what cannot be encoded.
pub fn write(folder: &Path, about: &About<'_>, rows: &[Row]) -> Result<(), Failure> {
    table(folder, rows)?;
    channels(folder, about.picture)?;
    picture(
        folder,
        "truth",
        about.picture,
        &about.picture.light.irradiance,
    )?;
    for row in rows {
        picture(folder, &row.name, about.picture, &row.values)?;
        error(folder, about, row)?;
    }
    let record = Record {
        schema_version: 1,
        app_version: env!("CARGO_PKG_VERSION"),
        scene: &about.scene.id,
        config_sha256: crate::digest::sha256_hex(about.scene.text.as_bytes()),
        model_sha256: about.scene.geometry.sha256()?,
        adapter: about.adapter,
        size_px: about.picture.size_px,
        settings: about.settings,
        greyfield_coefficients: COEFFICIENTS,
        truth: about.truth(),
        models: (rows.iter())
            .map(|row| Line {
                model: &row.name,
                given: row.given,
                error: row.error,
            })
            .collect(),
        seconds: about.seconds,
    };
    let text = serde_json::to_string_pretty(&record)? + "\n";
    Ok(write_whole(
        &folder.join("inter-reflection.json"),
        text.as_bytes(),
    )?)
}

/// `inter-reflection.csv`.
fn table(folder: &Path, rows: &[Row]) -> Result<(), Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record([
        "model",
        "given",
        "rmse",
        "bias",
        "p95",
        "worst",
        "values",
        "not_finite",
        "outside",
    ])?;
    for row in rows {
        let given = match row.given {
            Openness::Uniform => "uniform",
            Openness::Cosine => "cosine",
        };
        let errors = [
            row.error.rmse,
            row.error.bias,
            row.error.p95,
            row.error.worst,
        ];
        let counts = [row.error.values, row.error.not_finite, row.error.outside];
        let numbers = errors.map(|error| error.to_string());
        let counts = counts.map(|count| count.to_string());
        let names = [row.name.clone(), given.to_owned()];
        table.write_record(names.iter().chain(&numbers).chain(&counts))?;
    }
    let bytes = table
        .into_inner()
        .map_err(|error| anyhow!(error.to_string()))?;
    Ok(write_whole(&folder.join("inter-reflection.csv"), &bytes)?)
}

/// `truth.exr`: all that is known of every pixel, 32-bit floats.
fn channels(folder: &Path, picture: &PictureInterReflection) -> Result<(), Failure> {
    let light = &picture.light;
    let channel = |colours: &[[f32; 3]], channel: usize| -> Vec<f32> {
        colours.iter().map(|colour| colour[channel]).collect()
    };
    let mut named = vec![
        (String::from("cosine_openness"), light.direct.clone()),
        (
            String::from("uniform_openness"),
            picture.openness.occlusion.clone(),
        ),
    ];
    for (number, name) in ["R", "G", "B"].into_iter().enumerate() {
        named.push((name.to_owned(), channel(&light.irradiance, number)));
        named.push((
            format!("standard_error.{name}"),
            channel(&light.standard_error, number),
        ));
        named.push((format!("albedo.{name}"), channel(&picture.albedo, number)));
    }
    Ok(write_channels(
        &folder.join("truth.exr"),
        named,
        picture.size_px,
    )?)
}

/// E/E₀ as a white surface in that light looks: 8-bit sRGB. What is no number is black.
fn picture(
    folder: &Path,
    name: &str,
    of: &PictureInterReflection,
    values: &[[f32; 3]],
) -> Result<(), Failure> {
    let (width_px, height_px) = of.size_px;
    let picture = Picture {
        width_px,
        height_px,
        rgba8: (values.iter())
            .flat_map(|colour| {
                let [red, green, blue] = colour.map(srgb::encode_u8);
                [red, green, blue, 255]
            })
            .collect(),
    };
    let path = folder.join(format!("{name}.png"));
    Ok(write_whole(&path, &encode_png(&path, &picture)?)?)
}

/// Where a model is too bright, and where too dark.
fn error(folder: &Path, about: &About<'_>, row: &Row) -> Result<(), Failure> {
    let title = format!(
        "{}, {}: E/E0 minus truth, RMSE {:.4}, mean {:+.4}",
        about.scene.title, row.name, row.error.rmse, row.error.bias
    );
    let adapter = format!("{}; {}", about.adapter.name, about.adapter.driver);
    let values = about.picture.signed_error(&row.values);
    let scale = Scale::Signed(LARGEST_ERROR);
    let drawn = error_picture::draw(&values, about.picture.size_px, scale, &[&title, &adapter])?;
    let bytes = error_picture::encode(&drawn)?;
    Ok(write_whole(
        &folder.join(format!("{}-error.png", row.name)),
        &bytes,
    )?)
}
