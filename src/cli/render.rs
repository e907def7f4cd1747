//! `greyfield render`: stimuli from a set config.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::{Failure, Verbosity};
use crate::render::plan::{FramePlan, GeometryFacts};
use crate::render::{Gpu, Precision, Renderer};
use crate::stimulus::{Manifest, StimulusSet, produce};

/// Draw the images of a stimulus set, with a manifest of where each came from.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield render stimuli/thesis-2010.toml\n  greyfield render stimuli/thesis-2010.toml --explain --only dragon-low"
)]
pub struct RenderArgs {
    /// The set: a TOML file with its conditions.
    set: PathBuf,
    /// Where to put the images [default: a folder named like the set, beside it].
    #[arg(long)]
    out: Option<PathBuf>,
    /// Draw one condition only.
    #[arg(long, value_name = "CONDITION")]
    only: Option<String>,
    /// Print which passes each image runs, which it leaves out, and why; draw nothing.
    #[arg(long)]
    explain: bool,
    /// Use the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Store normals and occlusion in 16 bits (full) or in 8 as in 2010 (thesis).
    #[arg(long, value_enum)]
    precision: Option<PrecisionArg>,
    /// Print what each step took.
    #[arg(long)]
    timings: bool,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum PrecisionArg {
    Full,
    Thesis,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] with exit code 2 for a wrong config, 1 for what fails later.
pub fn run(args: &RenderArgs, verbosity: Verbosity) -> Result<(), Failure> {
    let mut set = StimulusSet::load(&args.set).map_err(Failure::bad_input)?;
    match args.precision {
        Some(PrecisionArg::Full) => set.precision = Precision::Full,
        Some(PrecisionArg::Thesis) => set.precision = Precision::Thesis,
        None => {}
    }
    if args.explain {
        return explain(&set, args.only.as_deref());
    }
    let folder = args.out.clone().unwrap_or_else(|| default_folder(&set));
    let manifest = draw(&set, &folder, args, verbosity)?;
    println!(
        "{} images of {} conditions in {}",
        2 * manifest.pairs.len(),
        manifest.pairs.len(),
        folder.display()
    );
    Ok(())
}

/// Where the images of a set lie unless somebody says otherwise.
#[must_use]
pub fn default_folder(set: &StimulusSet) -> PathBuf {
    set.path.with_file_name(&set.id)
}

/// Opens the adapter and draws the set, with a progress bar.
///
/// # Errors
/// [`Failure`].
fn draw(
    set: &StimulusSet,
    folder: &std::path::Path,
    args: &RenderArgs,
    verbosity: Verbosity,
) -> Result<Manifest, Failure> {
    let started = Instant::now();
    let renderer = Renderer::new(Gpu::open(args.adapter.as_deref())?);
    let opened = started.elapsed();
    let steps = set.scenes.len() + 2 * set.conditions.len();
    let bar = verbosity.progress(steps as u64);
    let mut last: Option<(String, Instant)> = None;
    let mut lines = Vec::new();
    let mut finish = |last: &mut Option<(String, Instant)>| {
        if let Some((what, since)) = last.take() {
            lines.push(format!(
                "{what:<44} {:>8.0} ms",
                since.elapsed().as_secs_f64() * 1e3
            ));
        }
    };
    let manifest = produce::produce(&renderer, set, folder, args.only.as_deref(), &mut |what| {
        finish(&mut last);
        last = Some((what.to_owned(), Instant::now()));
        bar.set_message(what.to_owned());
        bar.inc(1);
    })
    .map_err(|error| match error {
        produce::ProduceError::NoSuchCondition { .. } => Failure::bad_input(error),
        error => Failure::from(error),
    })?;
    finish(&mut last);
    bar.finish_and_clear();
    if args.timings {
        println!(
            "adapter {} ({}), opened in {:.0} ms",
            renderer.gpu().adapter.name,
            renderer.gpu().adapter.kind,
            opened.as_secs_f64() * 1e3
        );
        println!("{}", lines.join("\n"));
        println!(
            "{:<44} {:>8.0} ms",
            "all",
            started.elapsed().as_secs_f64() * 1e3
        );
    }
    Ok(manifest)
}

fn explain(set: &StimulusSet, only: Option<&str>) -> Result<(), Failure> {
    let mut found = false;
    let mut facts: Vec<Option<GeometryFacts>> = vec![None; set.scenes.len()];
    for condition in set
        .conditions
        .iter()
        .filter(|c| only.is_none_or(|only| c.id == only))
    {
        found = true;
        let scene = &set.scenes[condition.scene];
        let facts = *facts[condition.scene].get_or_insert_with(|| {
            let geometry = (scene.generator.generate)(scene.seed);
            GeometryFacts {
                triangles: geometry.triangles(),
                has_normal_maps: geometry.has_normal_maps(),
            }
        });
        println!(
            "{} — {} ({}), {} lighting",
            condition.id, scene.title, scene.id, condition.lighting
        );
        for technique in [&condition.first, &condition.second] {
            let plan = FramePlan::new(&set.request(condition, technique), facts);
            println!(
                " {} ({} passes; + runs, - is left out)",
                technique.label,
                plan.passes.len()
            );
            print!("{plan}");
        }
        println!();
    }
    if found {
        return Ok(());
    }
    let known: Vec<&str> = set.conditions.iter().map(|c| c.id.as_str()).collect();
    Err(Failure::bad_input(anyhow::anyhow!(
        "the set has no condition \"{}\"; it has: {}",
        only.unwrap_or_default(),
        known.join(", ")
    )))
}
