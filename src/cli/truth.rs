//! `greyfield truth`: the ray-traced occlusion of a set's scenes.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, Verbosity};
use crate::reference::{OcclusionSettings, Weighting};
use crate::render::{Gpu, Renderer};
use crate::stimulus::StimulusSet;
use crate::stimulus::produce::ProduceError;
use crate::stimulus::progress::Progress;
use crate::stimulus::truth::{self, TruthOptions};

/// Find the true occlusion of a set's scenes by ray tracing, with its standard error.
///
/// For each scene that the set renders: rays over the hemisphere from the very points that its
/// images show, on all processor cores, until each pixel's standard error is small enough. Writes
/// the occlusion as 16-bit PNG, occlusion and standard error as EXR, and truth.json. With
/// --screen-space the best answer that the depth buffer alone allows is written too.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield truth stimuli/thesis-2010.toml --only dragon-low --error 0.005\n  greyfield truth stimuli/thesis-2010.toml --distance-m 1 --screen-space --out truth"
)]
pub struct Truth {
    /// The set: a TOML file with its conditions.
    set: PathBuf,
    /// The scene of one condition only.
    #[arg(long, value_name = "CONDITION")]
    only: Option<String>,
    /// Standard error at which a pixel has had rays enough.
    #[arg(long, default_value_t = 0.002)]
    error: f64,
    /// Rays a pixel has at most, whatever its error then is.
    #[arg(long, value_name = "N", default_value_t = 16_384)]
    max_rays: u32,
    /// What directions count by.
    #[arg(long, value_enum, default_value = "cosine")]
    weighting: WeightingArg,
    /// Obscurance: what is met at t metres hides 1 - t/D, and nothing beyond D metres
    /// [default: whatever is met at any distance hides all].
    #[arg(long, value_name = "D")]
    distance_m: Option<f32>,
    /// Also find the answer that the depth buffer alone allows.
    #[arg(long)]
    screen_space: bool,
    /// For that answer: how deep what is seen goes on behind what is seen of it, metres
    /// [default: solid, to any depth].
    #[arg(long, value_name = "M", requires = "screen_space")]
    thickness_m: Option<f32>,
    /// Where to put the images [default: a folder named like the set with -truth, beside it].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw the points on the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum WeightingArg {
    Cosine,
    Uniform,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong set, condition or setting; 1 for adapter and disk.
pub fn run(args: &Truth, verbosity: Verbosity) -> Result<(), Failure> {
    let set = StimulusSet::load(&args.set).map_err(Failure::bad_input)?;
    let options = TruthOptions {
        settings: OcclusionSettings {
            weighting: match args.weighting {
                WeightingArg::Cosine => Weighting::Cosine,
                WeightingArg::Uniform => Weighting::Uniform,
            },
            d_max_m: args.distance_m,
            error: args.error,
            max_rays: args.max_rays,
            ..OcclusionSettings::new(set.seed)
        },
        screen_space: args.screen_space,
        thickness_m: args.thickness_m,
    };
    if let Some(found) = args.thickness_m.filter(|m| !(*m >= 0.0 && m.is_finite())) {
        return Err(Failure::bad_input(anyhow::anyhow!(
            "--thickness-m: found {found}, a thickness is 0 m or more"
        )));
    }
    options.settings.check().map_err(Failure::bad_input)?;
    let only = args.only.as_deref();
    let scenes = truth::scenes(&set, only).map_err(Failure::bad_input)?.len();
    let folder = args
        .out
        .clone()
        .unwrap_or_else(|| set.path.with_file_name(format!("{}-truth", set.id)));
    let (width_px, height_px) = set.size_px.unwrap_or_default();
    let images = scenes as u64 * (1 + u64::from(args.screen_space));
    let bar = verbosity.progress(images * u64::from(width_px) * u64::from(height_px));
    bar.set_message("opening the adapter");
    let renderer = Renderer::new(Gpu::open(args.adapter.as_deref())?);
    let progress = Progress {
        step: &|what| bar.set_message(what.to_owned()),
        pixels: &|count| bar.inc(count),
    };
    let record =
        truth::produce(&renderer, &set, &folder, only, &options, &progress).map_err(|error| {
            match error {
                ProduceError::Scene(_) => Failure::bad_input(error),
                error => Failure::from(error),
            }
        })?;
    bar.finish_and_clear();
    for image in &record.images {
        println!("{}", image.summary());
    }
    println!("{} images in {}", record.images.len(), folder.display());
    Ok(())
}
