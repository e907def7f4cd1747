//! `greyfield advise`: the cheapest settings nobody should be able to tell from the truth.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;

use super::cost::{Opened, PicturesArg, SweepArgs, failure, measure};
use super::{Failure, Verbosity};
use crate::cost::advise::{Advice, JUST_NOTICEABLE, settings_of};
use crate::cost::effects::{self, EffectCost};
use crate::cost::recommend::{self, Recommended};
use crate::cost::sweep::SceneSweep;
use crate::cost::{CostError, Row};
use crate::render::FrameRequest;
use crate::stimulus::files::write_whole;

/// Find the cheapest occlusion that a person should not be able to tell from the truth.
///
/// Sweeps the scene as `greyfield cost` does (and goes on with a sweep that is there), then takes
/// the cheapest setting whose image stays under the threshold, no occlusion at all included. Then
/// leaves out each effect of the scene in turn: what that saves, and whether it would be seen. Prints
/// the evidence and writes the config that it recommends beside the scene's, with a set that shows it
/// beside the truth.
///
/// The threshold is on FLIP at 95 % of the pixels. None has been published; the default is what
/// FLIP gives for a just noticeable difference (2.3 in L*, Mahy et al. 1994) of an even patch.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield advise stimuli/scenes/atrium.toml --size 640x360 --lighting moderate"
)]
pub struct Advise {
    /// The scene's config.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// FLIP that 95 % of the pixels may reach.
    #[arg(long, value_name = "T", default_value_t = JUST_NOTICEABLE)]
    threshold: f64,
    /// Samples a pixel.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "4,8,16,32,64",
          value_parser = clap::value_parser!(u32).range(1..=4096))]
    samples: Vec<u32>,
    #[command(flatten)]
    sweep: SweepArgs,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong scene or settings; 1 for adapter and disk.
pub fn run(args: &Advise, verbosity: Verbosity) -> Result<(), Failure> {
    if !(args.threshold > 0.0 && args.threshold <= 1.0) {
        let found = args.threshold;
        return Err(Failure::bad_input(anyhow!(
            "--threshold: found {found}, FLIP is from 0 to 1; allowed is above 0 to 1"
        )));
    }
    let files = [args.scene.clone()];
    let mut opened = args.sweep.open(&files, &args.samples, verbosity)?;
    measure(&args.sweep, &mut opened, PicturesArg::None, verbosity).map_err(failure)?;
    opened.store.finish().map_err(failure)?;
    for sweep in &opened.asked.sweeps {
        advise(args, &opened, sweep, verbosity).map_err(failure)?;
    }
    Ok(())
}

fn advise(
    args: &Advise,
    opened: &Opened,
    sweep: &SceneSweep,
    verbosity: Verbosity,
) -> Result<(), CostError> {
    let (scene, store) = (&sweep.scene, &opened.store);
    let about = &store.record.about;
    println!(
        "{} at {}×{} on {} ({}){}",
        scene.title,
        about.size_px.0,
        about.size_px.1,
        about.adapter.name,
        about.adapter.driver,
        if about.is_software {
            "; a software adapter: ratios only"
        } else {
            ""
        }
    );
    println!(
        "Passes: FLIP ≤ {} at 95 % of the pixels, {:.1} pixels a degree (a just noticeable difference; see --help)",
        args.threshold, about.pixels_per_degree
    );
    let advices: Vec<Advice<'_>> = (sweep.lightings.iter())
        .map(|lighting| Advice::of(&store.rows, &scene.id, lighting, args.threshold))
        .collect();
    // One config serves all variants: it takes what the most demanding of them needs.
    let dearest = |a: &&Row, b: &&Row| a.total_ms.total_cmp(&b.total_ms);
    let chosen = advices
        .iter()
        .filter_map(Advice::recommended)
        .max_by(dearest);
    let Some(chosen) = chosen else {
        return Err(CostError::Input(String::from("nothing was measured")));
    };
    let found = effects_of(opened, sweep, chosen, verbosity)?;
    for (advice, effects) in advices.iter().zip(&found) {
        println!("\nlighting \"{}\"", advice.lighting);
        for sentence in advice.sentences(args.threshold) {
            println!("  {sentence}");
        }
        println!("  effects, with {}:", chosen.configuration);
        for effect in effects {
            println!("    {}", said(effect, args.threshold));
        }
    }
    write(args, sweep, chosen, &found)
}

