//! `greyfield model`: what is in a model file.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::{Failure, Verbosity, output};
use crate::scene::model::{self, AnimationChoice, ModelOptions, Up};

/// Print what is in a model file: its size in metres, what it is made of, its animations and
/// lights, and what of it is not drawn as its author meant it.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield model Fox.glb --scale 0.01 --animation Walk --time 0.3"
)]
pub struct ModelArgs {
    /// The model: .gltf, .glb, .obj, .ply or .ply.gz.
    file: PathBuf,
    /// Metres per unit of the file.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    scale: f32,
    /// Which axis of the file points up.
    #[arg(long, value_enum, default_value = "y")]
    up: UpArg,
    /// Pose it by this animation, named or numbered from 0.
    #[arg(long, value_name = "NAME|NUMBER")]
    animation: Option<String>,
    /// At this moment of the animation, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0)]
    time: f32,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum UpArg {
    X,
    Y,
    Z,
}

fn positive(text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|&number: &f32| number > 0.0 && number.is_finite())
        .ok_or_else(|| String::from("a number above 0 is needed"))
}

/// Runs the command.
///
/// # Errors
/// Bad input: the file. Otherwise the output.
pub fn run(args: &ModelArgs, verbosity: Verbosity) -> Result<(), Failure> {
    let options = ModelOptions {
        scale: args.scale,
        up: match args.up {
            UpArg::X => Up::X,
            UpArg::Y => Up::Y,
            UpArg::Z => Up::Z,
        },
        animation: args.animation.as_ref().map(|text| match text.parse() {
            Ok(index) => AnimationChoice::Index(index),
            Err(_) => AnimationChoice::Name(text.clone()),
        }),
        time_s: args.time,
        ..ModelOptions::default()
    };
    let bar = verbosity.progress(1);
    bar.set_message(format!("reading {}", args.file.display()));
    bar.enable_steady_tick(Duration::from_millis(200));
    let model = model::load(&args.file, &options).map_err(Failure::bad_input);
    bar.finish_and_clear();
    Ok(output::write(None, model?.report.to_string().as_bytes())?)
}
