//! What `greyfield bounces` leaves behind.

use std::path::Path;

use anyhow::anyhow;
use serde::Serialize;

use super::follow::Followed;
use super::{BouncesArgs, border};
use crate::cli::Failure;
use crate::multi_bounce::Coefficients;
use crate::reference::bounce_fit::{ColourPicture, Fit, MapError, Study};
use crate::reference::height_field::{Border, Stopped, curves};
use crate::scene::srgb;
use crate::stimulus::files::{encode_occlusion, write_whole};

/// Bounces that there is an image of.
const PICTURED_BOUNCES: usize = 21;

/// `bounces.json` of a map.
#[derive(Serialize)]
struct MapRecord<'a> {
    schema_version: u32,
    app_version: &'static str,
    map: &'a str,
    size_px: (usize, usize),
    amplitude: f64,
    rays: usize,
    border: Border,
    seed: u64,
    links_kept: bool,
    cast_s: f64,
    followed_s: f64,
    bounces: usize,
    stopped: Stopped,
    /// Mean irradiance of each bounce at an albedo of 1, as a share of a point's in the open.
    means: Vec<f64>,
}

/// `fits.json`.
#[derive(Serialize)]
struct FitRecord<'a> {
    schema_version: u32,
    app_version: &'static str,
    maps: Vec<&'a str>,
    held_out: Vec<&'a str>,
    fits: &'a [Fit],
    greyfield: Option<&'a Coefficients>,
}

/// Makes a folder.
pub fn make(folder: &Path) -> Result<(), Failure> {
    Ok(std::fs::create_dir_all(folder)
        .map_err(|error| anyhow!("{} cannot be made: {error}", folder.display()))?)
}

/// A map's images, curves and record.
pub fn map(folder: &Path, followed: &Followed, args: &BouncesArgs) -> Result<(), Failure> {
    make(folder)?;
    let size = (followed.size_px.0 as u32, followed.size_px.1 as u32);
    let image = |name: &str, values: &[f32]| -> Result<(), Failure> {
        let path = folder.join(format!("{name}.png"));
        Ok(write_whole(&path, &encode_occlusion(&path, values, size)?)?)
    };
    let bounces = &followed.bounces;
    image("height", &followed.heights)?;
    image("openness", &bounces.openness)?;
    let share = |value: f32| value / std::f32::consts::PI;
    for (bounce, irradiance) in bounces.irradiance.iter().enumerate().take(PICTURED_BOUNCES) {
        let shares: Vec<f32> = irradiance.iter().copied().map(share).collect();
        image(&format!("irradiance-{bounce:02}"), &shares)?;
    }
    let texels = bounces.openness.len();
    let sums: Vec<f32> = (0..texels).map(|texel| share(bounces.sum(texel))).collect();
    image("irradiance-sum", &sums)?;
    table(&folder.join("curves.csv"), curves(bounces))?;
    let mean = |irradiance: &Vec<f32>| {
        irradiance.iter().map(|e| f64::from(share(*e))).sum::<f64>() / texels as f64
    };
    let record = MapRecord {
        schema_version: 2,
        app_version: env!("CARGO_PKG_VERSION"),
        map: &followed.name,
        size_px: followed.size_px,
        amplitude: followed.amplitude,
        rays: followed.links.rays(),
        border: border(args),
        seed: args.seed,
        links_kept: followed.links_kept,
        cast_s: followed.cast_s,
        followed_s: followed.followed_s,
        bounces: bounces.irradiance.len() - 1,
        stopped: bounces.stopped,
        means: bounces.irradiance.iter().map(mean).collect(),
    };
    json(&folder.join("bounces.json"), &record)
}

/// Errors, fits, pictures in colour, figures and the page.
pub fn study(folder: &Path, study: &Study, _args: &BouncesArgs) -> Result<(), Failure> {
    table(&folder.join("errors.csv"), &study.errors)?;
    if !study.fits.is_empty() {
        let named = |held_out: bool| {
            let maps = study.maps.iter().filter(|map| map.held_out == held_out);
            maps.map(|map| map.name.as_str()).collect()
        };
        let record = FitRecord {
            schema_version: 1,
            app_version: env!("CARGO_PKG_VERSION"),
            maps: named(false),
            held_out: named(true),
            fits: &study.fits,
            greyfield: study.refitted.as_ref(),
        };
        json(&folder.join("fits.json"), &record)?;
    }
    for picture in &study.pictures {
        let path = folder.join(format!("colour-{}.png", picture.name));
        write_whole(&path, &encode_colour(picture)?)?;
    }
    Ok(())
}

/// A picture as an sRGB PNG of 8 bits; the sky is white.
fn encode_colour(picture: &ColourPicture) -> Result<Vec<u8>, Failure> {
    let (width, height) = (picture.size_px.0 as u32, picture.size_px.1 as u32);
    let levels = picture
        .rgb
        .iter()
        .flatten()
        .map(|light| srgb::encode_u8(*light));
    let image = image::RgbImage::from_raw(width, height, levels.collect())
        .ok_or_else(|| anyhow!("a picture of {width}×{height} has as many pixels"))?;
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

fn table(path: &Path, rows: impl IntoIterator<Item = impl Serialize>) -> Result<(), Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for row in rows {
        table.serialize(row)?;
    }
    let bytes = table
        .into_inner()
        .map_err(|error| anyhow!(error.to_string()))?;
    Ok(write_whole(path, &bytes)?)
}

fn json(path: &Path, record: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(record)? + "\n";
    Ok(write_whole(path, text.as_bytes())?)
}

/// Why no further bounce was made.
pub fn why(stopped: Stopped) -> &'static str {
    match stopped {
        Stopped::Enough => "as many as asked for",
        Stopped::Unseen => "the last adds less than half a level of 8 bits anywhere",
        Stopped::Dark => "nothing is sent back any more",
    }
}

/// Fits and errors on the terminal.
pub fn say(study: &Study) {
    for fit in &study.fits {
        println!("\n{}   rmse {:.5}", fit.form, fit.fitted.rmse);
        let found = fit.fitted.names.iter().zip(&fit.fitted.values);
        for (place, (name, value)) in found.enumerate() {
            let width = match fit.fitted.half_widths[place] {
                Some(width) => format!("± {width:.5}"),
                None => String::from("on its bound, or not determined"),
            };
            let published = fit.published.get(place);
            let published = published.map_or(String::new(), |p| format!("   published {p:.5}"));
            println!("  {name:<3} {value:>10.5} {width}{published}");
        }
    }
    let all = |error: &&MapError| error.albedo.is_none();
    println!(
        "\nerror of E/E₀ over albedos 0 to 0.9, root mean square over bins of openness (by texel), and worst"
    );
    for map in &study.maps {
        println!(
            "{}{}",
            map.name,
            if map.held_out { ", held out" } else { "" }
        );
        for error in study
            .errors
            .iter()
            .filter(all)
            .filter(|error| error.map == map.name)
        {
            let broken = match error.not_finite {
                0 => String::new(),
                count => format!("   {count} not finite"),
            };
            println!(
                "  {:<34} {:.4} ({:.4})   {:.4} at α {:.2}{broken}",
                error.model, error.rmse, error.rmse_by_texel, error.worst, error.worst_openness
            );
        }
    }
}
