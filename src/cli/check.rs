//! `greyfield check`: is a folder of stimuli what it says, and would this machine render the same?
//! A results folder goes to [`check_results`].

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;

use super::{Failure, Verbosity, check_config, check_display, check_results, render};
use crate::render::technique::TECHNIQUES;
use crate::render::{Gpu, Renderer, stability};
use crate::stimulus::check::{
    self, CompareError, Comparison, SAME_SHARE, SAME_WITHIN_LEVELS, changed_images,
};
use crate::stimulus::manifest::AdapterRecord;
use crate::stimulus::{Folders, Manifest, StimulusError, StimulusSet};

/// Check a folder: stimuli against their manifest, their set, and what this machine renders; or
/// the results of a study.
///
/// A results folder (with study.json) is read whole: slots, every row against the plan of its
/// slot and the study's images, the clock, interruptions. Each finding says where and what to do;
/// errors end in exit code 1.
///
/// Every image must be there, unchanged. With --set, the images must be those of the set as it
/// is now, and the set is rendered again on this machine's adapter and compared: an image passes
/// if at least 99.9 % of its pixels differ by at most one level of 255. With --against, two
/// folders are compared in the same way.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield check stimuli/thesis-2010\n  greyfield check stimuli/thesis-2010 --set stimuli/thesis-2010.toml --diff differences\n  greyfield check results/thesis-2010\n  greyfield check protocols/yu-2009-reference.toml\n  greyfield check protocols/thesis-2010.toml --preregister -o preregistration.md\n  greyfield check --stability\n  greyfield check --display --seconds 5"
)]
pub struct Check {
    /// A folder of images with its manifest, a results folder, or a config: protocol, set or scene.
    #[arg(required_unless_present_any = ["stability", "display"])]
    folder: Option<PathBuf>,
    /// Instead of a folder: draw every technique on frames at the edge of what can be drawn, and
    /// print the worst of each.
    #[arg(long, conflicts_with_all = ["folder", "set", "against", "diff"])]
    stability: bool,
    /// Instead of a folder: cover the screen with grey, measure the display's refresh rate and
    /// its jitter, and say whether a session could run on it.
    #[arg(long, conflicts_with_all = ["folder", "stability", "set", "against", "diff"])]
    display: bool,
    /// With --display: measure this long at least.
    #[arg(long, value_name = "N", default_value_t = 1.0, requires = "display")]
    seconds: f64,
    /// With --display: stay in a window.
    #[arg(long, requires = "display")]
    windowed: bool,
    /// The set the images are of: compare with it, and render it again here.
    #[arg(long, value_name = "SET.toml")]
    set: Option<PathBuf>,
    /// With --set: do not render, compare with the set's config only.
    #[arg(long, requires = "set")]
    no_render: bool,
    /// With --set: render on the graphics adapter whose name contains this.
    #[arg(
        long,
        value_name = "NAME",
        requires = "set",
        conflicts_with = "no_render"
    )]
    adapter: Option<String>,
    /// Compare with the images in this folder instead of rendering.
    #[arg(long, value_name = "OTHER_FOLDER", conflicts_with = "set")]
    against: Option<PathBuf>,
    /// Write the differences, 16 times amplified, as PNG files into this folder.
    #[arg(long, value_name = "DIR")]
    diff: Option<PathBuf>,
    /// For a results folder: how findings are printed.
    #[arg(long, value_enum, conflicts_with_all = ["set", "against", "diff", "stability"])]
    format: Option<check_results::Format>,
    /// For a protocol: write a preregistration of it, under the headings of the OSF's form, in
    /// Markdown: hypotheses, design, sample size with its power, procedure, questions, exclusions,
    /// analysis.
    #[arg(long, conflicts_with_all = ["set", "against", "diff", "stability", "display", "format"])]
    preregister: bool,
    /// With --preregister: where to write it [default: standard output].
    #[arg(long, short, value_name = "FILE", requires = "preregister")]
    output: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 1 if something is not as it should be, 2 for a folder or set that cannot be read.
