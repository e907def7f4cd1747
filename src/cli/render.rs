//! `greyfield render`: stimuli from a set config.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use clap::Args;

use super::output::TracedShare;
use super::{Failure, Verbosity};
use crate::render::plan::GeometryFacts;
use crate::render::{Gpu, Precision, Renderer};
use crate::stimulus::produce::{self, ProduceError};
use crate::stimulus::progress::Progress;
use crate::stimulus::set::ImageSource;
use crate::stimulus::{Folders, Manifest, StimulusSet, files, sheet};

/// Make the images of a stimulus set, with a manifest of where each came from.
///
/// Images are rendered from the scenes the set names, or converted from the files it names;
/// a set of files only needs no graphics adapter.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield render stimuli/thesis-2010.toml\n  greyfield render stimuli/thesis-2010.toml --explain --only dragon-low\n  greyfield render stimuli/techniques.toml --occlusion occlusion"
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
    /// Run every effect, whether the scene calls for it or not: the images stay the same, byte
    /// for byte, and the manifest says what each effect costs.
    #[arg(long)]
    all_effects: bool,
    /// Use the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Store normals and occlusion in 16 bits (full) or in 8 as in 2010 (thesis).
    #[arg(long, value_enum)]
    precision: Option<PrecisionArg>,
    /// Print what each step took.
    #[arg(long)]
    timings: bool,
    /// Also write what each image's occlusion is, as it is shaded with: 16-bit grey PNG, linear,
    /// 65535 open, under the image's own name in this folder.
    #[arg(long, value_name = "DIR")]
    occlusion: Option<PathBuf>,
    /// Also draw every pair, small, on one picture: a row a condition.
    #[arg(long, value_name = "FILE.png")]
    sheet: Option<PathBuf>,
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
    set.all_effects = args.all_effects;
    let folder = args.out.clone().unwrap_or_else(|| set.default_folder());
    if args.explain {
        return explain(&set, args.only.as_deref(), &folder);
    }
    if args.occlusion.as_ref() == Some(&folder) {
        return Err(Failure::bad_input(anyhow::anyhow!(
            "--occlusion {}: the images themselves go there; name another folder",
            folder.display()
        )));
    }
    let folders = Folders {
        occlusion: args.occlusion.as_deref(),
        ..Folders::images(&folder)
    };
    let drawn = draw(
        &set,
        folders,
        args.only.as_deref(),
        args.adapter.as_deref(),
        verbosity,
    )?;
    if args.timings {
        println!("{}", drawn.timings);
    }
    if let Some(path) = &args.sheet {
        let sheet = sheet::contact_sheet(&drawn.manifest, &folder)?;
        files::write_whole(path, &files::encode_png(path, &sheet)?)?;
    }
    let pairs = drawn.manifest.pairs.len();
    println!(
        "{} images of {pairs} conditions in {}",
        2 * pairs,
        folder.display()
    );
    Ok(())
}

/// A drawn set.
pub struct Drawn {
    /// Its manifest.
    pub manifest: Manifest,
    /// What each step took, a line each.
    pub timings: String,
}

/// Opens the adapter if the set needs one and makes the set, with a progress bar.
///
/// # Errors
/// [`Failure`]: exit code 2 for a condition that is not there, 1 for adapter and disk.
pub fn draw(
    set: &StimulusSet,
    folders: Folders<'_>,
    only: Option<&str>,
    adapter: Option<&str>,
    verbosity: Verbosity,
) -> Result<Drawn, Failure> {
    let watch = Mutex::new(StopWatch::new());
    let steps = 1 + set.scenes.len() + 2 * set.conditions.len();
    let bar = verbosity.progress(steps as u64);
    let traced = TracedShare::new(&bar, set.size_px.unwrap_or_default());
    let open = || Ok(Renderer::new(Gpu::open(adapter)?));
    let step = |what: &str| {
        if let Ok(mut watch) = watch.lock() {
            watch.step(what);
        }
        traced.begin();
        bar.set_message(what.to_owned());
        bar.inc(1);
    };
    let progress = Progress {
        step: &step,
        pixels: &|count| traced.add(count),
    };
    let produced =
        produce::produce(&open, set, folders, only, &progress).map_err(|error| match error {
            ProduceError::NoSuchCondition { .. }
            | ProduceError::Source(_)
            | ProduceError::Pair { .. } => Failure::bad_input(error),
            error => Failure::from(error),
        })?;
    bar.finish_and_clear();
    for warning in &produced.warnings {
        eprintln!("warning: {warning}");
    }
    let watch = watch.into_inner();
    let mut timings = watch.map_or_else(|_| String::new(), StopWatch::finish);
    if let Some(adapter) = &produced.manifest.adapter {
        let (name, kind, driver) = (&adapter.name, &adapter.kind, &adapter.driver);
        timings = format!("on {name} ({kind}, {driver})\n{timings}");
    }
    Ok(Drawn {
        manifest: produced.manifest,
        timings,
    })
}

/// Wall time of one step after another.
struct StopWatch {
    started: Instant,
    current: Option<(String, Instant)>,
    lines: Vec<String>,
}

impl StopWatch {
    fn new() -> Self {
        Self {
            started: Instant::now(),
            current: None,
            lines: Vec::new(),
        }
    }

    /// Ends the step at hand and begins the next.
    fn step(&mut self, what: &str) {
        self.end_step();
        self.current = Some((what.to_owned(), Instant::now()));
    }

    fn end_step(&mut self) {
        if let Some((what, since)) = self.current.take() {
            self.line(&what, since);
        }
    }

    fn line(&mut self, what: &str, since: Instant) {
        self.lines.push(format!(
            "{what:<44} {:>8.0} ms",
            since.elapsed().as_secs_f64() * 1e3
        ));
    }

    fn finish(mut self) -> String {
        self.end_step();
        self.line("all", self.started);
        self.lines.join("\n")
    }
}

/// Prints the plan of every image; with what its passes took, where `folder` has the set as
/// it was drawn.
fn explain(set: &StimulusSet, only: Option<&str>, folder: &Path) -> Result<(), Failure> {
    let mut found = false;
    let drawn = Manifest::load(folder)
        .ok()
        .filter(|manifest| manifest.config_sha256 == set.sha256);
    if let Some(adapter) = drawn.as_ref().and_then(|drawn| drawn.adapter.as_ref()) {
        println!(
            "costs as drawn in {} on {}\n",
            folder.display(),
            adapter.name
        );
    }
    let mut facts: Vec<Option<GeometryFacts>> = vec![None; set.scenes.len()];
    for condition in set
        .conditions
        .iter()
        .filter(|c| only.is_none_or(|only| c.id == only))
    {
        found = true;
        let pair = match &condition.images {
            ImageSource::Rendered(pair) => pair,
            ImageSource::Loaded(_) => {
                println!("{} — made elsewhere, nothing is rendered\n", condition.id);
                continue;
            }
        };
        let scene = &set.scenes[pair.scene];
        let facts: &GeometryFacts = match &mut facts[pair.scene] {
            Some(known) => known,
            unknown => unknown.insert(GeometryFacts::of(
                &scene.geometry.load().map_err(Failure::bad_input)?,
            )),
        };
        println!(
            "{} — {} ({}), {} lighting",
            condition.id, scene.title, scene.id, pair.lighting
        );
        for technique in [&pair.first, &pair.second] {
            let ran = drawn.as_ref().map_or(&[][..], |drawn| {
                drawn.passes_of(&condition.id, &technique.label)
            });
            let plan = set.plan(pair, technique, facts, ran);
            println!("{}", technique.label);
            print!("{}", plan.tree(ran));
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
