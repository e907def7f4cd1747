//! `greyfield tune`: a technique's settings as sliders, with their price.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, cost, size};
use crate::app;
use crate::app::tuner::{Tuning, Wishes};
use crate::cost::CostError;
use crate::scene::SceneConfig;

/// Turn a technique's settings and see at once what they take and how wrong they are.
///
/// For the experimenter. Beside the sliders: the image, its occlusion, its error against the
/// ray-traced truth, what can be seen of that error, and the numbers of each. Two settings can be
/// pinned, compared, and written as a stimulus pair. Keys: 1 to 5 choose what is shown, N, A and B
/// whose, S splits A and B, 0 fits; the wheel zooms, dragging moves.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  greyfield tune stimuli/scenes/atrium.toml\n  greyfield tune stimuli/scenes/atrium.toml --lighting low --size 1280x720 --radius 1"
)]
pub struct Tune {
    /// The scene's config.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Lighting variant to start with [default: the first].
    #[arg(long, value_name = "NAME")]
    lighting: Option<String>,
    /// Size of the images, pixels.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size::size)]
    size: (u32, u32),
    /// Distance from which on nothing occludes, metres [default: as far as the scene lets gtao look].
    #[arg(long, value_name = "M")]
    radius: Option<f64>,
    /// Measure the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong scene, lighting or radius; 1 for the display.
pub fn run(args: &Tune) -> Result<(), Failure> {
    let scene = SceneConfig::load(&args.scene)
        .map_err(CostError::from)
        .map_err(cost::failure)?;
    let wishes = Wishes {
        lighting: args.lighting.clone(),
        size_px: args.size,
        radius_m: args.radius,
        adapter: args.adapter.clone(),
    };
    app::tune(Tuning::new(scene, wishes).map_err(cost::failure)?)?;
    Ok(())
}