/// What each effect of each lighting costs and shows, with the chosen technique.
fn effects_of(
    opened: &Opened,
    sweep: &SceneSweep,
    chosen: &Row,
    verbosity: Verbosity,
) -> Result<Vec<Vec<EffectCost>>, CostError> {
    let (scene, about) = (&sweep.scene, &opened.store.record.about);
    let settings = settings_of(chosen).map_err(|error| CostError::Input(error.message))?;
    let bar = verbosity.progress(sweep.lightings.len() as u64);
    bar.set_message("weighing effects");
    let uploaded = opened.renderer.upload(&scene.geometry.load()?)?;
    let mut found = Vec::new();
    for lighting in &sweep.lightings {
        let lighting = scene.lighting(lighting).map_err(CostError::Input)?;
        let mut request =
            FrameRequest::new(scene, lighting, settings.clone(), about.size_px, about.seed);
        request.blur_radius_px = chosen.blur_px;
        found.push(effects::weigh(
            &opened.renderer,
            &uploaded,
            &request,
            about.pixels_per_degree,
        )?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(found)
}

fn said(effect: &EffectCost, threshold: f64) -> String {
    let verdict = match effect.flip_p95 > threshold {
        true => "earns its time",
        false => "would not be missed",
    };
    let saves = match (effect.saves_ms, effect.saves_range_ms, effect.frame_ms) {
        (Some(ms), Some((low, high)), Some(frame)) if low > 0.0 => format!(
            "takes {ms:.3} ms ({low:.3} to {high:.3}) of {frame:.3} ms, {:.0} %",
            100.0 * ms / frame
        ),
        (Some(_), Some((low, high)), _) => {
            format!("takes no time that can be told from nothing ({low:.3} to {high:.3} ms)")
        }
        _ => String::from("the adapter cannot time it"),
    };
    format!(
        "{}: {verdict}. Without it ({}) FLIP is {:.3} at 95 % of the pixels, {:.4} on average; it {saves}",
        effect.effect, effect.instead, effect.flip_p95, effect.flip_mean
    )
}

/// Writes the recommended config and the set that shows it, beside the scene's.
fn write(
    args: &Advise,
    sweep: &SceneSweep,
    chosen: &Row,
    found: &[Vec<EffectCost>],
) -> Result<(), CostError> {
    let scene = &sweep.scene;
    let settings = settings_of(chosen).map_err(|error| CostError::Input(error.message))?;
    let recommended: Vec<Recommended<'_>> = (sweep.lightings.iter().zip(found))
        .map(|(lighting, effects)| Recommended {
            lighting,
            unseen: effects
                .iter()
                .filter(|e| e.flip_p95 <= args.threshold)
                .collect(),
        })
        .collect();
    let text = recommend::scene_config(scene, chosen, &settings, &recommended)?;
    let scene_file = format!("{}-advised.toml", scene.id);
    let set_file = format!("{}-advised-set.toml", scene.id);
    let lightings: Vec<&str> = sweep.lightings.iter().map(String::as_str).collect();
    let set = recommend::check_set(scene, chosen, &lightings, sweep.reach_m, &scene_file);
    let (scene_path, set_path) = (
        scene.path.with_file_name(&scene_file),
        scene.path.with_file_name(&set_file),
    );
    for (path, text) in [(&scene_path, text), (&set_path, set)] {
        write_whole(path, text.as_bytes())?;
    }
    println!(
        "\nwritten: {}, and {} to see it beside the truth: greyfield render {}",
        scene_path.display(),
        set_path.display(),
        set_path.display()
    );
    Ok(())
}