pub fn run(args: &Check, verbosity: Verbosity) -> Result<(), Failure> {
    if args.display {
        return check_display::run(args.seconds, args.windowed);
    }
    let Some(folder) = &args.folder else {
        return stability(verbosity);
    };
    if args.preregister {
        return check_config::preregister(folder, args.output.as_deref());
    }
    if check_config::is_config(folder) {
        return check_config::run(folder);
    }
    if check_results::is_results(folder) {
        let format = args.format.unwrap_or(check_results::Format::Text);
        return check_results::run(folder, format);
    }
    if args.format.is_some() {
        return Err(Failure::bad_input(anyhow!(
            "{}: --format is for a results folder, and this one has no study.json",
            folder.display()
        )));
    }
    let manifest = Manifest::load(folder).map_err(Failure::bad_input)?;
    let mut problems = files(&manifest, folder)?;
    let set = match &args.set {
        Some(path) => Some(StimulusSet::load(path).map_err(Failure::bad_input)?),
        None => None,
    };
    if let Some(set) = &set {
        let found = check::against_set(&manifest, set);
        if found.is_empty() {
            println!("All of the set {} as it is now.", set.path.display());
        }
        problems.extend(found);
    }
    // Rendering takes long and compares nothing that was not said already.
    report(&problems)?;
    let here = (&manifest, folder.as_path());
    match (&args.against, set) {
        (Some(other), _) => {
            let theirs = Manifest::load(other).map_err(Failure::bad_input)?;
            compare(here, (&theirs, other), args.diff.as_deref(), verbosity)
        }
        (None, Some(set)) if !args.no_render => {
            let scratch = Scratch::new()?;
            let adapter = args.adapter.as_deref();
            let again =
                render::draw(&set, Folders::images(&scratch.0), None, adapter, verbosity)?.manifest;
            compare(here, (&again, &scratch.0), args.diff.as_deref(), verbosity)
        }
        _ => Ok(()),
    }
}

/// Draws every technique on degenerate frames, and says which is not sound.
fn stability(verbosity: Verbosity) -> Result<(), Failure> {
    let renderer = Renderer::new(Gpu::open(None)?);
    let techniques = TECHNIQUES.iter().filter(|t| t.shader.is_some()).count();
    let progress = verbosity.progress(techniques as u64);
    let rows = stability::sweep(&renderer, |technique| {
        progress.set_message(technique.to_owned());
        progress.inc(1);
    })?;
    progress.finish_and_clear();
    print!("{}", stability::table(&rows));
    let unsound: Vec<String> = rows
        .iter()
        .filter(|row| !row.is_sound())
        .map(|row| format!("{} on \"{}\"", row.technique, row.case))
        .collect();
    if unsound.is_empty() {
        println!(
            "All {} frames are numbers from 0 to 1, on {}.",
            rows.len(),
            renderer.gpu().adapter.name
        );
        return Ok(());
    }
    Err(anyhow!("not a number from 0 to 1: {}", unsound.join(", ")).into())
}

/// Says what the folder holds; what is wrong with it is returned.
fn files(manifest: &Manifest, folder: &Path) -> Result<Vec<String>, Failure> {
    let changed = changed_images(manifest, folder);
    if changed.is_empty() {
        println!(
            "{}: {} images of {} conditions, all as the manifest says; made {}",
            folder.display(),
            manifest.images().count(),
            manifest.pairs.len(),
            made_by(manifest.adapter.as_ref())
        );
        for doubt in check::doubtful_pairs(manifest, folder)? {
            eprintln!("warning: {doubt}");
        }
    }
    Ok(changed.iter().map(StimulusError::to_string).collect())
}

fn made_by(adapter: Option<&AdapterRecord>) -> String {
    adapter.map_or_else(
        || String::from("elsewhere"),
        |adapter| format!("on {} ({}, {})", adapter.name, adapter.kind, adapter.driver),
    )
}

