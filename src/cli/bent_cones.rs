//! `greyfield bent-cones`: light through bent cones against rays.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;

use super::size::size;
use super::{Failure, Verbosity};
use crate::cost::CostError;
use crate::cost::bent_cones::{self, ConeOptions, ConesMeasured};
use crate::render::{Gpu, Picture, Renderer};
use crate::report::error_picture::{self, Scale};
use crate::scene::{Environment, SceneConfig, environment, srgb};
use crate::stimulus::files::{encode_png, write_whole};
use crate::stimulus::progress::Progress;

/// Measure an environment's light through bent cones against rays.
///
/// Traces the irradiance of every visible point under the environment itself, and compares: k_A times the
/// light of an open point, and the light through the bent cone, of the same rays and of each technique;
/// the cone of a mean that counts all directions alike; and nine coefficients through the open directions
/// one by one, which is the least error that any of them can have. Errors are of luminance, as a share of
/// the mean irradiance. Writes bent-cones.csv, bent-cones.json, and of each way its irradiance and
/// its error as pictures.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield bent-cones stimuli/scenes/atrium.toml --environment lobby.hdr --size 320x180"
)]
pub struct BentCones {
    /// The scene's config.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// A map in Radiance or OpenEXR format [default: the scene's own environment].
    #[arg(long, value_name = "FILE")]
    environment: Option<PathBuf>,
    /// Size of the picture whose points are lit.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "320x180")]
    size: (u32, u32),
    /// Rays a pixel by the cosine, as many by the environment's brightness, and as many all alike;
    /// rounded up to 16 times a power of two.
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(64..=1 << 20))]
    rays: u32,
    /// Techniques that give a bent cone, as the scene sets them.
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        default_value = "gtao,vbao,ssdo"
    )]
    techniques: Vec<String>,
    /// How far the techniques look for occluders, metres [default: as far as the scene has them look].
    #[arg(long, value_name = "M")]
    radius_m: Option<f64>,
    /// Seed of rays and kernels.
    #[arg(long, default_value_t = 2010)]
    seed: u64,
    /// Where to put everything [default: a folder named like the scene with -bent-cones, beside it].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw on the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong scene, environment or technique; 1 for adapter and disk.
pub fn run(args: &BentCones, verbosity: Verbosity) -> Result<(), Failure> {
    let scene = SceneConfig::load(&args.scene).map_err(Failure::bad_input)?;
    let environment = environment_of(args, &scene)?;
    let options = ConeOptions {
        size_px: args.size,
        rays: args.rays,
        radius_m: args.radius_m,
        seed: args.seed,
    };
    let bar = verbosity.progress(u64::from(args.size.0) * u64::from(args.size.1));
    bar.set_message("opening the adapter");
    let renderer = Renderer::new(Gpu::open(args.adapter.as_deref())?);
    let progress = Progress {
        step: &|what| bar.set_message(what.to_owned()),
        pixels: &|count| bar.inc(count),
    };
    let lit = (&scene, &environment);
    let measured = bent_cones::measure(&renderer, lit, &args.techniques, &options, &progress)
        .map_err(|error| match error {
            CostError::Input(_) | CostError::Scene(_) => Failure::bad_input(error),
            error => Failure::from(error),
        })?;
    bar.finish_and_clear();
    let folder = (args.out.clone()).unwrap_or_else(|| {
        scene
            .path
            .with_file_name(format!("{}-bent-cones", scene.id))
    });
    std::fs::create_dir_all(&folder)
        .map_err(|error| anyhow!("{} cannot be made: {error}", folder.display()))?;
    write(&folder, &measured)?;
    say(&measured, &folder);
    Ok(())
}

fn environment_of(args: &BentCones, scene: &SceneConfig) -> Result<Environment, Failure> {
    if let Some(path) = &args.environment {
        let loaded = environment::file::load(path)
            .map_err(|error| Failure::bad_input(anyhow!("{}: {error}", path.display())))?;
        return Ok(Environment::from_file(loaded));
    }
    (scene.lightings.values())
        .find_map(|lighting| lighting.environment.clone())
        .ok_or_else(|| {
            Failure::bad_input(anyhow!(
                "{}: no lighting has an environment; name a map with --environment",
                scene.path.display()
            ))
        })
}

fn write(folder: &Path, measured: &ConesMeasured) -> Result<(), Failure> {
    let record = &measured.record;
    let mut table = csv::Writer::from_writer(Vec::new());
    for row in &record.rows {
        table.serialize(row)?;
    }
    let bytes = (table.into_inner()).map_err(|error| anyhow!(error.to_string()))?;
    write_whole(&folder.join("bent-cones.csv"), &bytes)?;
    let text = serde_json::to_string_pretty(record)? + "\n";
    write_whole(&folder.join("bent-cones.json"), text.as_bytes())?;
    let truth: Vec<_> = (measured.truth.iter())
        .map(|truth| truth.unwrap_or_default())
        .collect();
    irradiance(folder, "truth", &truth, measured)?;
    for (row, found) in record.rows.iter().zip(&measured.irradiance) {
        let name = format!("{}--{}", row.source, row.light);
        irradiance(folder, &name, found, measured)?;
        error(folder, &name, found, measured)?;
    }
    Ok(())
}

/// White paper under the light, at one exposure: the mean is at a third of white.
fn irradiance(
    folder: &Path,
    name: &str,
    found: &[glam::Vec3],
    measured: &ConesMeasured,
) -> Result<(), Failure> {
    let (width_px, height_px) = measured.record.options.size_px;
    let scale = 1.0 / (3.0 * measured.record.mean_irradiance as f32);
    let level = |value: f32| srgb::encode_u8(value * scale);
    let rgba8 = (found.iter())
        .flat_map(|light| [level(light.x), level(light.y), level(light.z), 255])
        .collect();
    let path = folder.join(format!("irradiance--{name}.png"));
    let picture = Picture {
        width_px,
        height_px,
        rgba8,
    };
    Ok(write_whole(&path, &encode_png(&path, &picture)?)?)
}

/// Error of luminance as a share of the mean: blue too dark, red too bright.
fn error(
    folder: &Path,
    name: &str,
    found: &[glam::Vec3],
    measured: &ConesMeasured,
) -> Result<(), Failure> {
    use crate::reference::lit::luminance;
    let mean = measured.record.mean_irradiance as f32;
    let errors: Vec<f32> = (measured.truth.iter().zip(found))
        .map(|(truth, found)| {
            truth.map_or(f32::NAN, |truth| {
                (luminance(*found) - luminance(truth)) / mean
            })
        })
        .collect();
    let texts = ["irradiance less the true one, as a share of the mean", name];
    let size_px = measured.record.options.size_px;
    let picture = error_picture::draw(&errors, size_px, Scale::Signed(0.5), &texts)?;
    let path = folder.join(format!("error--{name}.png"));
    Ok(write_whole(&path, &error_picture::encode(&picture)?)?)
}

fn say(measured: &ConesMeasured, folder: &Path) {
    let record = &measured.record;
    println!(
        "{} points of {}, mean irradiance {:.4}, standard error of the truth {:.2} %",
        record.surfaces,
        record.scene,
        record.mean_irradiance,
        100.0 * record.truth_error
    );
    println!("open directions  light         RMSE      mean     95 %");
    for row in &record.rows {
        let percent = |value: f64| 100.0 * value;
        println!(
            "{:<16} {:<12} {:>5.1} %  {:>+6.1} %  {:>5.1} %",
            row.source,
            row.light,
            percent(row.rmse),
            percent(row.bias),
            percent(row.p95)
        );
    }
    println!("in {}", folder.display());
}
