//! Errors and fits for other programs, with full precision.

use serde::Serialize;

use crate::multi_bounce::{COEFFICIENTS, Coefficients};
use crate::record::spreadsheet::neutral;
use crate::reference::bounce_fit::{Fit, MapError, Study};
use crate::report::{ReportError, VERSION};

/// Version of the layout of `fits.json`.
const SCHEMA_VERSION: u32 = 1;

/// `errors.csv`: one line a model, map and albedo; the albedo is empty for all of 0 to 0.9 together.
/// Errors are shares of the light in the open; those of a model that is finite nowhere are empty.
///
/// # Errors
/// [`ReportError::Csv`]; none is known to occur.
pub fn errors_csv(study: &Study) -> Result<String, ReportError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for error in &study.errors {
        writer.serialize(Line::of(error))?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[derive(Serialize)]
struct Line {
    // A spreadsheet would run a name that starts like a formula.
    model: String,
    map: String,
    held_out: bool,
    albedo: Option<f64>,
    rmse: Option<f64>,
    rmse_by_texel: Option<f64>,
    worst: f64,
    worst_openness: f64,
    not_finite: usize,
}

impl Line {
    fn of(error: &MapError) -> Self {
        let finite = |number: f64| number.is_finite().then_some(number);
        Self {
            model: neutral(&error.model).into_owned(),
            map: neutral(&error.map).into_owned(),
            held_out: error.held_out,
            albedo: error.albedo,
            rmse: finite(error.rmse),
            rmse_by_texel: finite(error.rmse_by_texel),
            worst: error.worst,
            worst_openness: error.worst_openness,
            not_finite: error.not_finite,
        }
    }
}

#[derive(Serialize)]
struct Fits<'a> {
    schema_version: u32,
    greyfield_version: &'static str,
    fits: &'a [Fit],
    /// Coefficients of `greyfield` that these maps gave, and those that the program has.
    refitted: Option<&'a Coefficients>,
    built_in: Coefficients,
}

/// `fits.json`: every fit with its published values, 95 % half widths and rmse, and the coefficients
/// of our own form.
///
/// # Errors
/// [`ReportError::Json`]; none is known to occur.
pub fn fits_json(study: &Study) -> Result<String, ReportError> {
    let fits = Fits {
        schema_version: SCHEMA_VERSION,
        greyfield_version: VERSION,
        fits: &study.fits,
        refitted: study.refitted.as_ref(),
        built_in: COEFFICIENTS,
    };
    Ok(serde_json::to_string_pretty(&fits)? + "\n")
}