fn report(problems: &[String]) -> Result<(), Failure> {
    match problems {
        [] => Ok(()),
        [one] => Err(anyhow!("{one}").into()),
        [first, rest @ ..] => {
            for problem in rest {
                eprintln!("{problem}");
            }
            Err(anyhow!("{first}; and the {} above", rest.len()).into())
        }
    }
}

/// Compares two folders and prints a line an image.
fn compare(
    here: (&Manifest, &Path),
    there: (&Manifest, &Path),
    diff: Option<&Path>,
    verbosity: Verbosity,
) -> Result<(), Failure> {
    if let Some(folder) = diff {
        std::fs::create_dir_all(folder).map_err(|error| {
            anyhow!(
                "{}: {error}; name another folder with --diff",
                folder.display()
            )
        })?;
    }
    println!(
        "compared with images made {}",
        made_by(there.0.adapter.as_ref())
    );
    let bar = verbosity.progress(here.0.images().count() as u64);
    let comparisons = check::compare_folders(here, there, diff, &mut |what| {
        bar.set_message(what.to_owned());
        bar.inc(1);
    })
    .map_err(|error| match error {
        CompareError::Stimulus(error) => Failure::from(error),
        error => Failure::bad_input(error),
    })?;
    bar.finish_and_clear();
    print!("{}", table(&comparisons));
    verdict(&comparisons)
}

fn table(comparisons: &[Comparison]) -> String {
    let width = |of: fn(&Comparison) -> usize, least: usize| {
        comparisons.iter().map(of).max().unwrap_or(0).max(least)
    };
    let (conditions, techniques) = (
        width(|c| c.condition.len(), 9),
        width(|c| c.technique.len(), 9),
    );
    let mut lines = format!(
        "{:<conditions$}  {:<techniques$}  within {SAME_WITHIN_LEVELS}/255  largest  at (px)      mean    rmse\n",
        "condition", "technique"
    );
    for comparison in comparisons {
        let difference = &comparison.difference;
        let (x, y) = difference.largest_at_px;
        let mark = if comparison.passes() { "" } else { "  too far" };
        lines += &format!(
            "{:<conditions$}  {:<techniques$}  {:>10.4} %  {:>7}  {:<11} {:>6.4}  {:>6.4}{mark}\n",
            comparison.condition,
            comparison.technique,
            100.0 * difference.share_within(SAME_WITHIN_LEVELS),
            difference.largest,
            format!("{x}, {y}"),
            difference.mean_abs,
            difference.rmse,
        );
    }
    lines
}

fn verdict(comparisons: &[Comparison]) -> Result<(), Failure> {
    let failed: Vec<&Comparison> = comparisons.iter().filter(|c| !c.passes()).collect();
    let worst = failed.iter().min_by(|a, b| {
        let share = |c: &Comparison| c.difference.share_within(SAME_WITHIN_LEVELS);
        share(a).total_cmp(&share(b))
    });
    let Some(worst) = worst else {
        println!(
            "The same but for rounding: at least {} % of every image's pixels differ by at most {SAME_WITHIN_LEVELS}/255.",
            100.0 * SAME_SHARE
        );
        return Ok(());
    };
    let difference = &worst.difference;
    let (x, y) = difference.largest_at_px;
    Err(anyhow!(
        "{} of {} images differ; the worst is {} of condition \"{}\": {:.3} % of its pixels are within {SAME_WITHIN_LEVELS}/255 \
         (at least {} % are needed), and the pixel at column {x}, row {y} is {} levels off; see where with --diff DIR",
        failed.len(),
        comparisons.len(),
        worst.technique,
        worst.condition,
        100.0 * difference.share_within(SAME_WITHIN_LEVELS),
        100.0 * SAME_SHARE,
        difference.largest
    )
    .into())
}

/// A folder for images that are needed for a moment; gone with the value.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> anyhow::Result<Self> {
        let path = std::env::temp_dir().join(format!("greyfield-check-{}", std::process::id()));
        std::fs::create_dir(&path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A leftover in the temporary folder is not worth a failure.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
