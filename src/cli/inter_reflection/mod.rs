//! `greyfield inter-reflection`: models of light between surfaces, against a scene's own light.

mod files;
mod rows;

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::anyhow;
use clap::Args;

use self::rows::Row;
use super::{Failure, Verbosity, size};
use crate::reference::InterReflectionSettings;
use crate::render::{Gpu, RenderError, Renderer};
use crate::scene::SceneConfig;
use crate::stimulus::produce::ProduceError;
use crate::stimulus::progress::Progress;
use crate::stimulus::truth::inter_reflection::{PictureInterReflection, of_picture};

/// Compare models of light between surfaces with the scene's own light, followed by rays.
///
/// At every point that the scene's picture shows, light from a sky of the same radiance everywhere is
/// followed over any number of diffuse bounces, each with the colour of what it meets, until the
/// standard error is small enough. Beside it every model says what it makes of the point's openness and
/// its own albedo. Prints and writes each model's error, and pictures of all of them.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield inter-reflection stimuli/scenes/atrium.toml --size 320x180 --error 0.01"
)]
pub struct InterReflectionArgs {
    /// The scene's config.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Size of the picture, pixels.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size::size)]
    size: (u32, u32),
    /// Standard error at which a pixel has had paths enough, of a point's light in the open.
    #[arg(long, value_name = "E", default_value_t = 0.005)]
    error: f64,
    /// Paths a pixel has at most, whatever its error then is.
    #[arg(long, value_name = "N", default_value_t = 16_384)]
    max_paths: u32,
    /// Bounces after which a path is given up.
    #[arg(long, value_name = "N", default_value_t = 20)]
    bounces: u32,
    /// Seed of the rays.
    #[arg(long, default_value_t = 2010)]
    seed: u64,
    /// Where to put everything [default: a folder named like the scene with -inter-reflection, beside
    /// it].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw the points on the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong scene or setting; 1 for adapter and disk.
pub fn run(args: &InterReflectionArgs, verbosity: Verbosity) -> Result<(), Failure> {
    let settings = InterReflectionSettings {
        error: args.error,
        max_paths: args.max_paths,
        bounces: args.bounces,
        ..InterReflectionSettings::new(args.seed)
    };
    settings.check().map_err(Failure::bad_input)?;
    let scene = SceneConfig::load(&args.scene).map_err(Failure::bad_input)?;
    let folder = args.out.clone().unwrap_or_else(|| beside(&args.scene));
    std::fs::create_dir_all(&folder)
        .map_err(|error| anyhow!("{} cannot be made: {error}", folder.display()))?;
    // Openness and light, a pixel each.
    let bar = verbosity.progress(2 * u64::from(args.size.0) * u64::from(args.size.1));
    bar.set_message("opening the adapter");
    let renderer = Renderer::new(Gpu::open(args.adapter.as_deref())?);
    let progress = Progress {
        step: &|what| bar.set_message(what.to_owned()),
        pixels: &|count| bar.inc(count),
    };
    let started = Instant::now();
    let picture = of_picture(&renderer, &scene, args.size, &settings, &progress).map_err(wrong)?;
    let seconds = started.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let rows = Row::all(&picture);
    let about = files::About {
        scene: &scene,
        adapter: &renderer.gpu().adapter,
        settings: &settings,
        picture: &picture,
        seconds,
    };
    files::write(&folder, &about, &rows)?;
    say(&about, &rows, &folder);
    Ok(())
}

/// A wrong scene is bad input; the rest failed.
fn wrong(error: ProduceError) -> Failure {
    match error {
        ProduceError::Scene(_) | ProduceError::Render(RenderError::Request(_)) => {
            Failure::bad_input(error)
        }
        error => Failure::from(error),
    }
}

fn beside(scene: &Path) -> PathBuf {
    let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
    scene.with_file_name(format!("{stem}-inter-reflection"))
}

fn say(about: &files::About<'_>, rows: &[Row], folder: &Path) {
    let truth = about.truth();
    let (width_px, height_px) = about.picture.size_px;
    println!(
        "{} at {width_px}×{height_px}: E/E₀ {:.4} on average, {:.4} of it without a bounce; {:.0} paths a pixel, {:.0} s",
        about.scene.title, truth.mean, truth.mean_direct, truth.paths_per_pixel, about.seconds,
    );
    println!(
        "standard error of the truth {:.5} on average, {:.5} at most; given up after {} bounces: {:.6} on average, {:.6} at most\n",
        truth.mean_standard_error,
        truth.largest_standard_error,
        about.settings.bounces,
        truth.mean_given_up,
        truth.largest_given_up,
    );
    println!("{}", rows::table(rows));
    let lost: u64 = rows.iter().map(|row| row.error.not_finite).sum();
    if lost > 0 {
        println!("values that are no number are counted, and left out of the errors");
    }
    let noisy = rows.iter().map(|row| row.error.rmse).fold(1.0, f64::min);
    if truth.mean_standard_error > 0.5 * noisy {
        println!(
            "note: the least RMSE is near the truth's own error; a smaller --error tells more"
        );
    }
    println!("in {}", folder.display());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::Parser;

    /// The help's example is a command that there is.
    #[test]
    fn the_example_is_understood() {
        let example =
            "greyfield inter-reflection stimuli/scenes/atrium.toml --size 320x180 --error 0.01";
        assert!(Cli::try_parse_from(example.split(' ')).is_ok());
        assert!(Cli::try_parse_from(["greyfield", "inter-reflection"]).is_err());
    }

    /// A whole run on plain shapes: every file is there, and the albedo that models are told is the one
    /// that light is followed with.
    #[test]
    fn a_run_leaves_all_its_files() {
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("stimuli/scenes/shapes.toml");
        let folder = tempfile::tempdir().unwrap();
        let text = |path: &Path| path.to_string_lossy().into_owned();
        let options = ["--size", "48x27", "--error", "0.05", "--quiet", "--out"];
        let line = ["greyfield", "inter-reflection", &text(&scene)];
        let line = line.iter().chain(&options).map(ToString::to_string);
        let cli = Cli::try_parse_from(line.chain([text(folder.path())])).unwrap();
        crate::cli::run(cli).unwrap();
        let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
        let record: serde_json::Value =
            serde_json::from_slice(&bytes("inter-reflection.json")).unwrap();
        let truth = |key: &str| record["truth"][key].as_f64().unwrap();
        assert!(truth("albedo_apart") < 1e-3, "{}", truth("albedo_apart"));
        assert!(truth("mean") > truth("mean_direct") && truth("mean") < 1.0);
        assert!(truth("largest_standard_error") <= 0.05);
        let models = record["models"].as_array().unwrap();
        for model in models {
            let name = model["model"].as_str().unwrap();
            assert!(!bytes(&format!("{name}.png")).is_empty());
            assert!(!bytes(&format!("{name}-error.png")).is_empty());
        }
        let table = String::from_utf8(bytes("inter-reflection.csv")).unwrap();
        assert_eq!(table.lines().count(), models.len() + 1);
        assert!(!bytes("truth.exr").is_empty() && !bytes("truth.png").is_empty());
    }

    #[test]
    fn wrong_settings_are_bad_input() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("stimuli/scenes/shapes.toml");
        let path = path.to_string_lossy();
        let code = |arguments: &[&str]| {
            let line = [&["greyfield", "inter-reflection"], arguments].concat();
            crate::cli::run(Cli::try_parse_from(line).unwrap()).map_err(|failure| failure.code)
        };
        assert_eq!(code(&[&path, "--error", "0"]), Err(2));
        assert_eq!(code(&[&path, "--bounces", "2000"]), Err(2));
        assert_eq!(code(&["no-such-scene.toml"]), Err(2));
    }
}
